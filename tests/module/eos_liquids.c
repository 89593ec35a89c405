/* eos_liquids.c - the Tait liquids against reference points of 14 digits and more, at the ends of temperature, and
 * initial states. What all laws must hold: eos_laws.c. */
#include "law.h"

static void check_tait(const struct law *law, const double *column)
{
    double rho = column[0], p = column[1], e = column[2], c2 = column[3];
    struct law_point at = law_at(law, rho, p);
    support_near("e", at.rho_e / rho, e, 1e-12, fabs(e) + fabs(p) / rho);
    support_near("c2", at.c2, c2, 1e-12, c2);
    support_near("T along the curve", at.T, 293.15 * pow(rho / 998.2, 0.11), 1e-12, at.T + 1e-12 * p);
}

static void test_tait_points(void **state)
{
    (void)state;
    struct law law = law_preset("tait", "water");
    assert_int_equal(law_rows("tait_points.csv", 5, check_tait, &law), 30);
    instance_done(&law.instance);
}

/* Columns: rho, T, p, e, s, h, cv, cp, c2, Gamma, de/dp, de/drho per mass. */
static void check_potential(const struct law *law, const double *column)
{
    double rho = column[0], T = column[1], p = column[2], e = column[3], s = column[4], c2 = column[8];
    double e_p = column[10], e_rho = column[11];
    struct law_point at = law_at(law, rho, p);
    support_near("T", at.T, T, 1e-12, T);
    support_near("e", at.rho_e / rho, e, 1e-12, fabs(e) + p / rho + 1e6);
    support_near("s", at.s, s, 1e-12, fabs(s) + 1e4);
    support_near("c2", at.c2, c2, 2e-10, c2); /* T has 35 bits */
    support_near("de_dp", at.de_dp, rho * e_p, 2e-10, rho * e_p);
    support_near("de_drho", at.de_drho, e + rho * e_rho, 2e-10, fabs(e) + fabs(rho * e_rho));
    support_near("rho(p, T)", law_density(law, p, T), rho, 1e-13, rho);
}

static void test_modified_tait_points(void **state)
{
    (void)state;
    struct law published = law_preset("modified-tait", "published"), refit = law_preset("modified-tait", "refit");
    assert_in_range(law_rows("mtait_pub_points.csv", 12, check_potential, &published), 20, 1000);
    assert_in_range(law_rows("mtait_refit_points.csv", 12, check_potential, &refit), 20, 1000);
    instance_done(&published.instance);
    instance_done(&refit.instance);
}

static const char *const presets[] = {"published", "refit"};

/* At the ends of temperature: cold and hot sides of both presets. */
static void test_edges(void **state)
{
    (void)state;
    static const double edges[][2] = {{270.0, 600.0}, {265.0, 900.0}};
    for (size_t i = 0; i < 2; i++) {
        struct law law = law_preset("modified-tait", presets[i]);
        for (double rho = 600.0; rho < 1270.0; rho += 31.0)
            for (int side = 0; side < 2; side++) {
                double low = -5e8, high = 2e10;
                for (int k = 0; k < 200; k++) { /* the pressure at which T is at the edge */
                    double mean = 0.5 * (low + high);
                    if (law_at(&law, rho, mean).T < edges[i][side]) low = mean;
                    else high = mean;
                }
                law_no_jump(&law, rho, high, 4000.0);
            }
        instance_done(&law.instance);
    }
}

/* Beyond the hot end of the published law, which falls with density from 1275 kg/m3 on: slopes and sound speed are
 * those of the energy. */
static void test_falling_edge(void **state)
{
    (void)state;
    struct law law = law_preset("modified-tait", "published");
    for (double rho = 1280.0; rho < 1490.0; rho += 7.0) {
        double p = law_at(&law, rho, 1e9).p_min, h = 1e-6 * rho;
        while (law_at(&law, rho, p).T < 600.0) p += 1e7;
        for (p *= 1.2; p < 2e10; p *= 1.5) {
            struct law_point at = law_at(&law, rho, p);
            double slope = (law_at(&law, rho + h, p).rho_e - law_at(&law, rho - h, p).rho_e) / (2.0 * h);
            support_near("d(rho e)/drho", at.de_drho, slope, 1e-6, fabs(slope) + at.c2 * at.de_dp);
            double c2 = ((at.rho_e + p) / rho - slope) / at.de_dp;
            support_near("c2", at.c2, c2, 1e-5, fabs(c2) + p / rho);
        }
    }
    instance_done(&law.instance);
}

/* Initial states of the water tube: 300 K at 1e9 and 1e5 Pa. */
static void test_initial_states(void **state)
{
    (void)state;
    struct law published = law_preset("modified-tait", "published"), refit = law_preset("modified-tait", "refit");
    support_near("published, 1e9", law_density(&published, 1e9, 300.0), 1314.983475, 1e-9, 1315.0);
    support_near("published, 1e5", law_density(&published, 1e5, 300.0), 971.8296975, 1e-9, 972.0);
    support_near("refit, 1e9", law_density(&refit, 1e9, 300.0), 1225.273641, 1e-9, 1225.0);
    support_near("refit, 1e5", law_density(&refit, 1e5, 300.0), 994.969162, 1e-9, 995.0);
    /* Beyond the range of temperatures a density is still the one that has this temperature. */
    for (double T = 100.0; T < 3000.0; T *= 1.5) {
        double rho = law_density(&refit, 1e6, T);
        support_near("T of rho(p, T)", law_at(&refit, rho, 1e6).T, T, 1e-9, T);
    }
    instance_done(&published.instance);
    instance_done(&refit.instance);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_tait_points),  cmocka_unit_test(test_modified_tait_points), cmocka_unit_test(test_edges),
        cmocka_unit_test(test_falling_edge), cmocka_unit_test(test_initial_states),
    };
    return cmocka_run_group_tests(tests, support_start, support_stop);
}
