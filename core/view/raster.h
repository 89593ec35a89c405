/* raster.h - cells of a plane onto pixels, whatever their sizes.
 *
 * Each pixel is the mean of the cells that it covers, weighted by the area they share: edges of
 * cells lie where they belong to a fraction of a pixel, small cells do not flicker, and a mesh
 * with several levels needs no special case. */
#ifndef RASTER_H
#define RASTER_H

#include <cairo.h>
#include <stddef.h>

/* A cell: [axis][0 lower, 1 upper]. */
struct raster_cell {
    double at[2][2];
};

/* A part of the plane, [axis][0 lower, 1 upper], on width x height pixels; the second axis
 * points up. */
struct raster_window {
    double at[2][2];
    int width, height;
};

struct colormap;

/* Mean of `shade` (one per cell) in every pixel: ret_mean[height * width], top row first, NaN
 * where no cell with a finite shade is. */
void raster_mean(const struct raster_window *window, size_t n, const struct raster_cell *cells, const double *shade,
                 double *ret_mean);

/* The same as colours, in a new image surface of the window's size; shades are clamped to
 * [0, 1] before they are averaged. The caller destroys the surface. */
cairo_surface_t *raster_image(const struct raster_window *window, size_t n, const struct raster_cell *cells,
                              const double *shade, const struct colormap *map);

#endif
