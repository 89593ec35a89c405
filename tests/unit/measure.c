/* Centroids and means of layers in curved geometry against their integrals: cells weigh by their volumes, and stand at
 * the middle of those, not half way between their faces. */
#include "io/measure.h"

#include "flow.h"

/* Air from r = 1/4 to 1/2 of a ball or a cylinder, between faces of only eight cells. */
static void start(struct flow *flow, int beta)
{
    flow_start(flow,
               mem_print("bulla: 1\ntitle: shell\ndomain: {geometry: %s, lower: [0%s], upper: [1%s], cells: [8%s], "
                         "boundaries: {x-: %s, x+: outflow%s}}\nmesh: {tile: 8}\nmaterials:\n" FLOW_WATER FLOW_AIR
                         "initial:\n  - {everywhere: true, material: water, density: 1000, pressure: 1e5}\n"
                         "  - {box: {lower: [0.25%s], upper: [0.5%s]}, material: air, density: 1, pressure: 3e5}\n"
                         "run: {until: 1}\noutput: {history: {columns: {r: {centroid: air, along: r}, p: {mean: "
                         "pressure}, V: {volume: air}}}}\n",
                         beta == 1 ? "axisymmetric" : "spherical", beta == 1 ? ", 0" : "", beta == 1 ? ", 1" : "",
                         beta == 1 ? ", 8" : "", beta == 1 ? "axis" : "symmetry",
                         beta == 1 ? ", y-: outflow, y+: outflow" : "", beta == 1 ? ", -1" : "",
                         beta == 1 ? ", 2" : ""));
}

static void test_shell(void **state)
{
    (void)state;
    for (int beta = 1; beta <= 2; beta++) {
        struct flow flow;
        struct measures *measures;
        double values[3], n = beta + 1.0, a = 0.25, b = 0.5;
        start(&flow, beta);
        assert_int_equal(measure_new(flow.state, &measures), 0);
        struct derive_moment moment = derive_moment(flow.state->model, flow.state->mesh, 0.0);
        measure_take(measures, flow.state, &moment, NULL, values);
        double volume = pow(b, n) - pow(a, n), centroid = n / (n + 1.0) * (pow(b, n + 1.0) - pow(a, n + 1.0)) / volume;
        assert_true(fabs(values[0] - centroid) <= 1e-14);
        assert_true(fabs(values[1] - (1e5 + 2e5 * volume)) <= 1e-9 * 1e5);
        assert_true(fabs(values[2] / (volume * (beta == 1 ? M_PI : 4.0 * M_PI / 3.0)) - 1.0) <= 1e-14);
        measure_free(measures);
        flow_stop(&flow);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_shell)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
