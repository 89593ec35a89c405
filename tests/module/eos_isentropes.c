/* eos_isentropes.c - water compressed isentropically from 1e5 Pa and 288.15 K to 10 GPa by every liquid model, against
 * IAPWS-95. With BULLA_FIGURES in the environment the rows of the table in docs/thermodynamics.md are printed. Tables
 * of the same isentropes by another program: eos_waves.c. */
#include "waves.h"

/* A model, the pressure up to which it has a state, and its largest errors of T and rho, per cent: up to 1 GPa and up
 * to 10. */
struct liquid {
    const char *module, *preset;
    double most, T[2], rho[2];
};

static const struct liquid liquids[] = {
    {"stiffened-gas", "sg235", 1.1e10, {35.8, 151}, {54.7, 131}},
    {"stiffened-gas", "sg3", 1.1e10, {52.9, 245}, {11.8, 45.6}},
    {"stiffened-gas", "sg4", 1.1e10, {90.2, 446}, {8.0, 25.2}},
    {"stiffened-gas", "sg44", 1.1e10, {94.5, 483}, {5.6, 17.3}},
    {"stiffened-gas", "sg659", 1.1e10, {160, 885}, {4.0, 4.0}},
    {"nasg", "water", 1.1e10, {5.0, 5.0}, {6.2, 14.8}},
    {"mnasg", "water", 1.1e10, {6.2, 6.3}, {1.1, 16.2}},
    {"tait", "water", 1.1e10, {6.8, 33.1}, {0.5, 4.1}},
    {"modified-tait", "published", 1.1e9, {1.2, 1.2}, {6.6, 6.6}},
    {"modified-tait", "refit", 1.1e10, {1.4, 5.5}, {1.1, 1.2}},
};

enum { MODELS = sizeof liquids / sizeof *liquids };

/* Errors of all models at a state of IAPWS-95 (columns rho, T, p), and the largest so far, up to 1 GPa and further. */
static void compare(const struct law *laws, const struct wave_state *starts, const double *column,
                    double most[MODELS][2][2])
{
    bool print = getenv("BULLA_FIGURES") != NULL;
    double p = column[2];
    if (print) printf("| %.3g |", 1e-9 * p);
    for (size_t i = 0; i < MODELS; i++) {
        if (print && p > liquids[i].most) printf(" |");
        if (p > liquids[i].most) continue;
        struct wave_state at = wave_isentrope(&laws[i], starts[i], p);
        double off[2] = {100.0 * (at.T / column[1] - 1.0), 100.0 * (at.rho / column[0] - 1.0)};
        if (print) printf(" %+.1f, %+.1f |", off[0], off[1]);
        for (int k = 0; k < 2; k++)
            for (int far = p > 1.01e9 ? 1 : 0; far < 2; far++)
                most[i][far][k] = fabs(off[k]) > most[i][far][k] ? fabs(off[k]) : most[i][far][k];
    }
    if (print) printf("\n");
}

/* Every model is as far off as the list says, to a tenth of it. */
static void test_against_iapws(void **state)
{
    (void)state;
    struct law laws[MODELS];
    struct wave_state starts[MODELS];
    double most[MODELS][2][2] = {{{0.0}}}, next = 9e5;
    for (size_t i = 0; i < MODELS; i++) {
        laws[i] = law_preset(liquids[i].module, liquids[i].preset);
        starts[i] = wave_start(&laws[i], 1e5, 288.15);
    }
    char line[1024];
    FILE *file = fopen("tests/data/eos/iapws95_isentrope_1bar_288K.csv", "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file)) {
        double column[3];
        char *at = line;
        if (line[0] == '#') continue;
        for (int i = 0; i < 3; i++, at += *at == ',') column[i] = strtod(at, &at);
        bool last = column[2] > 9.9e9;
        if (column[2] > 1.1e10 || (column[2] < next && !last)) continue;
        compare(laws, starts, column, most);
        next = 1.9 * column[2];
    }
    fclose(file);
    for (size_t i = 0; i < MODELS; i++) {
        for (int far = 0; far < 2; far++) {
            support_near(liquids[i].preset, most[i][far][0], liquids[i].T[far], 0.1, liquids[i].T[far]);
            support_near(liquids[i].preset, most[i][far][1], liquids[i].rho[far], 0.1, liquids[i].rho[far]);
        }
        instance_done(&laws[i].instance);
    }
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
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_against_iapws), cmocka_unit_test(test_cold_density)};
    return cmocka_run_group_tests(tests, support_start, support_stop);
}
