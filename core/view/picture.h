/* picture.h - a field in a plane as a picture: colours, level lines, axes, colour bar, legend.
 *
 * The caller says what to show; the layout follows from the shape of the view: a colour bar on the right,
 * or below when the view is wide or shows two fields, so that nothing overlaps at any aspect ratio. */
#ifndef PICTURE_H
#define PICTURE_H

#include "view/colormap.h"
#include "view/contour.h"
#include "view/picture_scale.h"
#include "view/raster.h"

enum { PICTURE_LAYERS = 3, PICTURE_LINES = 16 }; /* lines: as in picture_header.h */

/* A field: one value per cell, its colours and their scale. */
struct picture_layer {
    size_t n;
    const struct raster_cell *cells;
    const double *values; /* SI; NaN is left white */
    struct picture_scale scale;
    struct colormap map;
};

struct picture_lines {
    const struct contour *contour;
    const char *name; /* in the legend */
};

struct picture {
    const char *title, *note;     /* first line; second line on the left (the time) */
    struct picture_scale axis[2]; /* lo, hi: what part of the plane is shown */
    double aspect;                /* height of the box over its width; 0: true to scale */
    bool halves;                  /* the first two layers are the left and the right half */
    bool inside;                  /* the last layer lies inside of the others: its colour bar stands on the right */
    unsigned n_layer;
    struct picture_layer layer[PICTURE_LAYERS];
    unsigned n_lines;
    struct picture_lines lines[PICTURE_LINES];
    const char *lines_label; /* what the legend says before the names */
    size_t n_tile;           /* outlines of mesh tiles */
    const struct raster_cell *tiles;
};

/* Draws on a new image surface, see picture_canvas_draw. */
int picture_draw(const struct picture *picture, int width, cairo_surface_t **ret_image);

#endif
