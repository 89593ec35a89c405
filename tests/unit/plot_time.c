/* The instant that --time asks for, and times that a run has not kept. */
#include "base/status.h"
#include "view/plot_time.h"
#include "close.h"

#include <string.h>

/* Half an interval beyond the ends at most, the longest one: the last is often cut short. */
static void times_outside_of_a_run_are_refused(void **state)
{
    (void)state;
    const double times[] = {1.0, 2.0, 2.1}, rows[] = {1.0, 1.0, 2.0, 2.0};
    size_t index = 9;
    assert_int_equal(plot_time_nearest(times, 3, 1, 2.6, "the snapshots", &index), 0);
    assert_int_equal(index, 2);
    assert_int_equal(plot_time_nearest(times, 3, 1, 0.5, "the snapshots", &index), 0);
    assert_int_equal(index, 0);
    assert_int_equal(plot_time_nearest(times, 3, 1, 2.65, "the snapshots", &index), STATUS_CASE);
    assert_non_null(strstr(status_text(), "the snapshots reach from 1 s to 2.1 s"));
    assert_int_equal(plot_time_nearest(times, 3, 1, 0.4, "the snapshots", &index), STATUS_CASE);
    assert_int_equal(plot_time_nearest(times, 1, 1, 1.0005, "the snapshots", &index), 0);
    assert_int_equal(plot_time_nearest(times, 1, 1, 1.1, "the snapshots", &index), STATUS_CASE);
    assert_int_equal(plot_time_nearest(rows, 2, 2, 1.7, "the map's rows", &index), 0);
    assert_int_equal(index, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(times_outside_of_a_run_are_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
