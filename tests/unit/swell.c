/* Volume that heat asks for (scheme/swell.h): by the compliance of each material; a trace of gas that is below zero
 * pressure has none, and would else make the sum of the compliances 0. */
#include "flow.h"

#include "scheme/swell.h"

static void test_stiffness(void **state)
{
    (void)state;
    struct flow flow;
    static struct swell swell;
    flow_start(&flow, mem_text("bulla: 1\ntitle: swell\ndomain: {lower: [0], upper: [1], cells: [8], boundaries: {x-: "
                               "periodic, x+: periodic}}\nmaterials:\n" FLOW_WATER FLOW_AIR
                               "initial:\n  - {everywhere: true, material: water, density: 1000, pressure: 1e5}\nrun: "
                               "{until: 1}\n"));
    const double air = 1e-7, K = 2.64e9, water = 1.0 - air;
    const double alpha[2][3] = {{water, water, 0.5}, {air, air, 0.5}}, rho[2][3] = {{1000, 1000, 1000}, {1, 1, 1}};
    const double p[2][3] = {{1e5, 1e5, 1e5}, {1e5, -190, 1e5}}, heat[2][3] = {{1e9, 1e9, 1e9}, {1e9, 1e9, 1e9}};
    const double rho_c2[2][3] = {{K, K, K}, {1.4e5, -air * K, 1.4e5}}; /* in the middle S would be 0 */
    swell_begin(&swell, flow.state->model, 3);
    for (unsigned l = 0; l < 2; l++) swell_material(&swell, l, alpha[l], rho[l], p[l], rho_c2[l], heat[l], NULL);
    assert_true(swell.compliance[1][0] > 0.0 && swell.own[1][0] > 0.0);
    assert_true(swell.compliance[1][1] == 0.0 && swell.own[1][1] == 0.0);
    assert_true(swell.all[1] == swell.compliance[0][1] && swell.all[1] > 0.9 / K);
    assert_true(fabs(swell.own[1][2] / (0.5 / 1.4e5 * 1e9 / 2.5) - 1.0) < 1e-14); /* e = p/0.4 */
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_stiffness)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
