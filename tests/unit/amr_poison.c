/* What nobody should read is poisoned: NaN in cells under finer tiles that no leaf and no finer ghost depends on within
 * a step, and in the new state before it is made. Leaves must not notice. */
#include "amr.h"

enum { STEPS = 24 };

/* Cells that the leaves of the same level feel within a step: two stages with two ghosts each, and what the finer
 * level's ghosts are interpolated from. */
enum { REACH = 6 };

struct setup {
    const char *name, *domain, *mesh, *core;
};

static const struct setup SETUPS[] = {
    {"line", "{lower: [0], upper: [1], cells: [128], boundaries: {x-: periodic, x+: periodic}}", "levels: 3, tile: 16",
     "[0.4]"},
    {"plane",
     "{lower: [0, 0], upper: [1, 1], cells: [48, 48], boundaries: {x-: reflecting, x+: outflow, y-: periodic, "
     "y+: periodic}}",
     "levels: 2, tile: 8", "[0.4, 0.5]"},
    {"axisymmetric",
     "{geometry: axisymmetric, lower: [0, 0], upper: [1, 1], cells: [48, 48], boundaries: {x-: axis, x+: reflecting, "
     "y-: non-reflecting, y+: outflow}}",
     "levels: 2, tile: 8", "[0, 0.5]"},
    {"space",
     "{lower: [0, 0, 0], upper: [1, 1, 1], cells: [24, 24, 24], boundaries: {x-: periodic, x+: periodic, y-: "
     "periodic, y+: periodic, z-: outflow, z+: outflow}}",
     "levels: 1, tile: 4", "[0.4, 0.5, 0.5]"},
};

static void start(struct flow *flow, const struct setup *setup)
{
    flow_start(flow, mem_print("bulla: 1\ntitle: poison\ndomain: %s\n"
                               "mesh: {%s, regrid-every: 4, buffer: 4, refine: [{value: alpha_air, above: 0.01}, "
                               "{jump: pressure, above: 0.9, finest: 1}]}\n"
                               "materials:\n" FLOW_WATER FLOW_AIR "initial:\n"
                               "  - {everywhere: true, material: water, density: 1000, pressure: 1e5}\n"
                               "  - {sphere: {center: %s, radius: 0.27}, material: air, density: 50, pressure: 1e7}\n"
                               "run: {until: 1}\n",
                               setup->domain, setup->mesh, setup->core));
}

/* Is the cell of a level at coordinates `at` outside the domain, or under a finer tile? */
static bool is_covered(const struct flow *flow, int l, const int at[3])
{
    const struct mesh *mesh = flow->state->mesh;
    const struct level *level = &mesh->levels[l];
    int tile[3] = {0};
    size_t cell = 0, step = 1;
    for (int d = 0; d < mesh->dim; d++) {
        int n = mesh->n[d], most = n * level->extent[d], i = at[d];
        if (mesh->periodic[d]) i = (i % most + most) % most;
        if (i < 0 || i >= most) return true;
        tile[d] = i / n;
        cell += (size_t)(i % n) * step;
        step *= (size_t)n;
    }
    int found = mesh_find(mesh, level, tile);
    unsigned covered = found >= 0 ? level->tiles[found].covered : 0;
    return covered >> mesh_octant(mesh, cell) & 1u;
}

/* Are all cells within REACH covered, and the cell itself in the domain? */
static bool is_deep(const struct flow *flow, int l, const int at[3])
{
    int from[3] = {0}, to[3] = {0}, i[3];
    for (int d = 0; d < flow->scene->domain.dim; d++) from[d] = -REACH, to[d] = REACH;
    for (i[2] = from[2]; i[2] <= to[2]; i[2]++)
        for (i[1] = from[1]; i[1] <= to[1]; i[1]++)
            for (i[0] = from[0]; i[0] <= to[0]; i[0]++)
                if (!is_covered(flow, l, (const int[]){at[0] + i[0], at[1] + i[1], at[2] + i[2]})) return false;
    return true;
}

/* NaN into deep cells of u_old and w; returns how many. */
static long poison_deep(const struct flow *flow)
{
    const struct mesh *mesh = flow->state->mesh;
    long count = 0;
    for (int l = 0; l + 1 < mesh->n_level; l++)
        for (unsigned t = 0; t < mesh->levels[l].n_tile; t++)
            for (size_t c = 0; c < mesh->n_cell; c++) {
                const struct level *level = &mesh->levels[l];
                size_t n = (size_t)mesh->n[0], rest[3] = {c % n, c / n % n, c / n / n};
                int at[3] = {0};
                for (int d = 0; d < mesh->dim; d++) at[d] = level->tiles[t].at[d] * mesh->n[d] + (int)rest[d];
                if (!is_deep(flow, l, at)) continue;
                for (unsigned q = 0; q < mesh->n_field; q++)
                    level->u_old[t][q * mesh->n_cell + c] = level->w[t][q * mesh->n_cell + c] = NAN;
                count++;
            }
    return count;
}

/* NaN into all arrays of hidden tiles; returns how many. */
static long poison_hidden(const struct flow *flow)
{
    const struct mesh *mesh = flow->state->mesh;
    long count = 0;
    for (int l = 0; l + 1 < mesh->n_level; l++)
        for (unsigned t = 0; t < mesh->levels[l].n_tile; t++) {
            const struct level *level = &mesh->levels[l];
            if (!level->tiles[t].hidden) continue;
            for (size_t i = 0; i < mesh->n_field * mesh->n_cell; i++)
                level->u_old[t][i] = level->w[t][i] = level->u_new[t][i] = NAN;
            count++;
        }
    return count;
}

/* NaN into the evolved fields of the state to be made (fractions of tiles of one material stay from step to step). */
static long poison_new(const struct flow *flow)
{
    const struct mesh *mesh = flow->state->mesh;
    const struct model *model = flow->state->model;
    long count = 0;
    for (int l = 0; l < mesh->n_level; l++)
        for (unsigned t = 0; t < mesh->levels[l].n_tile; t++, count++)
            for (size_t i = model->i_m * mesh->n_cell; i < mesh->n_field * mesh->n_cell; i++)
                mesh->levels[l].u_new[t][i] = NAN;
    return count;
}

static void check(const struct setup *setup, long (*poison)(const struct flow *flow), const char *what)
{
    struct flow clean, dirty;
    start(&clean, setup);
    start(&dirty, setup);
    long poisoned = 0;
    for (int step = 0; step < STEPS / clean.scene->domain.dim; step++) {
        poisoned += poison(&dirty);
        flow_steps(&clean, 1);
        flow_steps(&dirty, 1);
        if (!amr_equal(&clean, &dirty)) fail_msg("%s, %s: leaves differ after step %d", setup->name, what, step + 1);
    }
    amr_print(&clean, setup->name);
    print_message("  %s: %ld poisoned\n", what, poisoned);
    assert_true(poisoned > 0);
    assert_true(clean.state->counts.fallback == dirty.state->counts.fallback);
    flow_stop(&clean);
    flow_stop(&dirty);
}

static void test_hidden(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof SETUPS / sizeof *SETUPS; i++) check(&SETUPS[i], poison_hidden, "hidden tiles");
}

static void test_new(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof SETUPS / sizeof *SETUPS; i++) check(&SETUPS[i], poison_new, "new states");
}

static void test_deep(void **state)
{
    (void)state;
    for (size_t i = 0; i < 3; i++) check(&SETUPS[i], poison_deep, "covered cells");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_hidden),
        cmocka_unit_test(test_new),
        cmocka_unit_test(test_deep),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
