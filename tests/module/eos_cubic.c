/* eos_cubic.c - Peng-Robinson and RKPR air against reference points of 15 digits, along an isentrope, beyond the
 * co-volume and below the coldest temperature; tables of RKPR. What all laws must hold: eos_laws.c. */
#include "law.h"

/* Columns: rho, T, p, e, s, h, cv, cp, c2, Gamma, de/dp, de/drho per mass. */
static void check_point(const struct law *law, const double *column)
{
    double rho = column[0], T = column[1], p = column[2], e = column[3], s = column[4], c2 = column[8];
    double e_p = column[10], e_rho = column[11];
    if (rho > 1105.5) return; /* the law without its continuation */
    struct law_point at = law_at(law, rho, p);
    support_near("T", at.T, T, 1e-11, T);
    support_near("e", at.rho_e / rho, e, 1e-11, fabs(e));
    support_near("s", at.s, s, 1e-11, fabs(s) + 1e3);
    support_near("c2", at.c2, c2, 1e-10, c2); /* T has 35 bits */
    support_near("de_dp", at.de_dp, rho * e_p, 1e-10, rho * e_p);
    support_near("de_drho", at.de_drho, e + rho * e_rho, 1e-10, fabs(e) + fabs(rho * e_rho));
    support_near("rho(p, T)", law_density(law, p, T), rho, 1e-11, rho);
}

/* Beyond rho = 0.98/b; columns: rho, T, p, e, c2, cv, Gamma. */
static void check_continuation(const struct law *law, const double *column)
{
    double rho = column[0], T = column[1], p = column[2], e = column[3], c2 = column[4], G = column[6];
    struct law_point at = law_at(law, rho, p);
    support_near("T", at.T, T, 1e-11, T);
    support_near("e", at.rho_e / rho, e, 1e-11, fabs(e));
    support_near("c2", at.c2, c2, 1e-10, c2);
    support_near("Gamma", 1.0 / at.de_dp, G, 1e-10, G);
}

static void test_points(void **state)
{
    (void)state;
    struct law pr = law_preset("peng-robinson", "air"), rkpr = law_preset("rkpr", "air");
    assert_in_range(law_rows("air_pr_points.csv", 12, check_point, &pr), 30, 1000);
    assert_in_range(law_rows("air_rkpr_points.csv", 12, check_point, &rkpr), 30, 1000);
    assert_in_range(law_rows("rkpr_continuation.csv", 7, check_continuation, &rkpr), 20, 1000);
    instance_done(&pr.instance);
    instance_done(&rkpr.instance);
}

/* Isentropic compression from 300 K, 1 bar: T, rho, c of Lemmon, RKPR and PR behind p. */
static void check_isentrope(const struct law *law, const double *column, size_t first, double s)
{
    double p = column[0], T = column[first], rho = column[first + 1], c = column[first + 2];
    struct law_point at = law_at(law, rho, p);
    support_near("T", at.T, T, 1e-8, T);
    support_near("c", sqrt(at.c2), c, 1e-8, c);
    support_near("s", at.s, s, 2e-6, 1000.0);
}

static void check_isentrope_rkpr(const struct law *law, const double *column)
{
    check_isentrope(law, column, 4, law_at(law, law_density(law, 1e5, 300.0), 1e5).s);
}

static void check_isentrope_pr(const struct law *law, const double *column)
{
    check_isentrope(law, column, 7, law_at(law, law_density(law, 1e5, 300.0), 1e5).s);
}

/* Up to the greatest density of its domain. */
static void check_isentrope_lemmon(const struct law *law, const double *column)
{
    if (column[2] > 1900.0) return;
    check_isentrope(law, column, 1, law_at(law, law_density(law, 1e5, 300.0), 1e5).s);
}

static void test_isentrope(void **state)
{
    (void)state;
    struct law pr = law_preset("peng-robinson", "air"), rkpr = law_preset("rkpr", "air");
    struct law lemmon = law_open("helmholtz-air", (const char *const[]){"eval=analytic", NULL});
    assert_in_range(law_rows("air_isentrope_300K_1bar.csv", 10, check_isentrope_lemmon, &lemmon), 20, 100);
    instance_done(&lemmon.instance);
    assert_in_range(law_rows("air_isentrope_300K_1bar.csv", 10, check_isentrope_rkpr, &rkpr), 20, 100);
    assert_in_range(law_rows("air_isentrope_300K_1bar.csv", 10, check_isentrope_pr, &pr), 20, 100);
    instance_done(&pr.instance);
    instance_done(&rkpr.instance);
}

/* Beyond the co-volume the entropy stays too; nothing jumps across the coldest isotherm
 * (which has less than no pressure where the gas is dense: no state of it). */
static void test_edges(void **state)
{
    (void)state;
    static const char *const laws[] = {"peng-robinson", "rkpr"};
    for (size_t i = 0; i < 2; i++) {
        struct law law = law_preset(laws[i], "air");
        law_isentrope(&law, 900.0, 5e9, 1.2, 1e-9, 1000.0);
        law_isentrope(&law, 1300.0, 5e10, 1.05, 1e-9, 13000.0); /* beyond the edge of the co-volume */
        for (double rho = 0.01; rho < 1000.0; rho *= 1.7) {     /* across the coldest isotherm */
            double low = -1e9, high = 1e10;
            for (int k = 0; k < 200; k++) {
                double mean = 0.5 * (low + high);
                if (law_at(&law, rho, mean).T < 100.0) low = mean;
                else high = mean;
            }
            if (high > 1.0) law_no_jump(&law, rho, high, 700.0);
        }
        instance_done(&law.instance);
    }
}

/* Air from a table. */
static struct law air_table(const char *name, const char *interpolation, int size)
{
    char between[64], nodes[64];
    snprintf(between, sizeof between, "interpolation=%s", interpolation);
    snprintf(nodes, sizeof nodes, "table-size=%d", size);
    return law_open(name, (const char *const[]){"preset=air", "eval=table", between, nodes, NULL});
}

/* Largest errors of T, of p at a given energy and of c at random states from 1e-3 kg/m3 to 0.979/b, 180 K to 20000
 * K. */
static void table_errors(const struct law *table, const struct law *law, double worst[3])
{
    uint64_t seed = 3;
    for (int i = 0; i < 20000; i++) {
        double u = contract_random(&seed, -13.9, 3.84), rho = 1128.116 / (1.0 + exp(-u));
        double p = exp(contract_random(&seed, log(rho * 287.0 * 180.0), log(rho * 287.0 * 2e4)));
        p += rho * p / (1129.0 - rho);
        struct law_point at = law_at(table, rho, p), exact = law_at(law, rho, p);
        if (exact.T < 180.0 || exact.T > 2e4) continue;
        double error[3] = {at.T / exact.T - 1.0, (at.rho_e - exact.rho_e) / (exact.de_dp * p),
                           sqrt(at.c2 / exact.c2) - 1.0};
        for (int l = 0; l < 3; l++) worst[l] = fabs(error[l]) > worst[l] ? fabs(error[l]) : worst[l];
    }
}

/* Twice the errors that an independent program saw with tables of these sizes (columns behind the name: nodes, nodes,
 * degree, largest and mean errors of T, of p at given e, of c). */
static void test_table_errors(void **state)
{
    (void)state;
    struct law law = law_preset("rkpr", "air");
    FILE *file = fopen("tests/data/eos/table_study_rkpr.csv", "r");
    char line[512];
    int size, degree, count = 0;
    double most[3], mean[3];
    assert_non_null(file);
    while (fgets(line, sizeof line, file)) {
        if (sscanf(line, "A(rho,p),%d,%*d,%d,%lf,%lf,%lf,%lf,%lf,%lf", &size, &degree, &most[0], &mean[0], &most[1],
                   &mean[1], &most[2], &mean[2]) != 8)
            continue;
        struct law table = air_table("rkpr", degree == 1 ? "bilinear" : "bicubic", size);
        double worst[3] = {0.0, 0.0, 0.0};
        table_errors(&table, &law, worst);
        for (int l = 0; l < 3; l++) support_near(line, worst[l], 0.0, 2.0, most[l]);
        assert_true(worst[0] > 0.0 && worst[1] > 0.0 && worst[2] > 0.0); /* it is a table */
        instance_done(&table.instance);
        count++;
    }
    fclose(file);
    instance_done(&law.instance);
    assert_int_equal(count, 10);
}

/* The same code with the other law: twice the errors that it had. */
static void test_table_errors_pr(void **state)
{
    (void)state;
    static const double most[2][3] = {{3e-7, 2e-6, 2e-6}, {5e-4, 3e-3, 2e-3}};
    struct law law = law_preset("peng-robinson", "air");
    for (size_t i = 0; i < 2; i++) {
        struct law table = air_table("peng-robinson", i ? "bilinear" : "bicubic", 128);
        double worst[3] = {0.0, 0.0, 0.0};
        table_errors(&table, &law, worst);
        for (int l = 0; l < 3; l++) support_near("error of a table", worst[l], 0.0, 1.0, most[i][l]);
        assert_true(worst[0] > 0.0 && worst[1] > 0.0 && worst[2] > 0.0);
        instance_done(&table.instance);
    }
    instance_done(&law.instance);
}

/* Coarse or fine, a table is well-posed, leads over to the law without jumps and gives back pressures. */
static void test_table_properties(void **state)
{
    (void)state;
    static const char *const laws[] = {"rkpr", "peng-robinson"}, *const names[] = {"bicubic", "bilinear"};
    for (size_t i = 0; i < 4; i++) {
        struct law table = air_table(laws[i / 2], names[i % 2], 24);
        law_sweep(&table, 3.0 / 7.8e-4);
        law_round_trips(&table, 3800.0, 0.0);
        for (double rho = 0.01; rho < 1000.0; rho *= 1.7) /* monotone through both bands */
            for (double p = 40.0 * rho, last = -INFINITY; p < 1e7 * rho; p *= 1.001) {
                double e = law_at(&table, rho, p).rho_e;
                if (!(e > last)) fail_msg("%s: rho e falls at rho %g, p %g", names[i % 2], rho, p);
                last = e;
            }
        instance_done(&table.instance);
    }
    for (size_t i = 0; i < 2; i++) {
        struct contract contract = {.module = support_module("eos", laws[i])};
        const char *const settings[] = {"eval=table", "table-size=256", NULL};
        assert_int_equal(contract_module_run(&contract, settings), 0);
        support_holds(&contract);
    }
}

/* Where the formulas are continued: beyond 0.98/b and colder than t-min, nowhere else. */
static void test_count_outside(void **state)
{
    (void)state;
    struct law law = law_preset("rkpr", "air"), water = law_preset("mnasg", "water"), tait;
    double rho[] = {1.2, 1.2, 1100.0, 1110.0}, p[] = {1e5, 3e4, 1e10, 1e10};
    assert_int_equal(law.eos->count_outside(law.instance.self, 4, rho, p), 2);
    double dense[] = {997.0, 1450.0, 1460.0, 1500.0};
    assert_int_equal(water.eos->count_outside(water.instance.self, 4, dense, p), 2);
    tait = law_preset("modified-tait", "published");
    double wet[] = {970.0, 1000.0, 1000.0, 400.0}, push[] = {1e5, 1e9, -9e8, 1e5};
    assert_int_equal(tait.eos->count_outside(tait.instance.self, 4, wet, push), 3);
    instance_done(&law.instance);
    instance_done(&water.instance);
    instance_done(&tait.instance);
}

/* A law that is ill-posed at its coldest temperature is refused with the state. */
static void test_refused(void **state)
{
    (void)state;
    const struct bulla_module *module = support_module("eos", "rkpr");
    struct bulla_value values[32] = {{0}};
    for (unsigned i = 0; i < instance_param_count(module); i++) values[i].number = module->presets->values[i];
    values[11].number = 50.0;
    struct instance instance = {0};
    assert_int_not_equal(instance_open(module, values, &instance), 0);
    assert_non_null(strstr(status_text(), "raise t-min"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_points),          cmocka_unit_test(test_isentrope),
        cmocka_unit_test(test_edges),           cmocka_unit_test(test_table_errors),
        cmocka_unit_test(test_table_errors_pr), cmocka_unit_test(test_table_properties),
        cmocka_unit_test(test_count_outside),   cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, support_start, support_stop);
}
