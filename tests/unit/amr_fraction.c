/* A mixture of the same fractions everywhere keeps them while waves run through its levels, if its materials do not give each
 * other volume (Allaire closure): what fluxes of fractions lack at a coarse-fine face, the face velocities sweep. */
#include "amr.h"

static void set_waves(const struct model *model, const double x[3], double *w)
{
    double wave = sin(2.0 * M_PI * x[0]) * (x[1] == 0.0 ? 1.0 : cos(2.0 * M_PI * x[1]));
    w[model->i_E] = 1e5 * (1.0 + 0.5 * wave);
    w[model->i_u] = 50.0 * wave;
}

static void check_fractions(const char *domain, const char *region)
{
    struct flow flow;
    flow_start(
        &flow,
        mem_print("bulla: 1\ntitle: fractions\ndomain: %s\nmesh: {levels: 1, tile: 8, regrid-every: 100, buffer: "
                  "41, refine: [{region: %s}]}\nmaterials:\n" FLOW_HELIUM FLOW_AIR
                  "initial:\n  - {everywhere: true, fractions: {helium: 0.7, air: 0.3}, density: {helium: 0.2, "
                  "air: 1.2}, pressure: 1e5}\nscheme: {closure: allaire}\nrun: {until: 1}\n",
                  domain, region));
    amr_set(&flow, set_waves, NULL);
    flow_steps(&flow, 20);
    double off = amr_deviation(&flow, flow.state->model->i_alpha + 1, 0.3);
    amr_print(&flow, "fractions");
    print_message("off by %.1e\n", off);
    assert_true(flow.state->mesh->n_level == 2 && off < 1e-13);
    flow_stop(&flow);
}

static void test_fractions(void **state)
{
    (void)state;
    check_fractions("{lower: [0], upper: [1], cells: [128], boundaries: {x-: periodic, x+: periodic}}",
                    "{box: {lower: [0.3], upper: [0.6]}}");
    check_fractions(
        "{geometry: axisymmetric, lower: [0, 0], upper: [1, 1], cells: [48, 48], boundaries: {x-: axis, x+: "
        "reflecting, y-: periodic, y+: periodic}}",
        "{box: {lower: [0.3, 0.3], upper: [0.6, 0.6]}}");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_fractions)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
