/* plot_space.h - surfaces of a snapshot in space (--iso), with cuts through it (--slice), as a picture. Axisymmetric
 * runs are turned about their axis. */
#ifndef PLOT_SPACE_H
#define PLOT_SPACE_H

#include "view/plot_picture.h"

#include <cairo.h>

/* As plot_draw and plot_draw_extremes, for options with --iso. A field, if there is one, colours the cuts, or
 * without cuts the surfaces. */
int plot_space_draw(const struct snapshot *snapshot, const struct plot_picture *picture, cairo_surface_t **ret_image);
int plot_space_extremes(const struct snapshot *snapshot, struct plot_picture *picture);

#endif
