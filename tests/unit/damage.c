/* How solids break, on single cells: damage grows towards the aim of its law, no faster than its time allows, and never
 * back; what elastic energy it frees is heat, to round-off; stress and speeds fall as (1 - D)^2; a broken cell in
 * tension opens at the pressure of its void, with masses, momentum and energy what they were. */
#include "flow.h"

#include "phys/bearing.h"
#include "phys/cavity.h"
#include "phys/damage.h"
#include "phys/elastic.h"
#include "phys/traction.h"

static const double RHO = 1060.0, MU = 2e6, GAMMA = 4.4, P_INF = 6e8;

/* A gel that can break, air, and a metal that cannot, in one dimension. */
static void start(struct flow *flow, const char *damage)
{
    flow_start(flow,
               mem_print("bulla: 1\n"
                         "domain: {lower: [0], upper: [1], cells: [16], boundaries: {x-: periodic, x+: periodic}}\n"
                         "materials:\n"
                         "  air: {eos: {type: ideal-gas, gamma: 1.4, cv: 718 J/kg/K}}\n"
                         "  gel:\n"
                         "    eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}\n"
                         "    constitutive: {type: neo-hookean, shear-modulus: 2 MPa, reference-density: 1060}\n"
                         "    damage: %s\n"
                         "initial: [{everywhere: true, material: gel, density: 1060, pressure: 1e5}]\n"
                         "run: {until: 1}\n"
                         "output: {directory: out}\n",
                         damage));
}

/* A cell of a fraction of gel, pulled to a stretch along x, at a pressure, with some damage: primitives and conserved
 * fields. */
static void cell(const struct model *model, double gel, double stretch, double p, double D, double *w, double *u)
{
    for (unsigned q = 0; q < model->n_field; q++) w[q] = 0.0;
    w[0] = 1.0 - gel;
    w[1] = gel;
    w[model->i_m] = 1.2;
    w[model->i_m + 1] = RHO;
    w[model->i_u] = 3.0;
    w[model->i_E] = p;
    w[model->i_inner] = D;
    w[model->i_V] = stretch;
    w[model->i_V + 1] = w[model->i_V + 2] = 1.0 / sqrt(stretch);
    mix_conserved(model, 1, 1, w, u);
}

/* Elastic energy per mass of whole gel. */
static double energy(double stretch)
{
    return 0.5 * MU / RHO * (stretch * stretch + 2.0 / stretch - 3.0);
}

static void near(double got, double want, double tolerance)
{
    if (!(fabs(got - want) <= tolerance)) fail_msg("%.17g instead of %.17g", got, want);
}

static void test_grows(void **state)
{
    (void)state;
    struct flow flow;
    start(&flow, "{type: stretch, begins: 1.2, ends: 1.6, time: 1 ms}");
    const struct model *model = flow.state->model;
    double w[FLOW_FIELDS], u[FLOW_FIELDS], before[FLOW_FIELDS];
    assert_true(model->damaged && model->n_memory == 1 && !model->plastic);
    cell(model, 1.0, 1.5, 1e5, 0.1, w, u);
    memcpy(before, u, sizeof u);
    damage_grow(model, 1, 1, 3e-4, w, NULL, u); /* rate-limited: 0.1 + 0.3 */
    near(u[model->i_inner], 0.4 * RHO, 1e-12 * RHO);
    for (unsigned q = 0; q < model->n_field; q++)
        if (q != model->i_inner) assert_true(u[q] == before[q]);
    mix_primitives(model, 1, 1, u, w);
    near(w[model->i_inner], 0.4, 1e-15);
    double freed = RHO * energy(1.5) * (0.81 - 0.36); /* of (1 - D)^2 */
    near(w[model->i_E], 1e5 + (GAMMA - 1.0) * freed, 1e-5);
    damage_grow(model, 1, 1, 1e-3, w, NULL, u); /* as far as the law says: 0.75 */
    near(u[model->i_inner], 0.75 * RHO, 1e-9 * RHO);
    mix_primitives(model, 1, 1, u, w);
    memcpy(before, u, sizeof u);
    cell(model, 1.0, 1.1, 1e5, 0.75, w, u); /* never back, and what does not break keeps its bits */
    memcpy(before, u, sizeof u);
    damage_grow(model, 1, 1, 1.0, w, NULL, u);
    assert_memory_equal(u, before, model->n_field * sizeof *u);
    cell(model, 1.0, 2.0, 1e5, 0.75, w, u); /* broken: bears nothing, has no stretch */
    damage_grow(model, 1, 1, 1.0, w, NULL, u);
    assert_true(u[model->i_inner] == RHO && u[model->i_V] == 1.0 && u[model->i_V + 1] == 1.0);
    flow_stop(&flow);
}

static void test_bears(void **state)
{
    (void)state;
    struct flow flow;
    start(&flow, "{type: stretch, begins: 1.2}");
    const struct model *model = flow.state->model;
    double w[FLOW_FIELDS], u[FLOW_FIELDS], back[FLOW_FIELDS], stiff[SCENE_MATERIALS], c2[2], own[SCENE_MATERIALS];
    for (int i = 0; i < 2; i++) { /* alone, and in a mixture */
        double gel = i ? 0.7 : 1.0, D = 0.4, g = 0.36;
        cell(model, gel, 1.3, 1e5, D, w, u);
        double kinetic = 0.5 * (gel * RHO + (1.0 - gel) * 1.2) * 9.0;
        traction_own(model, 1, 1, w, 1, own);
        double deviator = 2.0 / 3.0 * MU * (1.69 - 1.0 / 1.3); /* s'_xx of the whole gel */
        near(own[1], g * deviator, 1e-9 * deviator);
        if (i) continue; /* pressures differ there */
        near(u[model->i_E], kinetic + (1e5 + GAMMA * P_INF) / (GAMMA - 1.0) + g * RHO * energy(1.3), 1e-6);
        memcpy(back, w, sizeof w);
        mix_primitives(model, 1, 1, u, back);
        for (unsigned q = 0; q < model->n_field; q++)
            if (q != model->i_m) near(back[q], w[q], 1e-9 * (1.0 + fabs(w[q]))); /* there is no air */
        mix_stiffness(model, 1, 1, w, stiff);
        mix_speed2(model, 1, 1, w, stiff, &c2[0]);
        w[model->i_inner] = 0.0;
        mix_speed2(model, 1, 1, w, stiff, &c2[1]);
        double fluid = stiff[1] / RHO;
        near(c2[0] - fluid, g * (c2[1] - fluid), 1e-9 * fluid);
    }
    flow_stop(&flow);
}

static void test_opens(void **state)
{
    (void)state;
    struct flow flow;
    start(&flow, "{type: tension, stress: 1 MPa, opens: air, void-pressure: 2 kPa}");
    const struct model *model = flow.state->model;
    static const double pulls[] = {-2e6, -2e8, -5e7};
    double w[FLOW_FIELDS], u[FLOW_FIELDS], before[FLOW_FIELDS];
    for (int i = 0; i < 3; i++) {
        cell(model, 1.0, 1.0, pulls[i], 1.0, w, u);
        memcpy(before, u, sizeof u);
        cavity_open(model, 1, 1, w, u);
        double opened = u[0] - before[0];
        near(opened, -pulls[i] / (GAMMA * P_INF), 1e-2 * opened); /* by which the gel relaxes */
        near(u[0] + u[1], 1.0, 1e-15);
        near(u[model->i_m] + u[model->i_m + 1], RHO, 1e-12 * RHO);
        near(u[model->i_m], opened * 2e3 / (0.4 * 718.0 * 300.0), 1e-12);
        assert_true(u[model->i_u] == before[model->i_u] && u[model->i_E] == before[model->i_E]);
        assert_true(u[model->i_inner] == u[model->i_m + 1]);
        mix_primitives(model, 1, 1, u, w);
        near(w[model->i_E], 2e3, 1.0);
        memcpy(before, u, sizeof u);
        cavity_open(model, 1, 1, w, u); /* no second time */
        assert_memory_equal(u, before, model->n_field * sizeof *u);
    }
    for (int i = 0; i < 2; i++) { /* whole, or pressed: nothing opens */
        cell(model, 1.0, 1.0, i ? 1e4 : -2e6, i ? 1.0 : 0.99, w, u);
        memcpy(before, u, sizeof u);
        cavity_open(model, 1, 1, w, u);
        assert_memory_equal(u, before, model->n_field * sizeof *u);
    }
    flow_stop(&flow);
}

static void pulled(const struct model *model, const double x[3], double *w)
{
    w[model->i_u] = 10.0 * sin(6.283185307179586 * x[0]);
    w[model->i_E] = -3e7;
}

/* In tension beyond what it bears, everywhere: every cell breaks and opens in the same step, and what is shaken then
 * stays a state. */
static void test_everywhere(void **state)
{
    (void)state;
    struct flow flow;
    double size;
    start(&flow, "{type: tension, stress: 1 MPa, opens: air, time: 1 us}");
    const struct model *model = flow.state->model;
    flow_set(&flow, pulled);
    long double before = flow_total(&flow, model->i_E, &size);
    flow_steps(&flow, 100);
    assert_true(fabsl(flow_total(&flow, model->i_E, &size) - before) < 1e-14L * size);
    double *D = flow_primitive(&flow, model->i_inner), *air = flow_primitive(&flow, 0);
    double *p = flow_primitive(&flow, model->i_E), most = 0.0;
    for (size_t c = 0; c < flow.n_cell; c++) {
        assert_true(D[c] == 1.0 && air[c] > 1e-4 && p[c] > 0.0);
        most = air[c] > most ? air[c] : most;
    }
    assert_true(most > 0.02); /* the gaps are where it was pulled apart */
    mem_free(D);
    mem_free(air);
    mem_free(p);
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_grows), cmocka_unit_test(test_bears),
                                       cmocka_unit_test(test_opens), cmocka_unit_test(test_everywhere)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
