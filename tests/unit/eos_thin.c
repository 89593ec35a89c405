/* eos_thin.c - gases down to nothing: what a cell holds that is torn empty. Below any density that tables reach a gas
 * is ideal: energy, temperature and speed of sound depend on p/rho alone, entropy falls as -R ln rho. */
#include "flow.h"

static void check_thin(const char *law)
{
    struct flow flow;
    flow_start(&flow,
               mem_print("bulla: 1\ndomain: {lower: [0], upper: [1], cells: [8], boundaries: {x-: periodic, x+: "
                         "periodic}}\nmaterials:\n  gas: {eos: {%s}}\ninitial:\n  - {everywhere: true, material: "
                         "gas, density: 0.1, pressure: 20 kPa}\nrun: {until: 1}\n",
                         law));
    const struct model_eos *eos = &flow.state->model->eos[0];
    double thin = 1e-7, p_thin = thin * 1.2e5, e0, c0, T0, s0, fall = 0.0;
    eos->law->state(eos->self, 1, &thin, &p_thin, &e0, &c0);
    eos->law->temperature(eos->self, 1, &thin, &p_thin, &T0);
    eos->law->entropy(eos->self, 1, &thin, &p_thin, &s0);
    for (int k = 1; k < 60; k++) {
        double rho = thin * pow(10.0, -k), p = rho * 1.2e5, e, c, T, s, e_p, e_r;
        eos->law->state(eos->self, 1, &rho, &p, &e, &c);
        eos->law->temperature(eos->self, 1, &rho, &p, &T);
        eos->law->derivatives(eos->self, 1, &rho, &p, &e_p, &e_r);
        eos->law->entropy(eos->self, 1, &rho, &p, &s);
        if (!(fabs(e / rho - e0 / thin) < 1e-6 * c0 / thin && fabs(T / T0 - 1.0) < 1e-6))
            fail_msg("%s: %g kg/m3 has %g J/kg and %g K, %g has %g and %g", law, rho, e / rho, T, thin, e0 / thin, T0);
        assert_true(fabs(c / rho * thin / c0 - 1.0) < 1e-6);
        assert_true(fabs((e_r * rho + e_p * p) / e - 1.0) < 1e-6); /* rho e grows as both do */
        fall = k == 1 ? s - s0 : fall;                             /* R ln 10 */
        assert_true(fall > 0.0 && fabs((s - s0) / (k * fall) - 1.0) < 1e-6);
    }
    flow_stop(&flow);
}

static void test_thin(void **state)
{
    (void)state;
    static const char *const laws[] = {
        "type: helmholtz-air, preset: air, table-size: 64",
        "type: helmholtz-air, preset: air, interpolation: bicubic",
        "type: iapws95-vapour, preset: water-vapour",
        "type: rkpr, preset: air",
        "type: peng-robinson, preset: air",
        "type: ideal-gas, preset: air",
    };
    for (size_t i = 0; i < sizeof laws / sizeof *laws; i++) check_thin(laws[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_thin)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
