/* Boundaries where levels end: fine tiles at every kind of boundary behave as coarse ones do. Two mirrored halves are
 * one whole, waves come in and leave at a level's speed, and a level at the edge changes little. */
#include "amr.h"

#define MESH "mesh: {levels: 2, tile: 8, regrid-every: 2, buffer: 2, patience: 1, refine: [%s]}\n"
#define WATER "materials:\n" FLOW_WATER FLOW_AIR

/* The largest difference of the half run from the whole one over leaves of the half, relative to the size of a
 * field. */
static double half_difference(const struct flow *half, const struct flow *whole)
{
    const struct model *model = half->state->model;
    struct amr_leaves leaves = amr_leaves(half);
    double worst = 0.0;
    for (size_t i = 0; i < leaves.n; i++)
        for (unsigned q = 0; q < model->n_field; q++) {
            struct amr_leaf other = {0};
            mesh_locate(whole->state->mesh, leaves.all[i].x, &other.l, &other.tile, &other.cell);
            if (other.l != leaves.all[i].l) worst = HUGE_VAL;
            else if (amr_conserved(half, &leaves.all[i], q) != amr_conserved(whole, &other, q)) worst = HUGE_VAL;
        }
    mem_free(leaves.all);
    return worst;
}

static void check_half(int dim, const char *wall)
{
    static const char *const CENTRES[] = {"[0]", "[0, 0.1]"};
    struct flow flow[2];
    for (int whole = 0; whole < 2; whole++) {
        char *x = mem_print("x-: %s, x+: outflow", whole ? "outflow" : wall);
        char *domain = dim == 1 ? mem_print("{lower: [%d], upper: [1], cells: [%d], boundaries: {%s}}", -whole,
                                            whole ? 128 : 64, x)
                                : mem_print("{lower: [%d, -1], upper: [1, 1], cells: [%d, 32], boundaries: {%s, y-: "
                                            "reflecting, y+: non-reflecting}}",
                                            -whole, whole ? 32 : 16, x);
        flow_start(&flow[whole],
                   mem_print("bulla: 1\ntitle: half\ndomain: %s\n" MESH WATER "initial:\n"
                             "  - {everywhere: true, material: water, density: 1000, pressure: 1e5}\n"
                             "  - {sphere: {center: %s, radius: 0.3}, material: air, density: 100, pressure: 3e7}\n"
                             "run: {until: 1}\n",
                             domain, "{interface: air}, {jump: pressure, above: 0.9, finest: 1}", CENTRES[dim - 1]));
        mem_free(domain);
        mem_free(x);
        flow_steps(&flow[whole], 40);
    }
    amr_print(&flow[0], wall);
    assert_true(flow[0].state->t == flow[1].state->t);
    assert_true(flow[0].state->mesh->n_level == 3 && flow[0].state->counts.regrids > 1);
    assert_true(half_difference(&flow[0], &flow[1]) == 0.0);
    flow_stop(&flow[0]);
    flow_stop(&flow[1]);
}

static void test_mirror(void **state)
{
    (void)state;
    check_half(1, "reflecting");
    check_half(1, "symmetry");
    check_half(2, "reflecting");
    check_half(2, "symmetry");
}

/* The largest gauge pressure right of x = 0.5 while the wave of a boundary passes, and after it has left. */
static void wave_passes(const char *refine, const char *sides, double *ret_passing, double *ret_after)
{
    struct flow flow;
    flow_start(&flow,
               mem_print("bulla: 1\ntitle: wave\ndomain: {lower: [0], upper: [1], cells: [128], boundaries: {%s}}\n"
                         "mesh: {levels: 2, tile: 8, refine: [%s]}\n"
                         "materials:\n" FLOW_WATER "initial:\n"
                         "  - {everywhere: true, material: water, density: 1000, pressure: 1e5}\n"
                         "run: {until: 1}\n",
                         sides, refine));
    *ret_passing = 0.0;
    while (flow.state->t < 7.5e-4) {
        flow_steps(&flow, 1);
        *ret_passing = fmax(*ret_passing, amr_value(&flow, (const double[]){0.5, 0, 0}, flow.state->model->i_E) - 1e5);
    }
    flow_until(&flow, 1.6e-3);
    *ret_after = amr_deviation(&flow, flow.state->model->i_E, 1e5);
    flow_stop(&flow);
}

static void test_waves(void **state)
{
    (void)state;
    const char *sides = "x-: {type: incoming-wave, pulse: gaussian, amplitude: 1 kPa, center: 200 us, width: 60 us}, "
                        "x+: non-reflecting";
    static const char *const REFINES[] = {"{region: {box: {lower: [0.4], upper: [0.6]}}}",
                                          "{region: {box: {lower: [0], upper: [0.1]}}}",
                                          "{region: {box: {lower: [0.9], upper: [1]}}}",
                                          "{lua: '= math.abs(x - 1625 * (t - 200e-6)) < 0.2'}"};
    for (size_t i = 0; i < sizeof REFINES / sizeof *REFINES; i++) {
        double passing, after;
        wave_passes(REFINES[i], sides, &passing, &after);
        print_message("%s: passes with %.2f Pa, leaves %.3f Pa\n", REFINES[i], passing, after);
        assert_true(fabs(passing - 985.0) < 15.0);
        assert_true(after < 5.0);
    }
}

/* A channel with inflow, outflow and walls, refined at each side in turn: a uniform flow stays what it is. */
static void test_channel(void **state)
{
    (void)state;
    static const char *const BOXES[] = {"lower: [0, 0], upper: [0.2, 1]", "lower: [0.8, 0], upper: [1, 1]",
                                        "lower: [0, 0], upper: [1, 0.2]", "lower: [0, 0.6], upper: [0.4, 1]"};
    static const char *const WALLS[] = {"reflecting", "no-slip"};
    for (int i = 0; i < 8; i++) {
        struct flow flow;
        char *refine = mem_print("{region: {box: {%s}}}", BOXES[i / 2]);
        flow_start(&flow,
                   mem_print("bulla: 1\ntitle: channel\ndomain: {lower: [0, 0], upper: [1, 1], cells: [32, 32], "
                             "boundaries: {x-: {type: inflow, material: air, density: 1.2, pressure: 1e5, "
                             "velocity: [400, 0]}, x+: outflow, y-: %s, y+: symmetry}}\n" MESH "materials:\n" FLOW_AIR
                             "initial:\n"
                             "  - {everywhere: true, material: air, density: 1.2, pressure: 1e5, velocity: [400, "
                             "0]}\nrun: {until: 1}\n",
                             WALLS[i % 2], refine));
        flow_steps(&flow, 40);
        double off = amr_deviation(&flow, flow.state->model->i_E, 1e5) / 1e5;
        double back = amr_value(&flow, (const double[]){0.9, 0.9, 0}, flow.state->model->i_u);
        print_message("%s, %s: pressure off by %.1e, %g m/s far from the wall\n", refine, WALLS[i % 2], off, back);
        assert_true(flow.state->mesh->n_level == 3);
        assert_true(off < 1e-12);
        assert_true(fabs(back - 400.0) < 1e-6);
        mem_free(refine);
        flow_stop(&flow);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_mirror),
        cmocka_unit_test(test_waves),
        cmocka_unit_test(test_channel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
