/* eos_thermal.c - IAPWS-95 in phase change: liquid on the saturation curve by `thermal`, where it has no state, and cells of it with an
 * ideal vapour at equilibrium; their cost. */
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

/* The liquid of saturation_iapws95.csv up to 620 K: the formulas to round-off of the rows, the table to what it says of itself. */
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
    assert_true(saturation_of(&laws->law[0].instance, &laws->law[1].instance, ret_both));
    laws->family = (struct equilibrium_family){.n = 2, .exchange = true, .mixing = true};
    for (unsigned k = 0; k < 2; k++) {
        const struct law *law = &laws->law[k];
        laws->family.eos[k] =
            (struct model_eos){.law = law->eos, .self = law->instance.self, .rho_fill = 1.0, .rho_most = 1e4};
        laws->family.R[k] = law->eos->gas_constant(law->instance.self);
    }
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

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_saturated), cmocka_unit_test(test_none),
                                       cmocka_unit_test(test_cells)};
    return cmocka_run_group_tests(tests, support_start, support_stop);
}
