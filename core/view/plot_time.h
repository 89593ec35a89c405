/* plot_time.h - the instant that --time asks for, among those that a run has kept. */
#ifndef PLOT_TIME_H
#define PLOT_TIME_H

#include <stddef.h>

/* The one of n ascending times, `step` apart in memory, that is nearest to t [s]. What lies before the first or beyond
 * the last of them by more than half of the longest interval between two (of a single one: by more than a thousandth of
 * it) is STATUS_CASE, with the range; `what` has these times: "the snapshots". */
int plot_time_nearest(const double *times, size_t n, size_t step, double t, const char *what, size_t *ret_index);

#endif
