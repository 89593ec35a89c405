/* A mesh refined everywhere is the uniform fine mesh, to the bit: every level covers the whole domain, so that only the
 * finest one counts, and it has to take the steps that a mesh of one level takes. */
#include "amr.h"

struct setup {
    const char *name, *domain; /* with room for the numbers of cells */
    int cells, levels, steps;
};

static const struct setup SETUPS[] = {
    {"line", "{lower: [0], upper: [1], cells: [%d], boundaries: {x-: non-reflecting, x+: reflecting}}", 32, 3, 12},
    {"spherical", "{geometry: spherical, lower: [0], upper: [1], cells: [%d], boundaries: {x-: axis, x+: outflow}}", 32,
     2, 20},
    {"plane",
     "{lower: [0, 0], upper: [1, 1], cells: [%d, %d], boundaries: {x-: periodic, x+: periodic, y-: no-slip, y+: "
     "non-reflecting}}",
     16, 2, 10},
    {"axisymmetric",
     "{geometry: axisymmetric, lower: [0, 0], upper: [1, 1], cells: [%d, %d], boundaries: {x-: axis, x+: {type: "
     "incoming-wave, pulse: sine, amplitude: 1 MPa, frequency: 10 kHz}, y-: outflow, y+: {type: inflow, material: air, "
     "density: 1.2, pressure: 2e5, velocity: [0, -40]}}}",
     16, 2, 10},
    {"space",
     "{lower: [0, 0, 0], upper: [1, 1, 1], cells: [%d, %d, %d], boundaries: {x-: periodic, x+: periodic, y-: "
     "non-reflecting, y+: reflecting, z-: outflow, z+: {type: incoming-wave, pulse: sine, amplitude: 1 MPa, frequency: "
     "10 kHz}}}",
     8, 1, 6},
};

/* Skew pressures and velocities, a bubble that tile borders cut. */
static void set_state(const struct model *model, const double x[3], double *w)
{
    double bubble = hypot(hypot(x[0] - 0.52, x[1] - 0.47), x[2] - 0.3) < 0.33 ? 1.0 : 0.0;
    w[1] = bubble;
    w[0] = 1.0 - w[1];
    for (int d = 0; d < model->dim; d++) w[model->i_u + (unsigned)d] = 4.0 * cos(3.0 * x[0] + 2.0 * x[1] + (double)d);
    w[model->i_E] = x[0] + 0.5 * x[1] - x[2] > 0.6 ? 2e7 : 2e5;
}

/* `fine`: one level of all fine cells; else the same by refinement. dt is that of level 0. */
static void start(struct flow *flow, const struct setup *setup, bool fine, double dt, const char *more)
{
    int factor = 1 << setup->levels, n = fine ? setup->cells * factor : setup->cells;
    char *domain = mem_print(setup->domain, n, n, n);
    char *mesh =
        fine ? mem_text("tile: 8") : mem_print("tile: 8, levels: %d%s, refine: [{lua: '= true'}]", setup->levels, more);
    flow_start(flow,
               mem_print("bulla: 1\ntitle: refined everywhere\ndomain: %s\nmesh: {%s}\nmaterials:\n" FLOW_WATER FLOW_AIR
                         "initial:\n  - {everywhere: true, material: water, density: 1000, pressure: 1e5}\n"
                         "scheme: {dt: %.17g}\nrun: {until: 1}\n",
                         domain, mesh, dt));
    mem_free(domain);
    mem_free(mesh);
    amr_set(flow, set_state, NULL);
}

/* Are the finest levels of both the same? */
static bool same(const struct flow *uniform, const struct flow *refined, int levels)
{
    const struct level *a = &uniform->state->mesh->levels[0], *b = &refined->state->mesh->levels[levels];
    size_t bytes = uniform->state->model->n_field * uniform->state->mesh->n_cell * sizeof(double);
    bool equal = a->n_tile == b->n_tile && refined->state->mesh->n_level == levels + 1;
    for (unsigned t = 0; equal && t < a->n_tile; t++) {
        assert_true(a->tiles[t].key == b->tiles[t].key);
        equal = memcmp(a->u_old[t], b->u_old[t], bytes) == 0;
    }
    return equal;
}

static void check(const struct setup *setup, bool subcycle)
{
    struct flow uniform, refined;
    int factor = 1 << setup->levels, sub = subcycle ? factor : 1;
    double dt = 0.3 / (3.0 * 1800.0 * setup->cells * factor);
    dt = ldexp(floor(ldexp(dt, 40)), -40); /* few digits: its multiples are exact, and so is time */
    start(&uniform, setup, true, dt, "");
    start(&refined, setup, false, dt * sub, subcycle ? "" : ", subcycle: false");
    assert_true(same(&uniform, &refined, setup->levels));
    flow_steps(&uniform, setup->steps * sub);
    flow_steps(&refined, setup->steps);
    amr_print(&refined, setup->name);
    assert_true(uniform.state->t == refined.state->t);
    assert_int_equal(refined.state->counts.retries + uniform.state->counts.retries, 0);
    if (!same(&uniform, &refined, setup->levels)) fail_msg("%s differs from the uniform fine mesh", setup->name);
    flow_stop(&uniform);
    flow_stop(&refined);
}

static void test_subcycled(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof SETUPS / sizeof *SETUPS; i++) check(&SETUPS[i], true);
}

static void test_one_step(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof SETUPS / sizeof *SETUPS; i++) check(&SETUPS[i], false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_subcycled),
        cmocka_unit_test(test_one_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
