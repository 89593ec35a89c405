/* The length of steps: a tenth of what repeated steps have taken comes back with every good one, and a repeated step is half
 * as long as the one before. */
#include "flow.h"

static void start(struct flow *flow, const char *scheme)
{
    flow_start(flow,
               mem_print("bulla: 1\ntitle: steps\ndomain: {lower: [0], upper: [1], cells: [32], boundaries: {x-: "
                         "periodic, x+: periodic}}\nmaterials:\n" FLOW_AIR
                         "initial:\n  - {everywhere: true, material: air, density: 1, pressure: 1e5, velocity: [30]}\n"
                         "scheme: {%s}\nrun: {until: 1}\n",
                         scheme));
}

static void test_recover(void **state)
{
    (void)state;
    static const char *const schemes[] = {"cfl: 0.5", "dt: 1 us"};
    for (int i = 0; i < 2; i++) {
        struct flow flow;
        start(&flow, schemes[i]);
        double whole = advance_dt(flow.state), wanted = 0.5;
        flow.state->dt_shrink = 0.5; /* as a repeated step leaves it */
        for (int step = 0; step < 12; step++) {
            assert_true(fabs(advance_dt(flow.state) / (whole * wanted) - 1.0) < 1e-12);
            flow_steps(&flow, 1);
            assert_true(fabs(flow.state->dt / (whole * wanted) - 1.0) < 1e-12);
            wanted = fmin(1.0, 1.1 * wanted);
        }
        assert_true(wanted == 1.0 && flow.state->dt_shrink == 1.0);
        flow_stop(&flow);
    }
}

static void set_parting(const struct model *model, const double x[3], double *w)
{
    w[model->i_u] = x[0] > 0.5 ? 1500.0 : -1500.0;
}

/* A fixed step far too long: every attempt is half as long as the last, and so is what is left for the steps after it. */
static void test_halved(void **state)
{
    (void)state;
    struct flow flow;
    start(&flow, "dt: 400 us, limiter: superbee");
    flow_set(&flow, set_parting);
    flow_steps(&flow, 1);
    long long retries = flow.state->counts.retries;
    print_message("%lld retries, dt = %g s\n", retries, flow.state->dt);
    assert_true(retries > 0);
    assert_true(flow.state->dt == ldexp(400e-6, -(int)retries) && flow.state->t == flow.state->dt);
    assert_true(fabs(flow.state->dt_shrink / ldexp(1.1, -(int)retries) - 1.0) < 1e-15);
    flow_stop(&flow);
}

/* The signal is the sum over the axes of (|u| + c)/h. */
static void test_signal(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow,
               mem_print("bulla: 1\ntitle: signal\ndomain: {lower: [0, 0, 0], upper: [1, 2, 4], cells: [8, 8, 8], "
                         "boundaries: {x-: periodic, x+: periodic, y-: periodic, y+: periodic, z-: periodic, z+: "
                         "periodic}}\nmaterials:\n" FLOW_AIR
                         "initial:\n  - {everywhere: true, material: air, density: 1.4, pressure: 1e4, velocity: "
                         "[-10, 20, 40]}\nscheme: {cfl: 0.5}\nrun: {until: 1}\n"));
    double wanted = 0.5 / ((10.0 + 100.0) * 8.0 + (20.0 + 100.0) * 4.0 + (40.0 + 100.0) * 2.0);
    assert_true(fabs(advance_dt(flow.state) / wanted - 1.0) < 1e-12);
    flow_steps(&flow, 1);
    assert_true(fabs(advance_dt(flow.state) / wanted - 1.0) < 1e-12);
    flow_stop(&flow);
}

/* Both halves of a finer level's step know their time: heat that grows with t, taken at midpoints, adds up exactly. */
static void test_time(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow,
               mem_print(
                   "bulla: 1\ntitle: time\ndomain: {lower: [0], upper: [1], cells: [32], boundaries: {x-: periodic, "
                   "x+: periodic}}\nmesh: {levels: 1, tile: 8, refine: [{region: {box: {lower: [0], upper: "
                   "[1]}}}]}\nmaterials:\n" FLOW_AIR
                   "initial:\n  - {everywhere: true, material: air, density: 1, pressure: 1e5}\n"
                   "sources: {heating: \"= 1e12 * t\"}\nscheme: {dt: 10 us}\nrun: {until: 1}\n"));
    flow_steps(&flow, 10);
    const struct mesh *mesh = flow.state->mesh;
    double t = flow.state->t, wanted = 1e5 + 0.4 * 0.5e12 * t * t;
    const double *p = mesh->levels[1].w[0] + flow.state->model->i_E * mesh->n_cell;
    print_message("p = %.9g Pa, should be %.9g\n", p[3], wanted);
    assert_int_equal(mesh->n_level, 2);
    assert_true(fabs(p[3] / wanted - 1.0) < 1e-12);
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_recover), cmocka_unit_test(test_halved),
                                       cmocka_unit_test(test_signal), cmocka_unit_test(test_time)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
