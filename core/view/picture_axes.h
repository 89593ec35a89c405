/* picture_axes.h - the frame of a picture: box, ticks, numbers, labels; and colour bars.
 *
 * All lengths are points (1/72 inch); the surface is scaled to pixels by its owner. */
#ifndef PICTURE_AXES_H
#define PICTURE_AXES_H

#include "view/picture_scale.h"

#include <cairo.h>

struct colormap;

struct picture_rect {
    double x, y, w, h;
};

/* Chooses ticks whose numbers have room along an axis of this length. */
void picture_axes_fit(cairo_t *cr, struct picture_scale *scale, double length, bool upright);

/* Room that numbers and label need beside the box: left of it for an upright scale, else below it. */
double picture_axes_room(cairo_t *cr, const struct picture_scale *scale, bool upright);

struct picture_axes {
    bool below;  /* numbers and label under the box */
    double room; /* left of the box: the label of y goes to its edge; 0: as much as y needs */
};

/* Frame, ticks, numbers and labels of fitted scales. */
void picture_axes_draw(cairo_t *cr, struct picture_rect box, const struct picture_scale *x,
                       const struct picture_scale *y, struct picture_axes axes);

/* A colour bar in `box`: upright with numbers on its right, or level with numbers below. Pointed ends say that the
 * data go on beyond them. */
struct picture_bar {
    const struct picture_scale *scale; /* fitted */
    const struct colormap *map;
    bool upright, goes_below, goes_above;
};

void picture_axes_bar(cairo_t *cr, struct picture_rect box, const struct picture_bar *bar);

/* Room of its numbers and label: right of an upright bar, below a level one. */
double picture_axes_bar_room(cairo_t *cr, const struct picture_bar *bar);

#endif
