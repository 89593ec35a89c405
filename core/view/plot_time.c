/* plot_time.c - see plot_time.h. The last interval of a run is often shorter than the others: the longest one
 * counts. */
#include "view/plot_time.h"

#include "base/status.h"

#include <math.h>

/* How far beyond the ends a time may lie. */
static double plot_time_slack(const double *times, size_t n, size_t step)
{
    double longest = 2e-3 * fabs(times[(n - 1) * step]);
    for (size_t i = 1; i < n; i++) longest = fmax(longest, times[i * step] - times[(i - 1) * step]);
    return 0.5 * longest;
}

int plot_time_nearest(const double *times, size_t n, size_t step, double t, const char *what, size_t *ret_index)
{
    double first = times[0], last = times[(n - 1) * step], slack = plot_time_slack(times, n, step);
    if (!(t >= first - slack && t <= last + slack))
        return status_fail(STATUS_CASE, "--time %g: %s reach from %.6g s to %.6g s; did you mean --time %.6g?", t, what,
                           first, last, t < first ? first : last);
    size_t near = 0;
    for (size_t i = 1; i < n; i++)
        if (fabs(times[i * step] - t) < fabs(times[near * step] - t)) near = i;
    *ret_index = near;
    return STATUS_OK;
}
