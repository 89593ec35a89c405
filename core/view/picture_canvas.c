/* picture_canvas.c - see picture_canvas.h. The layout is the same at every width: only the scale differs. */
#include "view/picture_canvas.h"

#include "base/mem.h"
#include "base/status.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

static const double picture_canvas_resolution = 3.0; /* pixels per point: 216 dpi */

static void picture_canvas_measure(const struct picture_canvas *canvas, double ret_size[2])
{
    cairo_surface_t *nothing = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, 1, 1);
    cairo_t *cr = cairo_create(nothing);
    canvas->plan(cr, canvas->data, ret_size);
    cairo_destroy(cr);
    cairo_surface_destroy(nothing);
}

/* Video encoders halve the resolution of colours: both numbers of pixels must be even for a film. */
static int picture_canvas_even(double pixels)
{
    return 2 * (int)ceil(0.5 * pixels);
}

int picture_canvas_draw(const struct picture_canvas *canvas, int width, cairo_surface_t **ret_image)
{
    double size[2];
    picture_canvas_measure(canvas, size);
    double scale = width > 0 ? picture_canvas_even(width) / size[0] : picture_canvas_resolution;
    int pixels[2] = {picture_canvas_even(width > 0 ? width : size[0] * scale), picture_canvas_even(size[1] * scale)};
    cairo_surface_t *image = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, pixels[0], pixels[1]);
    cairo_t *cr = cairo_create(image);
    if (cairo_status(cr) == CAIRO_STATUS_SUCCESS) {
        cairo_set_source_rgb(cr, 1.0, 1.0, 1.0);
        cairo_paint(cr);
        cairo_scale(cr, scale, scale);
        canvas->paint(cr, canvas->data, scale);
    }
    cairo_status_t status = cairo_status(cr);
    cairo_destroy(cr);
    if (status == CAIRO_STATUS_SUCCESS) {
        *ret_image = image;
        return STATUS_OK;
    }
    cairo_surface_destroy(image);
    return status_fail(STATUS_RUN, "cannot draw a picture of %d x %d pixels: %s", pixels[0], pixels[1],
                       cairo_status_to_string(status));
}

/* Makes the folder of a file if its own parent is there; if that fails, so will writing, with a better reason. */
static void picture_canvas_make_folder(const char *path)
{
    const char *slash = strrchr(path, '/');
    if (!slash || slash == path) return;
    char *folder = mem_text_n(path, (size_t)(slash - path));
    mkdir(folder, 0777);
    mem_free(folder);
}

int picture_canvas_write(cairo_surface_t *image, const char *path)
{
    picture_canvas_make_folder(path);
    char *temporary = mem_print("%s.tmp", path);
    cairo_status_t status = cairo_surface_write_to_png(image, temporary);
    int code = STATUS_OK;
    if (status != CAIRO_STATUS_SUCCESS)
        code = status_fail(STATUS_RUN, "cannot write %s: %s", path, cairo_status_to_string(status));
    else if (rename(temporary, path) != 0) code = status_fail(STATUS_RUN, "cannot write %s: %s", path, strerror(errno));
    if (code) remove(temporary);
    mem_free(temporary);
    return code;
}
