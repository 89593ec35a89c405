/* Relaxation of one cell (relax.h) in strong expansions, where liquids ask for tension and gases are near vacuum: it
 * ends in a state that all materials bear, with what is conserved untouched, and the volumes follow from each
 * material's own change. */
#include "flow.h"

#include "phys/relax.h"
#include "solve/guard.h"

enum { POINTS = 3000 };

struct pair {
    const char *liquid, *gas;
};

static const struct pair PAIRS[] = {
    {"{eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}", "{eos: {type: ideal-gas, gamma: 1.4}}"},
    {"{eos: {type: mnasg, preset: water}}", "{eos: {type: rkpr}}"},
    {"{eos: {type: tait}}", "{eos: {type: peng-robinson}}"},
    {"{eos: {type: modified-tait}}", "{eos: {type: rkpr}}"},
};

/* A state before, with both materials, and what a step has left of the masses. */
static void draw(const struct model *model, uint64_t *seed, double *u_old, double *u)
{
    double w[FLOW_FIELDS] = {0}, p = 1e3 * pow(1e5, flow_random(seed)), air = pow(10.0, -8.0 * flow_random(seed));
    double T[2] = {290.0 + 100.0 * flow_random(seed), 300.0 + 2000.0 * flow_random(seed)};
    if (flow_random(seed) < 0.3) air = 1.0 - air;
    w[model->i_alpha] = 1.0 - air;
    w[model->i_alpha + 1] = air;
    for (unsigned l = 0; l < 2; l++) model->eos[l].law->density(model->eos[l].self, 1, &p, &T[l], &w[model->i_m + l]);
    w[model->i_u] = 20.0;
    w[model->i_E] = p;
    mix_conserved(model, 1, 1, w, u_old);
    double left[2] = {1.0 - 0.4 * pow(flow_random(seed), 4.0), 1.0 - 0.999 * flow_random(seed)}, lost = 0.0;
    memcpy(u, u_old, model->n_field * sizeof *u);
    for (unsigned l = 0; l < 2; l++) {
        lost += (1.0 - left[l]) * u_old[model->i_m + l];
        u[model->i_m + l] *= left[l];
    }
    double share = 1.0 - lost / (u_old[model->i_m] + u_old[model->i_m + 1]);
    u[model->i_u] *= share;
    u[model->i_E] *= share;
}

/* Stiffened water and ideal gas, of which most stayed: from its state of before, e + p0 v, each goes to
 *     v = v0 [p0 + gamma P + (gamma - 1) p]/(gamma (p + P)),
 * so that the gas tells the pressure and the water must agree. */
static bool agrees(const struct model *model, const double *u_old, const double *u)
{
    static const double gamma[2] = {4.4, 1.4}, P = 6e8;
    double w[FLOW_FIELDS] = {0}, p0, ratio[2];
    mix_primitives(model, 1, 1, u_old, w);
    p0 = w[model->i_E];
    for (unsigned l = 0; l < 2; l++) {
        bool own = u_old[model->i_m + l] < 2.0 * u[model->i_m + l]; /* else the density with which it arrived */
        ratio[l] = u[l] / u[model->i_m + l] * (own ? w[model->i_m + l] : u[model->i_m + l] / u_old[l]);
    }
    double p = p0 / (gamma[1] * ratio[1] - (gamma[1] - 1.0));
    double wanted = (p0 + gamma[0] * P + (gamma[0] - 1.0) * p) / (gamma[0] * (p + P));
    return fabs(ratio[0] - wanted) <= 1e-9 * wanted;
}

static void check_pair(const struct pair *pair)
{
    struct flow flow;
    uint64_t seed = 4;
    int good = 0, fair = 0, kept = 0;
    flow_start(&flow,
               mem_print("bulla: 1\ntitle: relax\ndomain: {lower: [0], upper: [1], cells: [8], boundaries: {x-: "
                         "outflow, x+: outflow}}\nmaterials:\n  water: %s\n  air: %s\ninitial:\n  - {everywhere: "
                         "true, material: water, density: 998, pressure: 1 bar}\nrun: {until: 1}\n",
                         pair->liquid, pair->gas));
    const struct model *model = flow.state->model;
    for (int i = 0; i < POINTS; i++) {
        double u_old[FLOW_FIELDS], u[FLOW_FIELDS], w[FLOW_FIELDS] = {0}, before[FLOW_FIELDS], stiff[2];
        draw(model, &seed, u_old, u);
        memcpy(before, u, sizeof u);
        w[model->i_E] = 1e5;
        if (!relax_cell(model, 1, u_old, u, w)) continue;
        fair++;
        for (unsigned q = model->i_m; q < model->i_V; q++) assert_true(u[q] == before[q]);
        assert_true(fabs(u[0] + u[1] - 1.0) < 1e-15 && u[0] >= 0.0 && u[1] >= 0.0);
        mix_stiffness(model, 1, 1, w, stiff);
        kept += pair == PAIRS && agrees(model, u_old, u);
        good += isfinite(w[model->i_E]) && (w[0] <= GUARD_PRESENT || stiff[0] > 0.0) &&
                (w[1] <= GUARD_PRESENT || stiff[1] > 0.0);
    }
    print_message("%s + %s: %d of %d relaxed, %d good, %d as by hand\n", pair->liquid, pair->gas, fair, POINTS, good,
                  kept);
    assert_true(fair == POINTS && good == POINTS);
    if (pair == PAIRS) assert_true(kept > POINTS / 2); /* where the energy asked for no other volumes */
    flow_stop(&flow);
}

static void test_expansion(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof PAIRS / sizeof *PAIRS; i++) check_pair(&PAIRS[i]);
}

/* A mist that was stretched until its air has less than a kelvin at 9 kg/m3, where the law of air has two volumes at
 * one pressure and energy: what a step has left of it must not take the other one, 1e2 times as wide. */
static void test_cold_mist(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow, mem_print("bulla: 1\ntitle: mist\ndomain: {lower: [0], upper: [1], cells: [8], boundaries: {x-: "
                                "outflow, x+: outflow}}\nmaterials:\n  water: {eos: {type: tait, preset: water}}\n"
                                "  air: {eos: {type: helmholtz-air, table-size: 64}}\ninitial:\n  - {everywhere: "
                                "true, material: water, density: 998, pressure: 1 bar}\nrun: {until: 1}\n"));
    const struct model *model = flow.state->model;
    const double p[] = {5.6, 50.0, 691.6, 1113.7, 3005.5, 2e4};
    for (size_t i = 0; i < sizeof p / sizeof *p; i++) {
        double w[FLOW_FIELDS] = {0}, u_old[FLOW_FIELDS], u[FLOW_FIELDS];
        w[model->i_alpha] = 0.687;
        w[model->i_alpha + 1] = 0.313;
        w[model->i_m] = 996.7;
        w[model->i_m + 1] = 8.67;
        w[model->i_E] = p[i];
        mix_conserved(model, 1, 1, w, u_old);
        memcpy(u, u_old, sizeof u);
        for (unsigned l = 0; l < 2; l++) u[model->i_m + l] *= 1.0 - 2e-5;
        u[model->i_E] *= 1.0 - 2e-5;
        bool relaxed = relax_cell(model, 1, u_old, u, w);
        print_message("%g Pa: %s, water fills %.4f at %.4g Pa\n", p[i], relaxed ? "relaxed" : "refused",
                      u[model->i_alpha], w[model->i_E]);
        assert_true(!relaxed || (fabs(u[model->i_alpha] - 0.687) < 0.01 && w[model->i_E] < 1e8));
    }
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_expansion), cmocka_unit_test(test_cold_mist)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
