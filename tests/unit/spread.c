/* Changes that some cells of a tile cannot bear, handed to those around them: sums over volumes stay, in plane and
 * curved geometry, and no cell is left with less than nothing, nor with less energy than that of its motion. */
#include "flow.h"

#include "levels/spread.h"

static const char *const GEOMETRIES[] = {"plane", "axisymmetric"};

struct tile_world {
    struct flow flow;
    struct metric metric;
    unsigned char *trouble;
    double *delta, *rest, *u; /* [n_field][n_cell] */
    struct spread spread;
};

static void start(struct tile_world *world, const char *geometry)
{
    bool plane = !strcmp(geometry, "plane");
    flow_start(&world->flow,
               mem_print("bulla: 1\ntitle: spread\ndomain: {geometry: %s, lower: [0, 0], upper: [1, 1], cells: "
                         "[8, 8], boundaries: {x-: %s, x+: outflow, y-: outflow, y+: outflow}}\nmesh: {tile: "
                         "8}\nmaterials:\n" FLOW_WATER FLOW_AIR
                         "initial:\n  - {everywhere: true, fractions: {water: 0.6, air: 0.4}, density: "
                         "{water: 1000, air: 1.2}, pressure: 1e5, velocity: [3, 4]}\nrun: {until: 1}\n",
                         plane ? "cartesian" : geometry, plane ? "outflow" : "axis"));
    const struct state *state = world->flow.state;
    const struct level *level = flow_level(&world->flow);
    size_t block = state->model->n_field * state->mesh->n_cell;
    world->trouble = mem_new(state->mesh->n_cell, 1);
    world->delta = mem_new(block, sizeof(double));
    world->rest = mem_new(block, sizeof(double));
    world->u = mem_new(block, sizeof(double));
    memcpy(world->u, level->u_old[0], block * sizeof(double));
    metric_of_tile(state->mesh, level, &level->tiles[0], &world->metric);
    world->spread = (struct spread){.model = state->model,
                                    .mesh = state->mesh,
                                    .tile = &level->tiles[0],
                                    .metric = &world->metric,
                                    .u = world->u,
                                    .trouble = world->trouble};
}

static void stop(struct tile_world *world)
{
    mem_free(world->trouble);
    mem_free(world->delta);
    mem_free(world->rest);
    mem_free(world->u);
    flow_stop(&world->flow);
}

static double total(const struct tile_world *world, const double *values, unsigned q)
{
    size_t n = world->flow.state->mesh->n_cell;
    double sum = 0.0;
    for (size_t c = 0; c < n; c++) sum += values[q * n + c] * spread_volume(&world->spread, q, c);
    return sum;
}

/* Fractions within [0, 1], masses and energy positive, up to a rounding. */
static void check_bounds(const struct tile_world *world)
{
    const struct model *model = world->flow.state->model;
    size_t n = world->flow.state->mesh->n_cell;
    for (unsigned q = 0; q <= model->i_E; q++)
        for (size_t c = 0; c < n && (q < model->i_u || q == model->i_E); c++) {
            double now = world->u[q * n + c] + world->delta[q * n + c];
            assert_true(now >= -1e-12 * world->u[q * n + c] && (q >= model->n_alpha || now <= 1.0 + 1e-12));
        }
}

/* Cells with `part` of what they hold of water taken off, more than they have. */
static void take_off(struct tile_world *world, size_t cell, double part)
{
    const struct model *model = world->flow.state->model;
    size_t n = world->flow.state->mesh->n_cell;
    for (unsigned q = 0; q < model->i_V; q++) world->delta[q * n + cell] = -part * world->u[q * n + cell];
    world->delta[n + cell] = -world->delta[cell]; /* fractions stay at sum 1 */
    world->trouble[cell] = SPREAD_HALF;
}

static void check_change(const char *geometry, double part, bool rests)
{
    struct tile_world world;
    start(&world, geometry);
    const struct model *model = world.flow.state->model;
    double before[FLOW_FIELDS];
    static const size_t cells[] = {0, 3, 18, 19, 36, 63};
    for (size_t i = 0; i < sizeof cells / sizeof *cells; i++)
        take_off(&world, cells[i], part * (1.0 + 0.1 * (double)i));
    world.trouble[18] = SPREAD_ALL;
    for (unsigned q = 0; q < model->i_V; q++) before[q] = total(&world, world.delta, q);
    bool any = spread_change(&world.spread, world.delta, world.rest);
    assert_true(any == rests);
    for (unsigned q = 0; q < model->i_V; q++) {
        double after = total(&world, world.delta, q) + total(&world, world.rest, q), size = total(&world, world.u, q);
        print_message("%s, %g: field %u off by %.1e\n", geometry, part, q, fabs(after - before[q]) / size);
        assert_true(fabs(after - before[q]) <= 1e-14 * size);
    }
    check_bounds(&world);
    stop(&world);
}

static void test_change(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        check_change(GEOMETRIES[i], 0.9, false);
        check_change(GEOMETRIES[i], 2.0, false);
        check_change(GEOMETRIES[i], 200.0, true);
    }
}

/* An amount for one cell: all of it is placed, as a whole or field by field. */
static void test_amount(void **state)
{
    (void)state;
    static const double parts[] = {-0.1, -3.0, -40.0, -45.0}; /* the last needs all that there is: field by field */
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 4; k++) {
            struct tile_world world;
            double amount[FLOW_FIELDS] = {0};
            start(&world, GEOMETRIES[i]);
            const struct model *model = world.flow.state->model;
            size_t n = world.flow.state->mesh->n_cell, cell = 21;
            for (unsigned q = 0; q < model->i_V; q++)
                amount[q] = parts[k] * world.u[q * n + cell] * spread_volume(&world.spread, q, cell);
            amount[1] = -amount[0];
            spread_amount(&world.spread, cell, amount, world.delta);
            for (unsigned q = model->i_m; q < model->i_V; q++) {
                double off = fabs(total(&world, world.delta, q) - amount[q]) / total(&world, world.u, q);
                if (off > 1e-14) fail_msg("%s, %g: field %u off by %.1e", GEOMETRIES[i], parts[k], q, off);
            }
            stop(&world);
        }
}

/* Cold gas that flies at Mach 1500: all but a millionth of its energy is that of motion. */
static void start_cold(struct tile_world *world, const char *geometry)
{
    start(world, geometry);
    const struct model *model = world->flow.state->model;
    size_t n = world->flow.state->mesh->n_cell;
    for (size_t c = 0; c < n; c++) {
        double w[FLOW_FIELDS] = {0}, u[FLOW_FIELDS];
        w[0] = 0.0, w[1] = 1.0;
        w[model->i_m] = 1000.0, w[model->i_m + 1] = 1.2;
        w[model->i_u] = 4e5, w[model->i_u + 1] = 3e5;
        w[model->i_E] = 1e5;
        mix_conserved(model, 1, 1, w, u);
        for (unsigned q = 0; q < model->n_field; q++) world->u[q * n + c] = u[q];
    }
}

/* Pressures of all cells stand: none is left with less energy than that of its motion. */
static void check_pressures(const struct tile_world *world)
{
    const struct model *model = world->flow.state->model;
    size_t n = world->flow.state->mesh->n_cell;
    for (size_t c = 0; c < n; c++) {
        double u[FLOW_FIELDS], w[FLOW_FIELDS] = {0};
        for (unsigned q = 0; q < model->n_field; q++) u[q] = world->u[q * n + c] + world->delta[q * n + c];
        mix_primitives(model, 1, 1, u, w);
        if (!(w[model->i_E] > 0.0)) fail_msg("cell %zu: pressure %g", c, w[model->i_E]);
    }
}

/* Energy alone is taken, `part` of the thermal one of a cell; a tile of 64 cells holds 64 of it. */
static void check_cold(const char *geometry, double part, bool rests)
{
    struct tile_world world;
    start_cold(&world, geometry);
    unsigned E = world.flow.state->model->i_E;
    size_t n = world.flow.state->mesh->n_cell;
    static const size_t cells[] = {0, 18, 36, 63};
    for (size_t i = 0; i < sizeof cells / sizeof *cells; i++) {
        world.delta[E * n + cells[i]] = -part * 2.5e5;
        world.trouble[cells[i]] = SPREAD_HALF;
    }
    double before = total(&world, world.delta, E), size = total(&world, world.u, E);
    assert_true(spread_change(&world.spread, world.delta, world.rest) == rests);
    assert_true(fabs(total(&world, world.delta, E) + total(&world, world.rest, E) - before) <= 1e-14 * size);
    check_pressures(&world);
    memset(world.delta, 0, world.flow.state->model->n_field * n * sizeof *world.delta);
    double amount[FLOW_FIELDS] = {0};
    amount[E] = -2.0 * 2.5e5 * spread_volume(&world.spread, E, 21);
    spread_amount(&world.spread, 21, amount, world.delta);
    assert_true(fabs(total(&world, world.delta, E) - amount[E]) <= 1e-14 * size);
    check_pressures(&world);
    stop(&world);
}

static void test_cold(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        check_cold(GEOMETRIES[i], 2.0, false);
        check_cold(GEOMETRIES[i], 40.0, true);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_change), cmocka_unit_test(test_amount),
                                       cmocka_unit_test(test_cold)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
