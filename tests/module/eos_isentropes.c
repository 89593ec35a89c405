/* eos_isentropes.c - water compressed isentropically from 1e5 Pa and 288.15 K to 10 GPa: every liquid model against tables
 * that another program made of the same models, and against IAPWS-95. With BULLA_FIGURES in the environment the errors
 * that docs/thermodynamics.md lists are printed. */
#include "law.h"

/* A model: what the reference tables call it, and the pressure up to which they list it. */
struct liquid {
    const char *module, *preset, *name;
    double most;
};

static const struct liquid liquids[] = {
    {"stiffened-gas", "sg235", "SG_g2.35_1e9_cv1816", 1.1e10},
    {"stiffened-gas", "sg3", "SG_g3_8.533e8_cv1395", 1.1e10},
    {"nasg", "water", "NASG", 1.1e10},
    {"mnasg", "water", "MNASG", 1.1e10},
    {"modified-tait", "published", "pub_c0=1480", 1.1e9},
    {"modified-tait", "refit", "refit", 1.1e10},
    {"stiffened-gas", "sg4", NULL, 1.1e10},
    {"tait", "water", NULL, 1.1e10},
    {"iapws95", NULL, NULL, 1.1e10},
};

/* The density at which the entropy is s: it falls with rho at constant p. */
static double isentrope_density(const struct law *law, double p, double s)
{
    double low = 300.0, high = 6000.0, at;
    for (int i = 0; i < 100; i++) {
        double mean = 0.5 * (low + high);
        law->eos->entropy(law->instance.self, 1, &mean, &p, &at);
        if (at > s) low = mean;
        else high = mean;
    }
    return low;
}

static struct law open_liquid(const struct liquid *liquid)
{
    static const double defaults[32] = {128.0};
    if (liquid->preset) return law_preset(liquid->module, liquid->preset);
    struct law law = {.instance = support_open(support_module("eos", liquid->module), defaults)};
    law.eos = law.instance.module->table;
    return law;
}

/* Rows "isentrope,name,p,..." with T in column `T` and rho in column `rho` (counted from p as 0). */
static int check_file(const char *name, const struct liquid *liquid, const struct law *law, int T_column,
                      int rho_column)
{
    char line[1024], begin[64];
    snprintf(line, sizeof line, "tests/data/eos/%s", name);
    FILE *file = fopen(line, "r");
    assert_non_null(file);
    snprintf(begin, sizeof begin, "isentrope,%s,", liquid->name);
    double s = law_at(law, law_density(law, 1e5, 288.15), 1e5).s;
    int count = 0;
    while (fgets(line, sizeof line, file)) {
        if (strncmp(line, begin, strlen(begin)) != 0) continue;
        double column[8];
        char *at = line + strlen(begin);
        for (int i = 0; i < 8; i++, at += *at == ',') column[i] = strtod(at, &at);
        if (column[0] > liquid->most) continue;
        double rho = isentrope_density(law, column[0], s);
        support_near("T", law_at(law, rho, column[0]).T, column[T_column], 3e-6, column[T_column]);
        support_near("rho", rho, column[rho_column], 1e-5, rho);
        count++;
    }
    fclose(file);
    return count;
}

static void test_models(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof liquids / sizeof *liquids; i++) {
        if (!liquids[i].name) continue;
        struct law law = open_liquid(&liquids[i]);
        bool tait = strcmp(liquids[i].module, "modified-tait") == 0;
        int count = tait ? check_file("mtait_error_table.csv", &liquids[i], &law, 1, 4)
                         : check_file("liquid_models_vs_iapws.csv", &liquids[i], &law, 1, 4);
        assert_in_range(count, 6, 20);
        instance_done(&law.instance);
    }
}

/* One row of IAPWS-95 for all models; `most` collects the errors of the refitted Tait law. */
static void compare(const struct law *laws, const double *s, const double *column, double most[2])
{
    enum { MODELS = sizeof liquids / sizeof *liquids };
    double rho_true = column[0], T_true = column[1], p = column[2];
    bool print = getenv("BULLA_FIGURES") != NULL;
    if (print) printf("%8.3g", p);
    for (size_t i = 0; i < MODELS; i++) {
        if (p > liquids[i].most) continue;
        double rho = isentrope_density(&laws[i], p, s[i]), T = law_at(&laws[i], rho, p).T;
        double off_T = 100.0 * (T / T_true - 1.0), off_rho = 100.0 * (rho / rho_true - 1.0);
        if (print)
            printf(" | %s %s %+.2f %+.2f", liquids[i].module, liquids[i].preset ? liquids[i].preset : "", off_T,
                   off_rho);
        if (i != 5) continue;
        most[0] = fabs(off_T) > most[0] ? fabs(off_T) : most[0];
        most[1] = fabs(off_rho) > most[1] ? fabs(off_rho) : most[1];
    }
    if (print) printf("\n");
}

/* The refit stays within 5.6 % of the temperature and 1.3 % of the density up to 10 GPa. */
static void test_against_iapws(void **state)
{
    (void)state;
    enum { MODELS = sizeof liquids / sizeof *liquids };
    struct law laws[MODELS];
    double s[MODELS], most[2] = {0.0, 0.0}, next = 9e5;
    for (size_t i = 0; i < MODELS; i++) {
        laws[i] = open_liquid(&liquids[i]);
        s[i] = law_at(&laws[i], law_density(&laws[i], 1e5, 288.15), 1e5).s;
    }
    char line[1024];
    FILE *file = fopen("tests/data/eos/iapws95_isentrope_1bar_288K.csv", "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file)) {
        double column[3];
        char *at = line;
        if (line[0] == '#') continue;
        for (int i = 0; i < 3; i++, at += *at == ',') column[i] = strtod(at, &at);
        if (column[2] < next || column[2] > 1.1e10) continue;
        compare(laws, s, column, most);
        next = 1.9 * column[2];
    }
    fclose(file);
    assert_true(most[0] > 4.0 && most[0] < 5.6 && most[1] < 1.3);
    for (size_t i = 0; i < MODELS; i++) instance_done(&laws[i].instance);
}

/* Cold at high pressure a temperature may belong to no state of IAPWS-95's domain: the density is that of its edge. */
static void test_cold_density(void **state)
{
    (void)state;
    struct law law = law_preset("iapws95", "water");
    for (int i = 0; i < 2000; i++) {
        double p = 1e9 * pow(10.0, fmod(0.618 * i, 1.0)), T = 290.0 + 0.06 * i;
        support_near("T", law_at(&law, law_density(&law, p, T), p).T, T, 1e-9, T);
    }
    instance_done(&law.instance);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_models), cmocka_unit_test(test_against_iapws),
                                       cmocka_unit_test(test_cold_density)};
    return cmocka_run_group_tests(tests, support_start, support_stop);
}
