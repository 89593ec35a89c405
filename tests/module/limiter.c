/* limiter.c - the contract of kind "limiter" (core/suite/contract_limiter.c) on every built-in limiter, and
 * each against its textbook formula. */
#include "support.h"

#include "bulla/limiter.h"
#include "suite/contract_module.h"

enum { PAIRS = 20000 };

static const char *const names[] = {"minmod", "van-leer", "mc", "van-albada", "superbee", NULL};

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
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_textbook), cmocka_unit_test(test_contract)};
    return cmocka_run_group_tests(tests, support_start, support_stop);
}
