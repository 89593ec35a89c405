/* plot_picture.c - see plot_picture.h. */
#include "view/plot_picture.h"

#include "base/status.h"

#include <math.h>
#include <string.h>

int plot_picture_shape(const struct snapshot *snapshot, const struct plot_option *option)
{
    if (option->n_iso) return 2;
    int left = snapshot->dim;
    for (int axis = 0; axis < snapshot->dim; axis++) left -= option->sliced[axis];
    return left == 3 ? 2 : left;
}

int plot_picture_range(const struct plot_option_span *range, bool log, const char *name, const char *map,
                       double extremes[2])
{
    bool fraction = strcmp(name, "schlieren") == 0 || strncmp(name, "alpha_", 6) == 0;
    if (range->given) {
        extremes[0] = range->lo;
        extremes[1] = range->hi;
    } else if (extremes[0] > extremes[1]) {
        if (log) return status_fail(STATUS_CASE, "--log: %s has no values above 0", name);
        return status_fail(STATUS_CASE, "%s has no finite values in the picture", name);
    } else if (fraction && !log && extremes[0] >= -0.01 && extremes[1] <= 1.01) {
        extremes[0] = 0.0;
        extremes[1] = 1.0;
    } else if (strcmp(map, "balance") == 0 && !log) {
        double size = fmax(fabs(extremes[0]), fabs(extremes[1]));
        extremes[0] = -size;
        extremes[1] = size;
    }
    return STATUS_OK;
}
