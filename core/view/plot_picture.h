/* plot_picture.h - what a picture of a snapshot shows: which fields, ranges, colours and interfaces. */
#ifndef PLOT_PICTURE_H
#define PLOT_PICTURE_H

#include "io/read.h"
#include "view/plot_option.h"

enum { PLOT_PICTURE_FIELDS = 24 };

/* What to show of each snapshot. A plane shows one field, or with `--left`, `--right` two: left, right; with --inside
 * one more, the last, in a material. A line shows all in one chart. */
struct plot_picture {
    const struct plot_option *option;
    unsigned n_field;
    const char *fields[PLOT_PICTURE_FIELDS];
    double time_like;                        /* the prefix of the time suits this: the last time of a series */
    bool common;                             /* use `extremes`, gathered by plot_draw_extremes from all snapshots */
    double extremes[PLOT_PICTURE_FIELDS][2]; /* start from +inf, -inf */
};

/* Is what the options leave of this snapshot a plane (2) or a line (1)? Surfaces in space are seen on a plane. */
int plot_picture_shape(const struct snapshot *snapshot, const struct plot_option *option);

/* Ends of the scale of a field in colours `map`: `range` if it is given, or what the field calls for, or else
 * `extremes` as they are; STATUS_CASE if these are those of nothing. */
int plot_picture_range(const struct plot_option_span *range, bool log, const char *name, const char *map,
                       double extremes[2]);

#endif
