/* A cell that is cut within one fluid whose law is a curve: it has the pressure of both sides, and their masses. */
#include "flow.h"

static const char box[] =
    "domain: {lower: [0], upper: [1], cells: [8], boundaries: {x-: reflecting, x+: reflecting}}\n";

/* Largest distance of the pressures of all cells from 1 bar; the mass. */
static double disturbed(const char *eos, double *ret_mass)
{
    struct flow flow;
    double most = 0.0;
    flow_start(&flow,
               mem_print("bulla: 1\ntitle: press\n%smaterials: {water: {eos: %s}}\ninitial:\n"
                         "  - {everywhere: true, material: water, temperature: 300, pressure: 1e5}\n"
                         "  - {box: {lower: [0.31], upper: [0.6]}, material: water, temperature: 350, pressure: 1e5}\n"
                         "run: {until: 1}\n",
                         box, eos));
    double *p = flow_primitive(&flow, flow.state->model->i_E), *m = flow_conserved(&flow, flow.state->model->i_m);
    *ret_mass = 0.0;
    for (size_t i = 0; i < flow.n_cell; i++) {
        most = fmax(most, fabs(p[i] - 1e5));
        *ret_mass += m[i] / (double)flow.n_cell;
    }
    mem_free(p);
    mem_free(m);
    flow_stop(&flow);
    return most;
}

static void test_real(void **state)
{
    (void)state;
    double mass;
    assert_true(disturbed("{type: iapws95, preset: water, table-size: 64}", &mass) < 1.0); /* 5 MPa */
    assert_true(fabs(mass / (0.71 * 996.557 + 0.29 * 973.702) - 1.0) < 1e-5);              /* IAPWS-95 at 1 bar */
    assert_true(disturbed("{type: tait, preset: water}", &mass) < 1.0);                    /* 0.18 MPa */
    assert_true(disturbed("{type: nasg, preset: water-2016}", &mass) < 1.0);               /* linear: as it was */
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_real)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
