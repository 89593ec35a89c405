/* Exact sums: the nearest double of the true sum, whatever the order, the parts and the sizes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/accrue.h"

enum { MANY = 4000 };

static double total(size_t n, const double *values)
{
    struct accrue sum = {{0}};
    accrue_add(&sum, n, 1, values);
    return accrue_value(&sum);
}

#define TOTAL(...) total(sizeof(double[]){__VA_ARGS__} / sizeof(double), (const double[]){__VA_ARGS__})

static void test_nearest(void **state)
{
    (void)state;
    double half = DBL_EPSILON / 2, tiny = DBL_TRUE_MIN;
    assert_true(total(0, NULL) == 0.0 && !signbit(total(0, NULL)));
    assert_true(TOTAL(1e300, 1.0, -1e300) == 1.0);
    assert_true(TOTAL(1.0, half) == 1.0);                     /* a tie: to even */
    assert_true(TOTAL(1.0, half, tiny) == 1.0 + DBL_EPSILON); /* the least of all counts */
    assert_true(TOTAL(-1.0, -half, -tiny) == -1.0 - DBL_EPSILON);
    assert_true(TOTAL(1.0, half, -tiny) == 1.0);
    assert_true(TOTAL(1.0 + DBL_EPSILON, half) == 1.0 + 2.0 * DBL_EPSILON); /* the other tie */
    assert_true(TOTAL(tiny, tiny, tiny) == 3.0 * tiny);
    assert_true(TOTAL(DBL_MIN, -tiny) == DBL_MIN - tiny);
    assert_true(TOTAL(-DBL_MIN, tiny, tiny) == 2.0 * tiny - DBL_MIN);
    assert_true(TOTAL(0x1p-1030, -0x1p-1040) == 0x1p-1030 - 0x1p-1040);
}

static void test_odd(void **state)
{
    (void)state;
    assert_true(TOTAL(DBL_MAX, DBL_MAX) == INFINITY);
    assert_true(TOTAL(DBL_MAX, DBL_MAX, -DBL_MAX) == DBL_MAX);
    assert_true(TOTAL(-DBL_MAX, -DBL_MAX) == -INFINITY);
    assert_true(TOTAL(1.0, INFINITY) == INFINITY);
    assert_true(TOTAL(1.0, -INFINITY) == -INFINITY);
    assert_true(isnan(TOTAL(INFINITY, 1.0, -INFINITY)));
    assert_true(isnan(TOTAL(1.0, NAN)));
}

/* Doubles of all signs and exponents but the odd ones: a generator's bits (Marsaglia 2003). */
static void scatter(size_t n, double *ret)
{
    uint64_t seed = 88172645463325252u;
    for (size_t i = 0; i < n; i++) {
        do {
            seed ^= seed << 13;
            seed ^= seed >> 7;
            seed ^= seed << 17;
            memcpy(&ret[i], &seed, sizeof seed);
        } while (!isfinite(ret[i]));
    }
}

/* In three parts, as three ranks would, from the other end; and all but one taken away again. */
static void test_order(void **state)
{
    (void)state;
    static double values[2 * MANY];
    scatter(MANY, values);
    double whole = total(MANY, values);
    for (size_t parts = 1; parts <= 3; parts++) {
        struct accrue all = {{0}};
        for (size_t part = 0; part < parts; part++) {
            struct accrue sum = {{0}};
            for (size_t i = MANY; i-- > 0;)
                if (i % parts == part) accrue_add(&sum, 1, 1, values + i);
            accrue_settle(&sum);
            for (int i = 0; i < ACCRUE_NUMBERS; i++) all.numbers[i] += sum.numbers[i];
        }
        assert_true(accrue_value(&all) == whole);
    }
    for (size_t i = 1; i < MANY; i++) values[MANY + i - 1] = -values[i];
    assert_true(total(2 * MANY - 1, values) == values[0]);
}

/* Every third one, of numbers with so few bits that doubles add them up exactly. */
static void test_steps(void **state)
{
    (void)state;
    static double values[3 * MANY];
    double expected = 0.0;
    for (size_t i = 0; i < 3 * MANY; i++) values[i] = 1.0 + (double)(i * 2654435761u % 4294967291u) * 0x1p-33;
    for (size_t i = 1; i < 3 * MANY; i += 3) expected += values[i];
    struct accrue sum = {{0}};
    accrue_add(&sum, MANY, 3, values + 1);
    assert_true(accrue_value(&sum) == expected);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_nearest), cmocka_unit_test(test_odd),
                                       cmocka_unit_test(test_order), cmocka_unit_test(test_steps)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
