/* plot_picture.h - a snapshot as a picture: which fields, ranges, colours and interfaces to draw. */
#ifndef PLOT_PICTURE_H
#define PLOT_PICTURE_H

#include "io/read.h"
#include "view/plot_option.h"

#include <cairo.h>

enum { PLOT_PICTURE_FIELDS = 24 };

/* What to show of each snapshot. A plane shows one field, or with `--left`, `--right` two: left, right; with --inside
 * one more, the last, in a material. A line shows all in one chart. */
struct plot_picture {
    const struct plot_option *option;
    unsigned n_field;
    const char *fields[PLOT_PICTURE_FIELDS];
    double time_like;                        /* the prefix of the time suits this: the last time of a series */
    bool common;                             /* use `extremes`, gathered by plot_picture_extremes from all snapshots */
    double extremes[PLOT_PICTURE_FIELDS][2]; /* start from +inf, -inf */
};

/* Is what the options leave of this snapshot a plane (2) or a line (1)? Surfaces in space are seen on a plane. */
int plot_picture_shape(const struct snapshot *snapshot, const struct plot_option *option);

/* Widens `extremes` by what the picture of this snapshot would show. */
int plot_picture_extremes(const struct snapshot *snapshot, struct plot_picture *picture);

/* Ends of the scale of a field in colours `map`: `range` if it is given, or what the field calls for, or else `extremes`
 * as they are; STATUS_CASE if these are those of nothing. */
int plot_picture_range(const struct plot_option_span *range, bool log, const char *name, const char *map,
                       double extremes[2]);

/* Draws the picture; the caller destroys the image. STATUS_CASE: unknown fields or materials, windows outside
 * of the domain, and the like. */
int plot_picture_draw(const struct snapshot *snapshot, const struct plot_picture *picture, cairo_surface_t **ret_image);

#endif
