/* raster.c - see raster.h. Cells are splatted: every cell adds (area shared x shade) to the
 * pixels that it touches. The work is pixels + cells, independent of the order of cells. */
#include "view/raster.h"

#include "base/mem.h"
#include "view/colormap.h"

#include <math.h>
#include <stdint.h>

/* Pixels [first, last) that the interval [lo, hi] (in pixels) touches out of `count`. */
static void raster_span(double lo, double hi, int count, int *ret_first, int *ret_last)
{
    *ret_first = lo <= 0.0 ? 0 : lo >= count ? count : (int)floor(lo);
    *ret_last = hi <= 0.0 ? 0 : hi >= count ? count : (int)ceil(hi);
}

/* Length that [lo, hi] shares with the pixel [i, i + 1]. */
static double raster_share(double lo, double hi, int i)
{
    double from = lo > i ? lo : i, to = hi < i + 1 ? hi : i + 1;
    return to > from ? to - from : 0.0;
}

static void raster_splat(const struct raster_window *window, const struct raster_cell *cell, double shade, double *sum,
                         double *weight)
{
    double sx = window->width / (window->at[0][1] - window->at[0][0]);
    double sy = window->height / (window->at[1][1] - window->at[1][0]);
    double x0 = (cell->at[0][0] - window->at[0][0]) * sx, x1 = (cell->at[0][1] - window->at[0][0]) * sx;
    double y0 = (window->at[1][1] - cell->at[1][1]) * sy, y1 = (window->at[1][1] - cell->at[1][0]) * sy;
    int i0, i1, j0, j1;
    raster_span(x0, x1, window->width, &i0, &i1);
    raster_span(y0, y1, window->height, &j0, &j1);
    for (int j = j0; j < j1; j++) {
        double high = raster_share(y0, y1, j);
        size_t row = (size_t)j * (size_t)window->width;
        for (int i = i0; i < i1; i++) {
            double area = high * raster_share(x0, x1, i);
            sum[row + (size_t)i] += area * shade;
            weight[row + (size_t)i] += area;
        }
    }
}

void raster_mean(const struct raster_window *window, size_t n, const struct raster_cell *cells, const double *shade,
                 double *ret_mean)
{
    size_t pixels = (size_t)window->width * (size_t)window->height;
    double *weight = mem_new(pixels, sizeof *weight);
    for (size_t p = 0; p < pixels; p++) ret_mean[p] = 0.0;
    for (size_t c = 0; c < n; c++)
        if (isfinite(shade[c])) raster_splat(window, &cells[c], shade[c], ret_mean, weight);
    for (size_t p = 0; p < pixels; p++) ret_mean[p] = weight[p] > 1e-9 ? ret_mean[p] / weight[p] : NAN;
    mem_free(weight);
}

cairo_surface_t *raster_image(const struct raster_window *window, size_t n, const struct raster_cell *cells,
                              const double *shade, const struct colormap *map)
{
    double *clamped = mem_new(n, sizeof *clamped);
    for (size_t c = 0; c < n; c++) clamped[c] = shade[c] < 0.0 ? 0.0 : shade[c] > 1.0 ? 1.0 : shade[c];
    double *mean = mem_new((size_t)window->width * (size_t)window->height, sizeof *mean);
    raster_mean(window, n, cells, clamped, mean);

    cairo_surface_t *image = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, window->width, window->height);
    unsigned char *bytes = cairo_image_surface_get_data(image);
    int stride = cairo_image_surface_get_stride(image);
    for (int j = 0; bytes && j < window->height; j++) {
        uint32_t *row = (uint32_t *)(void *)(bytes + (ptrdiff_t)j * stride);
        for (int i = 0; i < window->width; i++)
            row[i] = colormap_at(map, mean[(size_t)j * (size_t)window->width + (size_t)i]);
    }
    cairo_surface_mark_dirty(image);
    mem_free(mean);
    mem_free(clamped);
    return image;
}
