/* Liquids and vapours beside traces of materials that are none of their pair. */
#include "phase_box.h"

/* Vapour that stretched water makes, beside a trace of another gas, which bears no tension. */
static double torn_beside(double fume)
{
    struct flow flow;
    phase_box_open(&flow, PHASE_BOX_NASG "  fume: {eos: {type: ideal-gas, preset: dodecane-2004}}\n",
                   "{liquid: water, vapour: steam}", 8, "");
    const struct model *model = flow.state->model;
    const double part[] = {1.0 - 5e-6 - fume, 5e-6, fume}, p = -25e6, m[] = {946.0, 6.5e-6, 3e-7 * fume};
    double u[FLOW_FIELDS] = {0}, w[FLOW_FIELDS] = {0}, rho_e, rho_c2;
    for (unsigned l = 0; l < 3; l++) {
        const double rho = m[l] / part[l];
        u[model->i_alpha + l] = part[l];
        u[model->i_m + l] = m[l];
        if (part[l] > 0.0) model->eos[l].law->state(model->eos[l].self, 1, &rho, &p, &rho_e, &rho_c2);
        u[model->i_E] += part[l] > 0.0 ? part[l] * rho_e : 0.0;
    }
    w[model->i_E] = p;
    phase_act(model, 0, 1, 1, 1e-6, 0.0, NULL, w, u, &(struct equilibrium_effort){0});
    double vapour = u[model->i_m + 1];
    flow_stop(&flow);
    return vapour;
}

static void test_torn(void **state)
{
    (void)state;
    double none = torn_beside(0.0), trace = torn_beside(3e-10);
    print_message("vapour of stretched water %.6g kg/m3, beside a trace of a gas %.6g\n", none, trace);
    assert_true(none > 1e-5 && none < 1.0 && fabs(trace / none - 1.0) < 1e-4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_torn)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
