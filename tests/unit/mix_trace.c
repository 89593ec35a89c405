/* A trace of which the closure has left almost no volume: denser than its law states, it counts with the greatest
 * density that it does and the volume that its mass then takes; the pressure of the rest follows. */
#include "flow.h"

/* Water, stiffened gas with a heat bond, in air. */
static const double GAMMA = 2.35, P_INF = 1e9, BOND = -1167e3;

/* The pressure at which air and m kg/m3 of water in the fraction `alpha` hold the energy rho_e. */
static double pressure(const struct model *model, double alpha, double m, double rho_e, double *ret_w)
{
    double u[FLOW_FIELDS] = {0};
    u[model->i_alpha] = alpha;
    u[model->i_alpha + 1] = 1.0 - alpha;
    u[model->i_m] = m;
    u[model->i_m + 1] = 1.2;
    u[model->i_E] = rho_e;
    ret_w[model->i_E] = 1e5;
    mix_primitives(model, 1, 1, u, ret_w);
    return ret_w[model->i_E];
}

static void test_dense(void **state)
{
    (void)state;
    struct flow flow;
    double w[FLOW_FIELDS];
    flow_start(&flow,
               mem_print(
                   "bulla: 1\ntitle: trace\ndomain: {lower: [0], upper: [1], cells: [8], boundaries: {x-: "
                   "outflow, x+: outflow}}\nmaterials:\n  water: {eos: {type: stiffened-gas, preset: sg235}}\n" FLOW_AIR
                   "initial:\n  - {everywhere: true, material: air, density: 1, pressure: 1e5}\n"
                   "run: {until: 1}\n"));
    const struct model *model = flow.state->model;
    double most = model->eos[0].rho_most;
    assert_true(most > 1100.0 && most < 1e5);
    for (double m = 1e-7; m < 2e-3; m *= 10.0) {
        double room = m / most, rho_e = 1e5 / 0.4; /* rho e = p/0.4 + room (p + gamma P)/(gamma - 1) + m q */
        double wanted = (rho_e - room * GAMMA * P_INF / (GAMMA - 1.0) - m * BOND) / (1.0 / 0.4 + room / (GAMMA - 1.0));
        double p = pressure(model, 1e-13, m, rho_e, w);
        print_message("%g kg/m3 in 1e-13: %.6f Pa, not %.6f\n", m, p, wanted);
        assert_true(fabs(p - wanted) <= 1e-6 * (1.0 + fabs(wanted - 1e5)));
        assert_true(w[model->i_alpha] == 0.0 && w[model->i_alpha + 1] == 1.0); /* fluxes see no trace */
    }
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_dense)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
