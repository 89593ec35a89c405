/* Two pairs of liquid and vapour in one scene, both with an `onset`: what evaporates is the liquid of the pair whose
 * mark a cell has, in its cells and in no others. */
#include "phase_box.h"

#include "scheme/phase_change.h"

enum { CELLS = 4, PAIRS = 2 };

/* A mixture of nine tenths of the liquid of pair k with its vapour, all at T and 1 bar, in cell i. */
static void fill(const struct model *model, unsigned k, double T, size_t i, double *w)
{
    const struct model_phase *phase = &model->phases[k];
    double p = 1e5;
    for (unsigned j = 0; j < 2; j++) {
        unsigned l = phase->member[j];
        w[(model->i_alpha + l) * CELLS + i] = j ? 0.1 : 0.9;
        model->eos[l].law->density(model->eos[l].self, 1, &p, &T, &w[(model->i_m + l) * CELLS + i]);
    }
    w[model->i_E * CELLS + i] = p;
}

/* Vapour of pair k that cell i has gained. */
static double gained(const struct model *model, unsigned k, const double *before, const double *after, size_t i)
{
    size_t at = (model->i_m + model->phases[k].member[EQUILIBRIUM_VAPOUR]) * CELLS + i;
    return after[at] - before[at];
}

/* Water in cells 0 and 1, dodecane in 2 and 3, both above saturation; `shore`: one row of marks per pair. */
static void acts(struct flow *flow, const unsigned char *shore, double ret_gained[CELLS])
{
    static const double T[PAIRS] = {376.0, 510.0};
    const struct model *model = flow->state->model;
    double w[FLOW_FIELDS * CELLS] = {0}, u[FLOW_FIELDS * CELLS] = {0}, before[FLOW_FIELDS * CELLS];
    for (size_t i = 0; i < CELLS; i++) {
        for (unsigned l = 0; l < model->n_material; l++) w[(model->i_m + l) * CELLS + i] = 1.0;
        fill(model, i < 2 ? 0 : 1, T[i / 2], i, w);
    }
    mix_conserved(model, CELLS, CELLS, w, u);
    memcpy(before, u, sizeof u);
    phase_change_operator.acts(&(struct operator_tile){.model = model,
                                                       .mesh = flow->state->mesh,
                                                       .level = flow_level(flow),
                                                       .n_cell = CELLS,
                                                       .dt = 1e-6,
                                                       .u = u,
                                                       .w = w,
                                                       .shore = shore});
    for (size_t i = 0; i < CELLS; i++) {
        ret_gained[i] = gained(model, i < 2 ? 0 : 1, before, u, i);
        assert_true(gained(model, i < 2 ? 1 : 0, before, u, i) == 0.0);
    }
}

static void test_marks(void **state)
{
    (void)state;
    static const unsigned char shores[][PAIRS * CELLS] = {{0, 0, 0, 0, 0, 0, 0, 0},
                                                          {1, 0, 0, 0, 0, 0, 0, 1},
                                                          {0, 0, 1, 1, 1, 1, 0, 0},
                                                          {1, 1, 1, 1, 0, 0, 0, 0}};
    static const char *const expected[] = {"0000", "1001", "0000", "1100"};
    struct flow flow;
    phase_box_open(&flow,
                   PHASE_BOX_NASG "  oil: {eos: {type: stiffened-gas, preset: dodecane-2004}}\n"
                                  "  fume: {eos: {type: ideal-gas, preset: dodecane-2004}}\n",
                   "{liquid: water, vapour: steam, onset: 0.5}\n  - {liquid: oil, vapour: fume, onset: 0.9}", 8, "");
    for (size_t n = 0; n < sizeof shores / sizeof *shores; n++) {
        double made[CELLS];
        acts(&flow, shores[n], made);
        for (size_t i = 0; i < CELLS; i++) assert_true(expected[n][i] == '1' ? made[i] > 0.0 : made[i] == 0.0);
    }
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_marks)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
