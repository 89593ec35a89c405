/* eos_thermal.c - IAPWS-95 in phase change: liquid on the saturation curve by `thermal`, where it has no state, and
 * cells of it with an ideal vapour at equilibrium; their cost. */
#include "phase_pairs.h"

#include "case/saturation.h"

#include <time.h>

static struct law open_water(const char *eval)
{
    char set[32];
    snprintf(set, sizeof set, "eval=%s", eval);
    return law_open("iapws95", (const char *const[]){set, NULL});
}

struct thermal {
    double rho, v, h, s, v_T, v_p, c_p;
};

static struct thermal thermal_at(const struct law *law, double p, double T, double guess)
{
    struct thermal at = {.rho = guess};
    law->eos->thermal(law->instance.self, 1, &p, &T, &at.rho, &at.v, &at.h, &at.s, &at.v_T, &at.v_p, &at.c_p);
    return at;
}

/* The liquid of saturation_iapws95.csv up to 620 K: the formulas to round-off of the rows, the table to what it says of
 * itself. */
static void test_saturated(void **state)
{
    (void)state;
    static const char *const evals[] = {"analytic", "table"};
    for (int way = 0; way < 2; way++) {
        struct law law = open_water(evals[way]);
        double worst = 0.0, T, p, rho, rho_v, h, h_v, s, heat;
        char line[512];
        int n = 0;
        FILE *file = fopen("tests/data/phase/saturation_iapws95.csv", "r");
        assert_non_null(file);
        while (fgets(line, sizeof line, file)) {
            if (sscanf(line, "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%*f,%*f,%*f,%lf", &T, &p, &rho, &rho_v, &h, &h_v, &s,
                       &heat) != 8)
                continue;
            if (T < 285.0 || T > 615.0) continue;
            for (int from = 0; from < 3; from++) {
                struct thermal at = thermal_at(&law, p, T, from ? rho * (from == 1 ? 1.02 : 0.98) : 0.0);
                double off = fabs(at.rho / rho - 1.0) + fabs(at.h - h) / 1e5 + fabs(at.s - s) / 1e3;
                if (!(off <= worst)) worst = off;
                assert_true(fabs(at.c_p / heat - 1.0) < 1e-4);
            }
            n++;
        }
        fclose(file);
        print_message("%s: %d rows, off by %.2g\n", evals[way], n, worst);
        assert_true(n >= 15 && worst < (way ? 1e-6 : 1e-9));
        instance_done(&law.instance);
    }
}

/* Too cold, too hot, torn apart: no state; nothing hangs, and the next point is right. */
static void test_none(void **state)
{
    (void)state;
    struct law law = open_water("table");
    const double p[] = {1e5, 1e5, -1.5e8, 1e5, 1e12, NAN}, T[] = {240.0, 5000.0, 500.0, 1500.0, 300.0, 300.0};
    for (size_t i = 0; i < sizeof p / sizeof *p; i++) assert_true(isnan(thermal_at(&law, p[i], T[i], 0.0).v));
    assert_true(fabs(thermal_at(&law, 1e5, 300.0, 0.0).rho - 996.556) < 1e-3);
    assert_true(thermal_at(&law, -3e7, 300.0, 0.0).rho < 990.0); /* stretched */
    instance_done(&law.instance);
}

/* The laws as a family of liquid and vapour, and its curve. */
static void open_family(struct phase_laws *laws, struct saturation *ret_both)
{
    assert_true(saturation_of(&laws->law[0].instance, &laws->law[1].instance, ret_both));
    laws->family = (struct equilibrium_family){.n = 2, .exchange = true, .mixing = true};
    for (unsigned k = 0; k < 2; k++) {
        const struct law *law = &laws->law[k];
        laws->family.eos[k] =
            (struct model_eos){.law = law->eos, .self = law->instance.self, .rho_fill = 1.0, .rho_most = 1e4};
        laws->family.R[k] = law->eos->gas_constant(law->instance.self);
    }
}

/* Water by IAPWS-95 and an ideal vapour with the boiling point and latent heat of IAPWS-95 at 1 atm. */
static void open_pair(struct phase_laws *laws, struct saturation *ret_both)
{
    char heat[48], order[48];
    *laws = (struct phase_laws){.law = {[0] = open_water("table"), [2] = law_preset("ideal-gas", "air")}};
    const char *sets[] = {"gamma=1.33", "cv=1398.5", "heat-bond=0", "entropy-zero=0", NULL};
    double p = 101325.0, T = 373.124, L = 2.2565e6;
    laws->law[1] = law_open("ideal-gas", sets);
    struct thermal liquid = thermal_at(&laws->law[0], p, T, 0.0), vapour = thermal_at(&laws->law[1], p, T, 0.0);
    instance_done(&laws->law[1].instance);
    snprintf(heat, sizeof heat, "heat-bond=%.17g", L - (vapour.h - liquid.h));
    snprintf(order, sizeof order, "entropy-zero=%.17g", L / T - (vapour.s - liquid.s));
    sets[2] = heat;
    sets[3] = order;
    laws->law[1] = law_open("ideal-gas", sets);
    open_family(laws, ret_both);
}

/* Cells on the curve, some heated a little: they come back to it with their volume and energy. */
static void test_cells(void **state)
{
    (void)state;
    struct phase_laws laws;
    struct saturation both;
    struct equilibrium_effort effort = {0};
    uint64_t seed = 5;
    double spent = 0.0, volume = 0.0, drive = 0.0;
    open_pair(&laws, &both);
    for (int block = 0; block < 50; block++) {
        struct equilibrium_cells cells = {.n = EQUILIBRIUM_BLOCK};
        struct timespec from, to;
        for (size_t i = 0; i < cells.n; i++) {
            double T = contract_random(&seed, 300.0, 550.0), p = saturation_pressure(&both, T);
            double alpha = pow(10.0, contract_random(&seed, -5.0, -0.05));
            struct saturation_state at = saturation_at(&both, p, T);
            cells.m[0][i] = (1.0 - alpha) / at.v[0];
            cells.m[1][i] = alpha / at.v[1];
            cells.energy[i] = cells.m[0][i] * at.h[0] + cells.m[1][i] * at.h[1] - p;
            cells.energy[i] *= 1.0 + 1e-5 * contract_random(&seed, -1.0, 1.0);
            cells.p[i] = p;
            cells.T[i] = T;
            for (int k = 0; k < 2; k++) cells.v[k][i] = at.v[k] * 1.01;
        }
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &from);
        equilibrium_solve(&laws.family, &cells, &effort);
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &to);
        spent += (double)(to.tv_sec - from.tv_sec) * 1e9 + (double)(to.tv_nsec - from.tv_nsec);
        for (size_t i = 0; i < cells.n; i++) {
            struct saturation_state at = saturation_at(&both, cells.p[i], cells.T[i]);
            double off = fabs(cells.m[0][i] * cells.v[0][i] + cells.m[1][i] * cells.v[1][i] - 1.0);
            double wants = cells.regime[i] == EQUILIBRIUM_TWO_PHASE ? fabs(at.drive) / (461.5 * cells.T[i]) : 0.0;
            volume = off > volume ? off : volume;
            drive = wants > drive ? wants : drive;
            assert_true(cells.regime[i] != EQUILIBRIUM_NONE);
        }
    }
    print_message("%.0f ns per cell, %.2f steps, %lld of %lld searched; volume %.2g, drive %.2g\n",
                  spent / (double)effort.cells, (double)effort.steps / (double)effort.cells, effort.searched,
                  effort.cells, volume, drive);
    assert_true(volume < 1e-11 && drive < 1e-9);
    phase_close(&laws);
}

/* Water by IAPWS-95 in both phases: one Helmholtz energy, nothing calibrated. */
static void open_real(struct phase_laws *laws, struct saturation *ret_both)
{
    *laws = (struct phase_laws){.law = {[0] = open_water("table"),
                                        [1] = law_preset("iapws95-vapour", "water-vapour"),
                                        [2] = law_preset("ideal-gas", "air")}};
    open_family(laws, ret_both);
}

/* saturation_iapws95.csv where the liquid's table reaches (281 to 617 K): pressure, and the vapour on the curve. */
static void test_curve(void **state)
{
    (void)state;
    struct phase_laws laws;
    struct saturation both;
    double worst = 0.0, worst_v = 0.0, T, p, rho_v, h_v, s_v;
    char line[512];
    int n = 0;
    FILE *file = fopen("tests/data/phase/saturation_iapws95.csv", "r");
    assert_non_null(file);
    open_real(&laws, &both);
    while (fgets(line, sizeof line, file)) {
        if (sscanf(line, "%lf,%lf,%*f,%lf,%*f,%lf,%*f,%lf", &T, &p, &rho_v, &h_v, &s_v) != 5) continue;
        struct thermal at = thermal_at(&laws.law[1], p, T, 0.0);
        double off = fabs(at.rho / rho_v - 1.0) + fabs(at.h - h_v) / 1e6 + fabs(at.s - s_v) / 1e4;
        if (T < 640.5 && !(off <= worst_v)) worst_v = off;
        if (T < 281.0 || T > 617.0) continue;
        double miss = fabs(saturation_pressure(&both, T) / p - 1.0);
        if (!(miss <= worst)) worst = miss;
        n++;
    }
    fclose(file);
    print_message("%d rows: saturation pressure off by %.2g; vapour by %.2g\n", n, worst, worst_v);
    assert_true(n >= 60 && worst < 1e-8 && worst_v < 1e-6);
    phase_close(&laws);
}

/* equilibrium_iapws95.csv: from density and energy alone, where the liquid's table reaches. */
static void test_mixtures(void **state)
{
    (void)state;
    struct phase_laws laws;
    struct saturation both;
    struct equilibrium_effort effort = {0};
    double worst_T = 0.0, worst_p = 0.0, worst_Y = 0.0, spent = 0.0, rho, e, T, p, Y;
    char line[512];
    int n = 0;
    FILE *file = fopen("tests/data/phase/equilibrium_iapws95.csv", "r");
    assert_non_null(file);
    open_real(&laws, &both);
    for (bool more = true; more;) {
        struct equilibrium_cells cells = {0};
        double T_of[EQUILIBRIUM_BLOCK], p_of[EQUILIBRIUM_BLOCK], Y_of[EQUILIBRIUM_BLOCK];
        while (cells.n < EQUILIBRIUM_BLOCK && (more = fgets(line, sizeof line, file) != NULL)) {
            if (sscanf(line, "%lf,%lf,%lf,%lf,%lf", &rho, &e, &T, &p, &Y) != 5 || T < 281.0 || T > 617.0) continue;
            size_t i = cells.n++;
            T_of[i] = T, p_of[i] = p, Y_of[i] = Y;
            cells.m[0][i] = rho * (1.0 - 0.98 * Y);
            cells.m[1][i] = rho * 0.98 * Y;
            cells.energy[i] = rho * e;
            cells.p[i] = 1.02 * p;
            cells.T[i] = T + 1.0;
        }
        struct timespec from, to;
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &from);
        if (cells.n) equilibrium_solve(&laws.family, &cells, &effort);
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &to);
        spent += (double)(to.tv_sec - from.tv_sec) * 1e9 + (double)(to.tv_nsec - from.tv_nsec);
        for (size_t i = 0; i < cells.n; i++) {
            double share = cells.m[1][i] / (cells.m[0][i] + cells.m[1][i]);
            worst_T = fmax(worst_T, fabs(cells.T[i] / T_of[i] - 1.0));
            worst_p = fmax(worst_p, fabs(cells.p[i] / p_of[i] - 1.0));
            worst_Y = fmax(worst_Y, fabs(share - Y_of[i]));
            assert_int_equal(cells.regime[i], EQUILIBRIUM_TWO_PHASE);
            n++;
        }
    }
    fclose(file);
    print_message("%d mixtures: T %.2g, p %.2g, Y %.2g; %.0f ns per cell, %.2f steps, %lld searched\n", n, worst_T,
                  worst_p, worst_Y, spent / (double)effort.cells, (double)effort.steps / (double)effort.cells,
                  effort.searched);
    assert_true(n > 800 && worst_T < 1e-7 && worst_p < 1e-6 && worst_Y < 1e-7);
    phase_close(&laws);
}

/* Beyond the vapour's spinodal, and where the root is that of the liquid, there is no vapour; a start from there finds
 * the true one. */
static void test_spinodal(void **state)
{
    (void)state;
    struct law law = law_preset("iapws95-vapour", "water-vapour");
    const double p[] = {1e6, 1e8, 3e7, 1e5, 1e5}, T[] = {300.0, 300.0, 640.0, 240.0, 3500.0};
    for (size_t i = 0; i < sizeof p / sizeof *p; i++) assert_true(isnan(thermal_at(&law, p[i], T[i], 0.0).v));
    double right = thermal_at(&law, 1e4, 300.0, 0.0).rho; /* metastable: 3.5 kPa are saturation */
    const double starts[] = {1e-5, 0.06, 0.2, 0.6, 5.0, 900.0, 1700.0};
    assert_true(right > 0.0724 && right < 0.08);
    for (size_t i = 0; i < sizeof starts / sizeof *starts; i++)
        assert_true(fabs(thermal_at(&law, 1e4, 300.0, starts[i]).rho / right - 1.0) < 1e-12);
    instance_done(&law.instance);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_saturated), cmocka_unit_test(test_none),
                                       cmocka_unit_test(test_cells),     cmocka_unit_test(test_curve),
                                       cmocka_unit_test(test_mixtures),  cmocka_unit_test(test_spinodal)};
    return cmocka_run_group_tests(tests, support_start, support_stop);
}
