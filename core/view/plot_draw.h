/* plot_draw.h - a snapshot as a picture: of a plane, a line or surfaces in space. */
#ifndef PLOT_DRAW_H
#define PLOT_DRAW_H

#include "view/plot_picture.h"

#include <cairo.h>

/* Widens `extremes` by what the picture of this snapshot would show. */
int plot_draw_extremes(const struct snapshot *snapshot, struct plot_picture *picture);

/* Draws the picture; the caller destroys the image. STATUS_CASE: unknown fields or materials, windows outside
 * of the domain, and the like. */
int plot_draw(const struct snapshot *snapshot, const struct plot_picture *picture, cairo_surface_t **ret_image);

#endif
