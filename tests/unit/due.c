/* due.c - output times are hit exactly, once, and without slivers of steps. */
#include "run/due.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

/* Walks with steps of at most dt as the run does; returns the steps, stores the smallest. */
static long walk(struct due *a, struct due *b, double dt, double until, long *ret_a, long *ret_b, double *ret_least)
{
    const struct due *const dues[] = {a, b};
    struct due *const both[] = {a, b};
    long *const counts[] = {ret_a, ret_b}, step = 0;
    double t = 0;
    *ret_least = INFINITY;
    *ret_a = *ret_b = 0;
    for (;;) {
        for (int i = 0; i < 2; i++)
            if (due_now(both[i], t, step)) {
                if (both[i]->every.time > 0)
                    assert_true(t == (double)both[i]->next * both[i]->every.time || t == until);
                due_written(both[i], t, step);
                assert_false(due_now(both[i], t, step));
                ++*counts[i];
            }
        if (t >= until) return step;
        double target = due_target(dues, 2, t, until), left = target - t, take = due_step(dt, left);
        assert_true(take > 0 && take <= 1.0001 * dt);
        if (take < *ret_least) *ret_least = take;
        t = take == left ? target : t + take;
        step++;
    }
}

static void times_are_hit_once_without_slivers(void **state)
{
    (void)state;
    struct due a, b;
    long n_a, n_b;
    double least;
    due_init(&a, (struct scene_every){.time = 0.1e-6});
    due_init(&b, (struct scene_every){.time = 0.3e-6});
    walk(&a, &b, 0.7e-8, 1e-6, &n_a, &n_b, &least);
    assert_int_equal(n_a, 11); /* 10 * 0.1e-6 and 1e-6 are one time */
    assert_int_equal(n_b, 4);
    assert_true(least > 0.3e-8);
}

static void steps_are_counted(void **state)
{
    (void)state;
    struct due a, b;
    long n_a, n_b;
    double least;
    due_init(&a, (struct scene_every){.steps = 7});
    due_init(&b, (struct scene_every){0});
    long steps = walk(&a, &b, 0.01, 1, &n_a, &n_b, &least);
    assert_int_equal(steps, 100);
    assert_int_equal(n_a, 15);
    assert_int_equal(n_b, 0);
    assert_true(least > 0.0099);
}

static void remainders(void **state)
{
    (void)state;
    assert_true(due_step(1, 5) == 1);
    assert_true(due_step(1, 1.00005) == 1.00005);
    assert_true(due_step(1, 1.5) == 0.75);
    assert_true(due_step(1, 0.1) == 0.1);
}

/* Half an hour by the wall clock, counted from the last time that an output was written, or could not be. */
static void wall_time_passes(void **state)
{
    (void)state;
    struct due_wall due = {.every = 1800.0}, never = {.every = 0.0};
    assert_false(due_wall_now(&due, 0.0));
    assert_false(due_wall_now(&due, 1799.9));
    assert_true(due_wall_now(&due, 2000.0) && due_wall_now(&due, 2001.0));
    due_wall_written(&due);
    assert_false(due_wall_now(&due, 2001.0) || due_wall_now(&due, 3800.9));
    assert_true(due_wall_now(&due, 3801.0));
    assert_false(due_wall_now(&never, 1e9));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(times_are_hit_once_without_slivers),
        cmocka_unit_test(steps_are_counted),
        cmocka_unit_test(remainders),
        cmocka_unit_test(wall_time_passes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
