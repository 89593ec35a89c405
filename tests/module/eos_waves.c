/* eos_waves.c - isentropes, shocks and shock tubes of the liquid models, from the laws' own functions, against those
 * that another program found with the same models (tests/data/eos). */
#include "waves.h"

/* A model: its names in the files (NULL: not there), the module and its settings; the published modified Tait law has
 * states in its range up to 1 GPa only. */
struct model {
    const char *star, *curve, *module, *sets[4];
    double most;
};

static const struct model models[] = {
    {"IAPWS95", NULL, "iapws95", {"eval=analytic"}, 0.0},
    {"SG_g2.35_1e9_cv1816", "SG_g2.35_1e9_cv1816", "stiffened-gas", {"preset=sg235"}, 1.1e10},
    {"SG_g3_8.533e8_cv1395", "SG_g3_8.533e8_cv1395", "stiffened-gas", {"preset=sg3"}, 1.1e10},
    {"SG_g4_6e8", NULL, "stiffened-gas", {"gamma=4", "p-inf=6e8", "cv=1000"}, 0.0},
    {NULL, "SG_g4_6e8_cvfit", "stiffened-gas", {"gamma=4", "p-inf=6e8", "cv=694.823"}, 1.1e10},
    {"SG_g4.4_6e8", NULL, "stiffened-gas", {"gamma=4.4", "p-inf=6e8", "cv=1000"}, 0.0},
    {"NASG", "NASG", "nasg", {"preset=water"}, 1.1e10},
    {"MNASG", "MNASG", "mnasg", {"preset=water"}, 1.1e10},
    {"MTait_pub_c0=1480", "pub_c0=1480", "modified-tait", {"preset=published"}, 1.1e9},
    {"MTait_refit", "refit", "modified-tait", {"preset=refit"}, 1.1e10},
};

enum { MODELS = sizeof models / sizeof *models };

/* The numbers behind `begin` of each row that begins so, into `use`; returns how many rows. */
static int rows_of(const char *name, const char *begin,
                   void (*use)(const struct model *, const struct law *, const double *), const struct model *model,
                   const struct law *law)
{
    char line[1024];
    int count = 0;
    snprintf(line, sizeof line, "tests/data/eos/%s", name);
    FILE *file = fopen(line, "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file)) {
        double column[16] = {0};
        if (strncmp(line, begin, strlen(begin)) != 0) continue;
        char *at = line + strlen(begin);
        for (int i = 0; i < 16 && *at; i++, at += *at == ',') column[i] = strtod(at, &at);
        use(model, law, column);
        count++;
    }
    fclose(file);
    return count;
}

/* rhoL, rhoR, cL, cR, p*, u*, shock speed, rhoL*, TL*, cL*, rhoR*, TR* */
static void check_star(const struct model *model, const struct law *law, const double *column)
{
    struct wave_tube tube = wave_tube(law, 1e9, 1e5, 300.0);
    const double got[12] = {tube.left.rho,  tube.right.rho, tube.left.c,      tube.right.c,
                            tube.star[0].p, tube.u,         tube.shock,       tube.star[0].rho,
                            tube.star[0].T, tube.star[0].c, tube.star[1].rho, tube.star[1].T};
    for (int i = 0; i < 12; i++) support_near(model->star, got[i], column[i], 1e-8, column[i]);
}

static void test_tubes(void **state)
{
    (void)state;
    char begin[64];
    int count = 0;
    for (size_t i = 0; i < MODELS; i++) {
        if (!models[i].star) continue;
        struct law law = law_open(models[i].module, models[i].sets);
        snprintf(begin, sizeof begin, "%s,", models[i].star);
        count += rows_of("shocktube_star_states.csv", begin, check_star, &models[i], &law);
        instance_done(&law.instance);
    }
    assert_int_equal(count, 9);
}

/* Models' tables: p, T, T error, rise error, rho, rho error, c; modified Tait's: p, T, T of IAPWS, error, rho, rho of
 * IAPWS, error, c, ... */
static void check_state(const struct model *model, struct wave_state at, const double *column)
{
    bool tait = strcmp(model->module, "modified-tait") == 0;
    double T = column[1], rho = column[4], c = column[tait ? 7 : 6];
    support_near("T", at.T, T, 3e-6, T);
    support_near("rho", at.rho, rho, 5e-6, rho);
    support_near("c", at.c, c, 5e-6, c);
}

static void check_hugoniot(const struct model *model, const struct law *law, const double *column)
{
    if (column[0] <= model->most) check_state(model, wave_shock(law, wave_start(law, 1e5, 300.0), column[0]), column);
}

static void check_isentrope(const struct model *model, const struct law *law, const double *column)
{
    if (column[0] <= model->most)
        check_state(model, wave_isentrope(law, wave_start(law, 1e5, 288.15), column[0]), column);
}

static void test_curves(void **state)
{
    (void)state;
    char begin[64];
    for (size_t i = 0; i < MODELS; i++) {
        if (!models[i].curve) continue;
        bool tait = strcmp(models[i].module, "modified-tait") == 0;
        const char *file = tait ? "mtait_error_table.csv" : "liquid_models_vs_iapws.csv";
        struct law law = law_open(models[i].module, models[i].sets);
        snprintf(begin, sizeof begin, "hugoniot,%s,", models[i].curve);
        assert_int_equal(rows_of(file, begin, check_hugoniot, &models[i], &law), tait ? 13 : 9);
        snprintf(begin, sizeof begin, "isentrope,%s,", models[i].curve);
        assert_int_equal(rows_of(file, begin, check_isentrope, &models[i], &law), tait ? 13 : 9);
        instance_done(&law.instance);
    }
}

/* Columns: rho, T, p, ..., us, up at 12 and 13. Jump conditions with the law's own energies, and the shock found from
 * p. */
static double start_T;

static void check_water(const struct law *law, const double *column)
{
    double rho = column[0], T = column[1], p = column[2], us, up;
    struct wave_state from = wave_start(law, 1e5, start_T), to = wave_shock(law, from, p);
    if (law->eos->count_outside(law->instance.self, 1, &rho, &p)) return;
    wave_shock_speeds(from, to, &us, &up);
    support_near("rho", to.rho, rho, 1e-9, rho);
    support_near("T", to.T, T, 1e-9, T);
    support_near("us", us, column[12], 1e-6, us); /* densities differ by 4e-4 in the first row */
    support_near("up", up, column[13], 1e-6, up);
    struct law_point at = law_at(law, rho, p), rest = law_at(law, from.rho, from.p);
    double work = 0.5 * (p + from.p) * (1.0 / from.rho - 1.0 / rho);
    support_near("energy over the shock", at.rho_e / rho - rest.rho_e / from.rho, work, 1e-9,
                 work + 2.0 * fabs(at.rho_e / rho));
}

static void test_hugoniots_of_water(void **state)
{
    (void)state;
    static const char *const evals[] = {"eval=analytic", "eval=table"};
    for (size_t i = 0; i < 2; i++) {
        struct law law = law_open("iapws95", (const char *const[]){evals[i], NULL});
        start_T = 288.15;
        assert_in_range(law_rows("iapws95_hugoniot_1bar_288K.csv", 14, check_water, &law), 40, 100);
        start_T = 300.0;
        assert_in_range(law_rows("iapws95_hugoniot_1bar_300K.csv", 14, check_water, &law), 40, 100);
        instance_done(&law.instance);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_tubes), cmocka_unit_test(test_curves),
                                       cmocka_unit_test(test_hugoniots_of_water)};
    return cmocka_run_group_tests(tests, support_start, support_stop);
}
