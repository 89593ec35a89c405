/* Weight: what pressure holds stays at rest, in a column with walls and open ends, and through levels beside
 * interfaces. */
#include "flow.h"

/* Water under air; `above`: the boundary at the upper end. */
static void start(struct flow *flow, const char *above, const char *scheme)
{
    flow_start(flow,
               mem_print("bulla: 1\ntitle: weight\ndomain: {lower: [0], upper: [0.1], cells: [32], boundaries: {x-: "
                         "reflecting, x+: %s}}\nmaterials:\n" FLOW_WATER FLOW_AIR
                         "sources: {acceleration: [-9.81]}\nscheme: {%s}\ninitial:\n"
                         "  - {everywhere: true, material: air, density: 1.2, pressure: = 1e5 - 11.772 * (x - 0.05)}\n"
                         "  - {box: {lower: [0], upper: [0.05]}, material: water, density: 1000, pressure: = 1e5 - "
                         "9810 * (x - 0.05)}\nrun: {until: 1}\n",
                         above, scheme));
}

static double fastest(const struct flow *flow, unsigned axis)
{
    double *u = flow_primitive(flow, flow->state->model->i_u + axis), most = 0.0;
    for (size_t c = 0; c < flow->n_cell; c++) most = fabs(u[c]) > most ? fabs(u[c]) : most;
    mem_free(u);
    return most;
}

static void test_column(void **state)
{
    static const char *const above[] = {"reflecting", "outflow", "non-reflecting"},
                             *const scheme[] = {"limiter: mc", "limiter: superbee", "reconstruction: weno5-z",
                                                "limiter: koren, interface-limiter: thinc"};
    (void)state;
    for (int i = 0; i < 4; i++) {
        struct flow flow;
        start(&flow, above[i % 3], scheme[i]);
        flow_steps(&flow, 200);
        assert_true(fastest(&flow, 0) < 1e-9);
        flow_stop(&flow);
    }
}

/* What pressure does not hold falls: gas in a closed box that begins to be accelerated, before waves from the walls
 * come. */
static void test_falls(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow,
               mem_print("bulla: 1\ntitle: falls\ndomain: {lower: [0], upper: [1], cells: [64], boundaries: {x-: "
                         "reflecting, x+: reflecting}}\nmaterials:\n" FLOW_AIR
                         "sources: {acceleration: [= 100 * (1 + x)]}\ninitial:\n"
                         "  - {everywhere: true, material: air, density: 1.2, pressure: 1e5}\nrun: {until: 1}\n"));
    flow_until(&flow, 1e-4);
    double *u = flow_primitive(&flow, flow.state->model->i_u), x = 32.5 / 64.0;
    assert_true(fabs(u[32] / (1e-4 * 100.0 * (1.0 + x)) - 1.0) < 1e-3);
    assert_true(u[0] < 0.5 * u[32] && u[63] < 0.5 * u[32]);
    mem_free(u);
    flow_stop(&flow);
}

/* A finer level that ends across the interface, at a wall, and in the middle of a layer. */
static void test_levels(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow,
               mem_print("bulla: 1\ntitle: weight\ndomain: {lower: [0, 0], upper: [0.1, 0.1], cells: [16, 16], "
                         "boundaries: {x-: reflecting, x+: reflecting, y-: reflecting, y+: outflow}}\n"
                         "mesh: {tile: 4, levels: 1, buffer: 0, refine: [{region: {box: {lower: [0.03, 0], upper: "
                         "[0.06, 0.08]}}}]}\nmaterials:\n" FLOW_WATER FLOW_AIR
                         "sources: {acceleration: [0, -9.81]}\ninitial:\n"
                         "  - {everywhere: true, material: air, density: 1.2, pressure: = 1e5 - 11.772 * (y - 0.05)}\n"
                         "  - {box: {lower: [0, 0], upper: [0.1, 0.05]}, material: water, density: 1000, pressure: "
                         "= 1e5 - 9810 * (y - 0.05)}\nrun: {until: 1}\n"));
    assert_int_equal(flow.state->mesh->n_level, 2);
    flow_steps(&flow, 60);
    assert_true(fastest(&flow, 0) < 1e-9);
    assert_true(fastest(&flow, 1) < 1e-9);
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_column),
        cmocka_unit_test(test_falls),
        cmocka_unit_test(test_levels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
