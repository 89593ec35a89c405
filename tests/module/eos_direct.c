/* eos_direct.c - IAPWS-95 and Lemmon air from tables of e, c^2 and T: errors against the formulas, the properties that
 * every law has, and the contract, as far as tables of several functions can keep it. */
#include "law.h"

static struct law direct_open(const char *name, const char *eval, const char *interpolation, double size)
{
    const struct bulla_module *module = support_module("eos", name);
    const struct bulla_value values[] = {{.number = size}, {.text = eval}, {.text = interpolation}};
    struct law law = {.eos = module->table};
    if (instance_open(module, values, &law.instance)) fail_msg("%s", status_text());
    return law;
}

static bool direct_outside(const struct law *law, double rho, double p)
{
    return law->eos->count_outside(law->instance.self, 1, &rho, &p) > 0;
}

/* Largest errors of T, of c and of p at a given energy, the last in units of rho c^2, at random states. */
static void direct_errors(const struct law *table, const struct law *law, const double rho[2], const double p[2],
                          double worst[3])
{
    uint64_t seed = 5;
    int count = 0;
    for (int i = 0; i < 3000; i++) {
        double density = rho[0] * pow(rho[1] / rho[0], contract_random(&seed, 0.0, 1.0));
        double pressure = p[0] * pow(p[1] / p[0], contract_random(&seed, 0.0, 1.0));
        if (direct_outside(table, density, pressure) || direct_outside(law, density, pressure)) continue;
        struct law_point at = law_at(table, density, pressure), exact = law_at(law, density, pressure);
        if (exact.T > 3000.0) continue;
        double error[3] = {at.T / exact.T - 1.0, sqrt(at.c2 / exact.c2) - 1.0,
                           (at.rho_e - exact.rho_e) / (exact.de_dp * exact.stiffness)};
        for (int l = 0; l < 3; l++) worst[l] = fabs(error[l]) > worst[l] ? fabs(error[l]) : worst[l];
        count++;
    }
    assert_true(count > 500);
}

/* Water: twice the errors that an independent program saw with tables of these sizes. Air: twice what ours had. */
static void test_errors(void **state)
{
    (void)state;
    static const struct {
        const char *law, *interpolation;
        double size, most[3], rho[2], p[2];
    } tables[] = {
        {"iapws95", "bicubic", 200, {9e-5, 8.2e-5, 8e-6}, {640, 1720}, {1e3, 1e10}},
        {"iapws95", "bicubic", 400, {1.6e-6, 1.6e-6, 6e-7}, {640, 1720}, {1e3, 1e10}},
        {"iapws95", "bilinear", 200, {1.2e-3, 2.2e-3, 8e-4}, {640, 1720}, {1e3, 1e10}},
        {"iapws95", "bilinear", 400, {3e-4, 6e-4, 1.8e-4}, {640, 1720}, {1e3, 1e10}},
        {"helmholtz-air", "bicubic", 200, {8.4e-7, 1.04e-5, 3.9e-6}, {1e-2, 1300}, {1e3, 2e9}},
        {"helmholtz-air", "bilinear", 200, {1.7e-3, 3.3e-3, 2.1e-3}, {1e-2, 1300}, {1e3, 2e9}},
    };
    for (size_t i = 0; i < sizeof tables / sizeof *tables; i++) {
        struct law law = direct_open(tables[i].law, "analytic", "biquintic", 128);
        struct law table = direct_open(tables[i].law, "table", tables[i].interpolation, tables[i].size);
        double worst[3] = {0.0, 0.0, 0.0};
        direct_errors(&table, &law, tables[i].rho, tables[i].p, worst);
        for (int l = 0; l < 3; l++) {
            if (getenv("BULLA_FIGURES"))
                printf("%s %s %g: %g\n", tables[i].law, tables[i].interpolation, tables[i].size, worst[l]);
            support_near("error of a table", worst[l], 0.0, 1.0, tables[i].most[l]);
        }
        assert_true(worst[0] > 1e-9 && worst[1] > 1e-9 && worst[2] > 1e-11); /* it is this table */
        instance_done(&table.instance);
        instance_done(&law.instance);
    }
}

/* Across the edges of the table, found by bisection of the count, nothing jumps. Returns how many there were. */
static int direct_edges(const struct law *table, double rho, double p_in)
{
    int count = 0;
    for (int up = 0; up < 2; up++) {
        double in = p_in, out = up ? 1e12 : -6.19e8;
        if (direct_outside(table, rho, in) || !direct_outside(table, rho, out)) continue;
        for (int k = 0; k < 100; k++) {
            double mean = 0.5 * (in + out);
            if (direct_outside(table, rho, mean)) out = mean;
            else in = mean;
        }
        law_no_jump(table, rho, in, 1e4);
        count++;
    }
    return count;
}

/* Coarse or fine, of whatever order: well-posed anywhere, no jumps, pressures come back, slots agree bit by bit. */
static void test_properties(void **state)
{
    (void)state;
    static const char *const names[] = {"bicubic", "bilinear"};
    for (size_t i = 0; i < 2; i++) {
        struct law water = direct_open("iapws95", "table", names[i], 64), air;
        air = direct_open("helmholtz-air", "table", names[i], 64);
        int edges = 0;
        law_sweep(&water, 4600.0);
        law_sweep(&air, 5000.0);
        for (double rho = 300.0; rho < 2000.0; rho *= 1.037)
            for (double p = 1e3; p < 1e11; p *= 7.3) {
                law_round_trip(&water, rho, p, 8.0);
                law_round_trip(&air, 1e-3 * rho, p, 8.0);
            }
        for (double rho = 470.0; rho < 1719.0; rho += 29.0)
            edges += direct_edges(&water, rho, 1e8 + 30.0 * pow(rho - 467.0, 2.8));
        assert_int_equal(edges, 88);                          /* both, at 44 densities */
        for (double rho = 470.0; rho < 1719.0; rho += 13.0) { /* energies grow with pressure */
            double last = -INFINITY;
            for (double above = 1e3; above < 1e11; above *= 1.01) {
                double e = law_at(&water, rho, above - 6.2e8).rho_e;
                if (!(e > last)) fail_msg("%s: rho e falls at rho %g, p %g", names[i], rho, above - 6.2e8);
                last = e;
            }
        }
        instance_done(&water.instance);
        instance_done(&air.instance);
    }
}

/* `thermal` is the law's own: beside it stands what a table's errors leave of the other functions. */
static void forgive_thermal(struct contract *contract, double limit)
{
    for (unsigned i = 0; i < contract->n_row; i++)
        if (strstr(contract->rows[i].check, "thermal(")) contract->rows[i].limit = limit;
}

/* Fine bicubic tables keep the whole contract; bilinear ones all but what compares slopes. */
static void test_contract(void **state)
{
    (void)state;
    static const char *const laws[] = {"iapws95", "helmholtz-air"};
    static const char *const slopes[] = {"is the slope of rho e", "c^2 = (h", "T ds = de"};
    for (size_t i = 0; i < 2; i++) {
        struct contract fine = {.module = support_module("eos", laws[i])}, rough = fine;
        const char *const bicubic[] = {"interpolation=bicubic", "table-size=512", NULL};
        const char *const bilinear[] = {"interpolation=bilinear", NULL};
        assert_int_equal(contract_module_run(&fine, bicubic), 0);
        forgive_thermal(&fine, 1e-5);
        support_holds(&fine);
        assert_int_equal(contract_module_run(&rough, bilinear), 0);
        for (unsigned k = 0; k < rough.n_row; k++)
            for (size_t l = 0; l < sizeof slopes / sizeof *slopes; l++)
                if (strstr(rough.rows[k].check, slopes[l])) {
                    assert_true(rough.rows[k].worst < 0.3);
                    rough.rows[k].worst = 0.0;
                }
        forgive_thermal(&rough, 0.05);
        support_holds(&rough);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_errors),
        cmocka_unit_test(test_properties),
        cmocka_unit_test(test_contract),
    };
    return cmocka_run_group_tests(tests, support_start, support_stop);
}
