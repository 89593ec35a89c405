/* account.c - sums that know no order (base/account.h): exact where doubles cancel, rounded once, the same bits however
 * they are dealt out. */
#include "base/account.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static uint64_t seed = 7;

static uint64_t draw(void)
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return seed >> 11;
}

/* Of any size and sign. */
static double number(void)
{
    double size = ldexp((double)draw(), (int)(draw() % 200) - 150);
    return draw() % 2 ? size : -size;
}

static double sum_of(const double *values, int n)
{
    struct account account = {0};
    for (int i = 0; i < n; i++) account_add(&account, values[i]);
    return account_value(&account);
}

static void test_known(void **state)
{
    (void)state;
    const double ends[] = {0x1p1023, 0x1p-1074, -0x1p1023}, ones[] = {1.0, 1e-40, -1.0, 0.0};
    assert_true(sum_of(ends, 3) == 0x1p-1074);
    assert_true(sum_of(ones, 4) == 1e-40);
    for (int i = 0; i < 1000; i++) {
        double value = number();
        assert_true(sum_of(&value, 1) == value);
    }
}

#define TOTAL(...) sum_of((const double[]){__VA_ARGS__}, (int)(sizeof(double[]){__VA_ARGS__} / sizeof(double)))

static void test_nearest(void **state)
{
    (void)state;
    double half = DBL_EPSILON / 2, tiny = DBL_TRUE_MIN;
    assert_true(sum_of(NULL, 0) == 0.0 && !signbit(sum_of(NULL, 0)));
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

/* Forwards, backwards, and dealt out to three that are added digit by digit. */
static void test_order(void **state)
{
    (void)state;
    enum { N = 3000 };
    static double values[N];
    struct account parts[3] = {0}, back = {0}, all = {0};
    for (int i = 0; i < N; i++) values[i] = number();
    for (int i = 0; i < N; i++) account_add(&parts[draw() % 3], values[i]);
    for (int i = N; i-- > 0;) account_add(&back, values[i]);
    for (int k = 0; k < 3; k++) {
        account_carry(&parts[k]);
        for (int i = 0; i < ACCOUNT_NUMBERS; i++) ((long long *)&all)[i] += ((long long *)&parts[k])[i];
    }
    double sum = sum_of(values, N);
    assert_true(sum == account_value(&back) && sum == account_value(&all));
    for (int i = 0; i < N; i++) account_add(&all, -values[i]);
    assert_true(account_value(&all) == 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_known), cmocka_unit_test(test_nearest),
                                       cmocka_unit_test(test_odd), cmocka_unit_test(test_order)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
