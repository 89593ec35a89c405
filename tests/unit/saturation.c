/* Saturation curves of the presets against saturation_pairs.csv, and the speeds of sound of their mixtures against
 * sound_speeds.csv: frozen, Wood's, and the slopes of the solver's pressures, with one temperature and with exchange.
 */
#include "phase_box.h"

#include "case/saturation.h"
#include "scheme/wood.h"

struct preset {
    const char *name, *materials;
};

static const struct preset presets[] = {{"sg-water-2004", PHASE_BOX_SG},
                                        {"sg-water-2017", PHASE_BOX_SG_2017},
                                        {"nasg-water-2016", PHASE_BOX_NASG},
                                        {"sg-dodecane-2004", PHASE_BOX_DODECANE}};

enum { PRESETS = sizeof presets / sizeof *presets, COLUMNS = 9 };

/* Calls `row` with the numbers of each line of a table that begins with the name of the preset; their number. */
static int each(const char *path, const struct preset *preset,
                void (*row)(const struct model *model, const double *value, double *worst), double *worst)
{
    struct flow flow;
    int rows = 0;
    char line[512];
    size_t name = strlen(preset->name);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    phase_box_open(&flow, preset->materials, "{liquid: water, vapour: steam}", 4, "");
    while (fgets(line, sizeof line, file)) {
        double value[COLUMNS] = {0};
        char *at = line + name;
        if (strncmp(line, preset->name, name) != 0) continue;
        for (int i = 0; i < COLUMNS && *at == ','; i++) value[i] = strtod(at + 1, &at);
        row(flow.state->model, value, worst);
        rows++;
    }
    fclose(file);
    flow_stop(&flow);
    return rows;
}

static void miss(double found, double right, double *worst)
{
    double off = fabs(found / right - 1.0);
    if (!(off <= *worst)) *worst = off;
}

/* T, p, rho_l, rho_v, h_l, h_v, s_l, s_v; enthalpies by their difference, entropies likewise. */
static void check_curve(const struct model *model, const double *value, double *worst)
{
    struct saturation both;
    assert_true(saturation_of(&model->scene->material[0].eos, &model->scene->material[1].eos, &both));
    double T = value[0], p = value[1];
    struct saturation_state at = saturation_at(&both, p, T);
    miss(saturation_pressure(&both, T), p, worst);
    miss(saturation_temperature(&both, p), T, worst);
    miss(1.0 / at.v[0], value[2], worst);
    miss(1.0 / at.v[1], value[3], worst);
    miss(at.h[1] - at.h[0], value[5] - value[4], worst);
    miss(at.s[1] - at.s[0], value[7] - value[6], worst);
}

static void test_curves(void **state)
{
    (void)state;
    for (int i = 0; i < PRESETS; i++) {
        double worst = 0.0;
        int rows = each("tests/data/phase/saturation_pairs.csv", &presets[i], check_curve, &worst);
        print_message("%s: %d rows, off by %.2g\n", presets[i].name, rows, worst);
        assert_true(rows == 37 && worst < 1e-10);
    }
}

/* The primitives of a saturated mixture. */
static void mixture(const struct model *model, double T, double p, double alpha, double *w)
{
    memset(w, 0, FLOW_FIELDS * sizeof *w);
    for (unsigned l = 0; l < 2; l++) {
        w[model->i_alpha + l] = l ? alpha : 1.0 - alpha;
        model->eos[l].law->density(model->eos[l].self, 1, &p, &T, &w[model->i_m + l]);
    }
    w[model->i_E] = p;
}

/* The pressure of its equilibrium, with exchange of mass or without, when it has another volume by a small work p dv.
 */
static double squeezed(const struct model *model, const double *w, bool exchange, double v)
{
    struct equilibrium_family family = {.n = 2};
    struct equilibrium_cells cells = {.n = 1, .p = {w[model->i_E]}};
    for (unsigned l = 0; l < 2; l++) {
        double p = w[model->i_E], rho = w[model->i_m + l], rho_e, rho_c2;
        family.eos[l] = model->eos[l];
        model->eos[l].law->state(model->eos[l].self, 1, &rho, &p, &rho_e, &rho_c2);
        if (!l) model->eos[l].law->temperature(model->eos[l].self, 1, &rho, &p, &cells.T[0]);
        cells.m[l][0] = w[model->i_alpha + l] * rho / v;
        cells.energy[0] += w[model->i_alpha + l] * rho_e / v;
    }
    cells.energy[0] -= w[model->i_E] * (v - 1.0) / v;
    family.exchange = exchange;
    equilibrium_solve(&family, &cells, &(struct equilibrium_effort){0});
    return cells.p[0];
}

/* T, p, alpha_v, Y_v, rho, frozen, Wood's, pT, equilibrium. */
static void check_speeds(const struct model *model, const double *value, double *worst)
{
    double w[FLOW_FIELDS], rho_c2[2], c2, give = 0.0, alpha = value[2], rho = value[4], v = 1e-5;
    mixture(model, value[0], value[1], alpha, w);
    mix_stiffness(model, 1, 1, w, rho_c2);
    mix_speed2(model, 1, 1, w, rho_c2, &c2);
    for (unsigned l = 0; l < 2; l++) wood_give(1, l, &w[model->i_alpha + l], &rho_c2[l], &give);
    miss(sqrt(c2), value[5], &worst[0]);
    miss(sqrt(1.0 / (rho * give)), value[6], &worst[0]);
    if (alpha < 0.05 || alpha > 0.95) return;
    for (int exchange = 0; exchange < 2; exchange++) {
        double slope = (squeezed(model, w, exchange, 1.0 - v) - squeezed(model, w, exchange, 1.0 + v)) / (2.0 * v);
        miss(sqrt(slope / rho), value[7 + exchange], &worst[1]);
    }
}

static void test_speeds(void **state)
{
    (void)state;
    for (int i = 0; i < PRESETS; i++) {
        double worst[2] = {0.0, 0.0};
        int rows = each("tests/data/phase/sound_speeds.csv", &presets[i], check_speeds, worst);
        print_message("%s: %d rows, frozen and Wood off by %.2g, pT and equilibrium by %.2g\n", presets[i].name, rows,
                      worst[0], worst[1]);
        assert_true(rows > 20 && worst[0] < 1e-9 && worst[1] < 1e-4);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_curves), cmocka_unit_test(test_speeds)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
