/* limiter.c - the contract of kind "limiter" on every built-in limiter, and each against its
 * textbook formula. */
#include "support.h"

#include "bulla/limiter.h"

enum { ROW = 41, PAIRS = 20000 };

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
    double size = pow(10.0, support_random(seed, -12.0, 12.0));
    return support_random(seed, 0.0, 1.0) < 0.5 ? -size : size;
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
            double a = fabs(draw(&seed)), b = i % 2 ? fabs(draw(&seed)) : a * support_random(&seed, 0.3, 3.0);
            double want = textbook(*name, a, b);
            support_near(*name, slope(*name, a, b), want, 1e-15 * 4, want);
        }
    }
}

/* Opposite signs or a zero: no slope. Else the same sign, and at most twice the smaller one. */
static void test_contract(void **state)
{
    (void)state;
    for (const char *const *name = names; *name; name++) {
        uint64_t seed = 2;
        for (int i = 0; i < PAIRS; i++) {
            double a = draw(&seed), b = i % 2 ? draw(&seed) : a * support_random(&seed, -3.0, 3.0);
            double value = slope(*name, a, b);
            if ((a > 0.0) != (b > 0.0)) assert_true(value == 0.0);
            else assert_true(value / a > 0.0 && fabs(value) <= 2.0 * fmin(fabs(a), fabs(b)));
        }
        static const double zeros[] = {0.0, -0.0};
        for (int i = 0; i < 2; i++) {
            assert_true(slope(*name, zeros[i], 3.0) == 0.0 && slope(*name, 3.0, zeros[i]) == 0.0);
            assert_true(slope(*name, zeros[i], -3.0) == 0.0 && slope(*name, zeros[i], zeros[i]) == 0.0);
        }
    }
}

static void test_symmetry(void **state)
{
    (void)state;
    for (const char *const *name = names; *name; name++) {
        uint64_t seed = 3;
        for (int i = 0; i < PAIRS; i++) {
            double a = draw(&seed), b = a * support_random(&seed, -1.0, 4.0);
            double value = slope(*name, a, b);
            assert_true(slope(*name, -a, -b) == -value);
            assert_true(slope(*name, b, a) == value);
        }
    }
}

/* Equal differences are the slope; so second order on smooth data. */
static void test_linear_data(void **state)
{
    (void)state;
    for (const char *const *name = names; *name; name++)
        for (double a = -1e9; a < 1e9; a = a < -1e-9 ? a / 7.0 : a < 0.0 ? 1e-9 : a * 7.0)
            assert_true(slope(*name, a, a) == a);
}

/* From the smallest to the largest numbers: finite and within the contract. */
static void test_extremes(void **state)
{
    (void)state;
    static const double sizes[] = {5e-324, 1e-310, 1e-200, 1.0, 1e200, 8e307};
    enum { COUNT = sizeof sizes / sizeof *sizes };
    for (const char *const *name = names; *name; name++)
        for (int i = 0; i < COUNT * COUNT; i++) {
            double a = sizes[i / COUNT], b = sizes[i % COUNT], value = slope(*name, a, b);
            if (!(value >= 0.0 && value <= 2.0 * fmin(a, b))) fail_msg("%s(%g, %g) = %g", *name, a, b, value);
            assert_true(slope(*name, a, -b) == 0.0);
        }
}

/* Face values a half slope away from the mean stay between the neighbours, for any three of them:
 * no new extreme. */
static void test_no_new_extreme(void **state)
{
    (void)state;
    for (const char *const *name = names; *name; name++) {
        uint64_t seed = 4;
        for (int i = 0; i < PAIRS; i++) {
            double d_minus = draw(&seed), d_plus = i % 2 ? draw(&seed) : d_minus * support_random(&seed, -2.0, 5.0);
            double half = 0.5 * slope(*name, d_minus, d_plus);
            assert_true(half <= fmax(d_plus, 0.0) && half >= fmin(d_plus, 0.0));
            assert_true(half <= fmax(d_minus, 0.0) && half >= fmin(d_minus, 0.0));
        }
    }
}

static void test_rows(void **state)
{
    (void)state;
    for (const char *const *name = names; *name; name++) {
        uint64_t seed = 5;
        double a[ROW], b[ROW], value[ROW];
        for (int i = 0; i < ROW; i++) {
            a[i] = draw(&seed);
            b[i] = a[i] * support_random(&seed, -1.0, 4.0);
        }
        for (size_t first = 0; first < 9; first++) {
            size_t n = ROW - 4 * first;
            limiter(*name)->slope(NULL, n, a + first, b + first, value);
            for (size_t i = 0; i < n; i++) assert_true(value[i] == slope(*name, a[first + i], b[first + i]));
        }
    }
}

/* The values at both edges of cells, along rows and across them: bitwise what the slope gives. */
static void test_edges(void **state)
{
    (void)state;
    enum { PITCH = 9 };
    for (const char *const *name = names; *name; name++)
        for (size_t step = 1; step <= PITCH; step += PITCH - 1) {
            uint64_t seed = 6;
            double w[ROW + 2 * PITCH], lower[ROW], upper[ROW];
            for (int i = 0; i < ROW + 2 * PITCH; i++) w[i] = draw(&seed);
            assert_non_null(limiter(*name)->edges);
            for (size_t n = ROW; n > ROW - 9; n--) {
                limiter(*name)->edges(NULL, n, step, w + PITCH, lower, upper);
                for (size_t i = 0; i < n; i++) {
                    const double *here = w + PITCH + i;
                    double half = 0.5 * slope(*name, *here - *(here - step), *(here + step) - *here);
                    assert_true(lower[i] == *here - half && upper[i] == *here + half);
                }
            }
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_textbook),    cmocka_unit_test(test_contract), cmocka_unit_test(test_symmetry),
        cmocka_unit_test(test_linear_data), cmocka_unit_test(test_extremes), cmocka_unit_test(test_no_new_extreme),
        cmocka_unit_test(test_rows),        cmocka_unit_test(test_edges),
    };
    return cmocka_run_group_tests(tests, support_start, support_stop);
}
