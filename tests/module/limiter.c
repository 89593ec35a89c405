/* limiter.c - the contract of kind "limiter" (core/suite/contract_limiter.c) on every built-in limiter, and
 * each against its textbook formula. */
#include "support.h"

#include "bulla/limiter.h"
#include "plug/vet.h"
#include "suite/contract_module.h"

enum { PAIRS = 20000 };

static const char *const names[] = {"minmod", "van-leer", "mc", "van-albada", "superbee", NULL};
static const char *const two_sided[] = {"koren", "thinc", NULL};

static const struct bulla_limiter *limiter(const char *name)
{
    return support_module("limiter", name)->table;
}

static double slope(const char *name, double a, double b)
{
    double value;
    limiter(name)->slope(NULL, 1, &a, &b, &value);
    return value;
}

/* Differences of all sizes and signs. */
static double draw(uint64_t *seed)
{
    double size = pow(10.0, contract_random(seed, -12.0, 12.0));
    return contract_random(seed, 0.0, 1.0) < 0.5 ? -size : size;
}

/* The formulas as the papers give them, for a > 0 and b > 0. */
static double textbook(const char *name, double a, double b)
{
    if (strcmp(name, "minmod") == 0) return fmin(a, b);
    if (strcmp(name, "van-leer") == 0) return 2.0 * a * b / (a + b);
    if (strcmp(name, "mc") == 0) return fmin(0.5 * (a + b), 2.0 * fmin(a, b));
    if (strcmp(name, "van-albada") == 0) return (a * a * b + b * b * a) / (a * a + b * b);
    return fmax(fmin(2.0 * a, b), fmin(a, 2.0 * b)); /* superbee */
}

static void test_textbook(void **state)
{
    (void)state;
    for (const char *const *name = names; *name; name++) {
        uint64_t seed = 1;
        for (int i = 0; i < PAIRS; i++) {
            double a = fabs(draw(&seed)), b = i % 2 ? fabs(draw(&seed)) : a * contract_random(&seed, 0.3, 3.0);
            double want = textbook(*name, a, b);
            support_near(*name, slope(*name, a, b), want, 1e-15 * 4, want);
        }
    }
}

/* The step of a cell of value 0 towards `near`, with `far` on its other side. */
static double step_of(const char *name, double near, double far)
{
    const double w[3] = {-far, 0.0, near};
    double lower, upper;
    limiter(name)->edges(NULL, 1, 1, w + 1, &lower, &upper);
    return upper;
}

/* Koren's function of r = far/near: 1/2 max(0, min(2 r, (2 + r)/3, 2)), times near. Where nothing limits, the edges are
 * those of the parabola through the means of three cells. */
static void test_koren(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int i = 0; i < PAIRS; i++) {
        double near = draw(&seed), r = contract_random(&seed, -1.0, 8.0), far = r * near;
        double want = 0.5 * fmax(0.0, fmin(fmin(2.0 * r, (2.0 + r) / 3.0), 2.0)) * near;
        support_near("koren", step_of("koren", near, far), want, 1e-15 * 4, fabs(near));
    }
    const double a = 3.0, b = 1.0, c = 0.25; /* a + b x + c x^2, means over cells of width 1 around -1, 0 and 1 */
    const double w[3] = {a - b + c + c / 12.0, a + c / 12.0, a + b + c + c / 12.0};
    double lower, upper;
    limiter("koren")->edges(NULL, 1, 1, w + 1, &lower, &upper);
    support_near("lower edge of a parabola", lower, a - 0.5 * b + 0.25 * c, 1e-15, a);
    support_near("upper edge of a parabola", upper, a + 0.5 * b + 0.25 * c, 1e-15, a);
}

/* Edges of a row of three cells, from a thinc of this steepness. */
static void thinc_edges(double beta, const double w[3], double edges[2])
{
    struct instance thinc = support_open(support_module("limiter", "thinc"), &beta);
    limiter("thinc")->edges(thinc.self, 1, 1, w + 1, edges, edges + 1);
    instance_done(&thinc);
}

/* The formula of the paper, with its exponentials, for a cell of c between pure ones; to the accuracy of the
 * tangent. */
static void test_thinc(void **state)
{
    (void)state;
    for (double beta = 1.0; beta < 3.0; beta += 0.2)
        for (double c = 0.05; c < 1.0; c += 0.05) {
            double t = tanh(beta), a = (exp(beta * (2.0 * c - 1.0)) / cosh(beta) - 1.0) / t;
            double lower = 0.5 * (1.0 + a), upper = 0.5 * (1.0 + (t + a) / (1.0 + a * t)), edges[2];
            double tolerance = beta < 2.5 ? 3e-3 : 0.03;
            thinc_edges(beta, (const double[]){0.0, c, 1.0}, edges);
            support_near("thinc, lower edge", edges[0], lower, tolerance, 1.0);
            support_near("thinc, upper edge", edges[1], upper, tolerance, 1.0);
            thinc_edges(beta, (const double[]){1.0, c, 0.0}, edges);
            support_near("thinc, falling", edges[0], upper, tolerance, 1.0);
        }
}

/* The edges of two materials sum to 1 but for round-off (which core takes out), whatever the neighbours have. */
static void test_sum(void **state)
{
    (void)state;
    uint64_t seed = 8;
    for (int i = 0; i < PAIRS; i++) {
        double one[3], two[3], a[2], b[2], beta = contract_random(&seed, 1.0, 3.0);
        for (int k = 0; k < 3; k++) {
            double drawn = contract_random(&seed, 0.0, 1.0);
            one[k] = i % 2 ? drawn : pow(10.0, -16.0 * drawn);
            two[k] = 1.0 - one[k];
        }
        thinc_edges(beta, one, a);
        thinc_edges(beta, two, b);
        for (int k = 0; k < 2; k++) support_near("sum of two fractions at an edge", a[k] + b[k], 1.0, 2e-14, 1.0);
    }
}

static void test_two_sided(void **state)
{
    (void)state;
    for (const char *const *name = two_sided; *name; name++) {
        struct contract contract = {.module = support_module("limiter", *name), .strict = true};
        assert_int_equal(contract_module_run(&contract, NULL), 0);
        support_holds(&contract);
        assert_true(contract.n_row == (contract.module->params ? 13 : 10) && contract.n_cost == 1);
        for (unsigned i = 0; i < contract.n_row; i++) assert_true(contract.rows[i].points > 0);
    }
}

/* A table from before there were flags ends where they begin: it has one slope, whatever comes behind it. */
static void test_older(void **state)
{
    (void)state;
    struct bulla_limiter older = *limiter("mc");
    older.size = offsetof(struct bulla_limiter, flags);
    older.flags = BULLA_TWO_SIDED;
    struct bulla_module module = *support_module("limiter", "mc");
    module.table = &older;
    struct contract contract = {.module = &module, .strict = true};
    assert_int_equal(vet_module(&module, 0), 0);
    assert_int_equal(contract_module_run(&contract, NULL), 0);
    support_holds(&contract);
    assert_int_equal(contract.n_row, 11);
}

static void test_contract(void **state)
{
    (void)state;
    for (const char *const *name = names; *name; name++) {
        struct contract contract = {.module = support_module("limiter", *name), .strict = true};
        assert_int_equal(contract_module_run(&contract, NULL), 0);
        support_holds(&contract);
        assert_true(contract.n_row == 11 && contract.n_cost == 2);
        for (unsigned i = 0; i < contract.n_row; i++) assert_true(contract.rows[i].points > 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_textbook), cmocka_unit_test(test_contract),
                                       cmocka_unit_test(test_koren),    cmocka_unit_test(test_thinc),
                                       cmocka_unit_test(test_sum),      cmocka_unit_test(test_two_sided),
                                       cmocka_unit_test(test_older)};
    return cmocka_run_group_tests(tests, support_start, support_stop);
}
