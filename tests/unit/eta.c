/* eta.c - the truth lies in what is said about the time that is left. */
#include "run/eta.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

/* CPU seconds that a run takes up to a share x, with effort a + b x per share. */
static double effort(double a, double b, double x)
{
    return a * x + 0.5 * b * x * x;
}

/* Notes up to a share; `slowness`: wall time per CPU time, from `start` on. */
static struct eta_left walk(double a, double b, double slowness, double start, double share)
{
    struct eta eta;
    eta_begin(&eta, start);
    for (int i = 1; i <= 1000; i++) {
        double x = start + (share - start) * i / 1000, cpu = effort(a, b, x) - effort(a, b, start);
        eta_note(&eta, x, cpu, slowness * cpu);
    }
    return eta_left(&eta);
}

static void expect_within(struct eta_left left, double truth, double width)
{
    if (!(left.least <= truth && truth <= left.most && left.most <= width * left.least))
        fail_msg("%g is not within %g to %g, or that is wider than %g", truth, left.least, left.most, width);
    assert_true(left.least <= left.likely && left.likely <= left.most);
}

static void even_runs(void **state)
{
    (void)state;
    struct eta_left left = walk(1000, 0, 1, 0, 0.25);
    expect_within(left, 750, 1.22);
    assert_true(fabs(left.likely / 750 - 1) < 1e-9);
    left = walk(1000, 0, 1, 0.6, 0.7); /* taken up again */
    assert_true(fabs(left.likely / 300 - 1) < 1e-9);
}

/* Levels that grow, and levels that go. */
static void trends(void **state)
{
    (void)state;
    for (int i = 2; i < 10; i++) {
        double x = 0.1 * i;
        expect_within(walk(1000, 3000, 1, 0, x), effort(1000, 3000, 1) - effort(1000, 3000, x), x < 0.5 ? 5 : 2);
        expect_within(walk(4000, -3000, 1, 0, x), effort(4000, -3000, 1) - effort(4000, -3000, x), x < 0.5 ? 5 : 2.5);
    }
    assert_true(walk(1000, 3000, 1, 0, 0.1).most > 2 * walk(1000, 0, 1, 0, 0.1).most);
}

/* A busy machine makes a run longer, not less certain. */
static void busy_machine(void **state)
{
    (void)state;
    struct eta_left alone = walk(1000, 500, 1, 0, 0.5), busy = walk(1000, 500, 3, 0, 0.5);
    assert_true(fabs(busy.likely / alone.likely - 3) < 0.05);
    struct eta eta;
    eta_begin(&eta, 0);
    for (int i = 1; i <= 100; i++) eta_note(&eta, 0.005 * i, 5 * i, i <= 50 ? 5 * i : 250 + 25 * (i - 50));
    struct eta_left left = eta_left(&eta); /* it became busy half way: the effort is even */
    assert_true(left.most <= 1.22 * left.least);
    assert_true(fabs(left.likely - 1500) < 1);
}

static void nobody_knows(void **state)
{
    (void)state;
    struct eta eta;
    eta_begin(&eta, 0.5);
    assert_true(isinf(eta_left(&eta).likely));
    eta_note(&eta, 0.5, 1, 1);
    assert_true(isinf(eta_left(&eta).most));
    eta_note(&eta, 1, 2, 2);
    assert_true(eta_left(&eta).most == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(even_runs),
        cmocka_unit_test(trends),
        cmocka_unit_test(busy_machine),
        cmocka_unit_test(nobody_knows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
