/* picture_canvas.h - a page of any resolution: planned once in points, painted on an image, kept as PNG. */
#ifndef PICTURE_CANVAS_H
#define PICTURE_CANVAS_H

#include <cairo.h>
#include <stddef.h>

/* What goes on a page. `plan` measures text and sets the size of the page in points; `paint` gets a white page
 * scaled to points, `scale` pixels each. Both get `data`. */
struct picture_canvas {
    void (*plan)(cairo_t *cr, void *data, double ret_size[2]);
    void (*paint)(cairo_t *cr, void *data, double scale);
    void *data;
};

/* Draws on a new image surface `width` pixels wide (0: 3 pixels per point), width and height rounded up to even
 * numbers: pictures are frames of films, and encoders take no odd ones. The caller destroys it. STATUS_RUN if the image
 * is too large. */
int picture_canvas_draw(const struct picture_canvas *canvas, int width, cairo_surface_t **ret_image);

/* Writes an image as PNG, by way of a temporary name; makes the folder if only that is missing. STATUS_RUN with the
 * reason if that fails. */
int picture_canvas_write(cairo_surface_t *image, const char *path);

#endif
