/* cost.c - the CPU time by stages: which windows are looked at, what laps add up to, and how the rest is estimated. */
#include "solve/cost.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* The second window and every 37th after it are sampled, each kind by its own count. */
static void samples(void **state)
{
    (void)state;
    struct cost cost = {0};
    int sampled = 0;
    for (int i = 0; i < 3 * COST_EVERY; i++) {
        cost_open(&cost, COST_STEP);
        assert_true(cost.on == (i % COST_EVERY == 1));
        sampled += cost.on;
        if (i == 0) {
            cost_close(&cost, COST_STEP);
            continue;
        }
        cost_lap(&cost, COST_FACES);
        cost_close(&cost, COST_STEP);
        assert_false(cost.on);
        assert_int_equal(cost.sampled[COST_STEP], sampled);
    }
    assert_int_equal(sampled, 3);
    assert_int_equal(cost.n[COST_STEP], 3 * COST_EVERY);
    assert_int_equal(cost.n[COST_SYNC], 0);
}

static void spend(double seconds)
{
    double end = cost_cpu() + seconds;
    while (cost_cpu() < end) continue;
}

/* Time goes to the part whose lap ends it; a window that is not sampled takes none; the estimate counts all windows
 * like those that were sampled. */
static void laps(void **state)
{
    (void)state;
    struct cost cost = {0};
    double total[COST_PARTS];
    for (int i = 0; i < 4; i++) {
        cost_open(&cost, COST_STEP);
        if (i == 1) spend(0.02);
        cost_lap(&cost, COST_GATHER);
        if (i == 1) spend(0.01);
        cost_lap(&cost, COST_UPDATE);
        cost_close(&cost, COST_STEP);
    }
    cost_total(&cost, total);
    assert_true(total[COST_GATHER] > 4 * 0.015 && total[COST_UPDATE] > 4 * 0.005);
    assert_true(total[COST_GATHER] > total[COST_UPDATE]);
    assert_true(total[COST_FACES] == 0.0 && total[COST_LEVELS] == 0.0);
}

/* Kinds are scaled by their own counts; one that was never sampled adds nothing. */
static void totals(void **state)
{
    (void)state;
    struct cost cost = {.n = {74, 10}, .sampled = {2, 1}};
    double total[COST_PARTS];
    cost.sum[COST_STEP][COST_FACES] = 2.0;
    cost.sum[COST_SYNC][COST_FACES] = 0.5;
    cost.sum[COST_SYNC][COST_LEVELS] = 1.0;
    cost_total(&cost, total);
    assert_true(total[COST_FACES] == 2.0 * 37.0 + 0.5 * 10.0 && total[COST_LEVELS] == 10.0);
    cost.sampled[COST_SYNC] = 0;
    cost_total(&cost, total);
    assert_true(total[COST_FACES] == 74.0 && total[COST_LEVELS] == 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(samples), cmocka_unit_test(laps), cmocka_unit_test(totals)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
