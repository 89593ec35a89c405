/* chart.h - lines against a common abscissa: profiles in space, histories in time.
 *
 * Quantities of different units go into panels of their own, one above the other, with the same x. */
#ifndef CHART_H
#define CHART_H

#include "view/picture_scale.h"

#include <cairo.h>

enum { CHART_SERIES = 9, CHART_PANELS = 12 };

struct chart_series {
    const char *name; /* in the legend of a panel with several */
    bool reference;   /* from elsewhere: dashed, in black; its x may reach beyond the others */
    size_t n;
    const double *x, *y; /* SI; NaN interrupts the line */
};

struct chart_panel {
    struct picture_scale y; /* lo, hi: the range shown */
    const char *name;       /* what all its series show; NULL: what their names have in common */
    unsigned n_series;
    struct chart_series series[CHART_SERIES];
};

struct chart {
    const char *title, *note;
    struct picture_scale x;
    size_t n_mark;
    const double *marks; /* x of dotted lines through all panels: interfaces */
    unsigned n_panel;
    struct chart_panel panel[CHART_PANELS];
};

/* Draws on a new image surface, see picture_canvas_draw. Dots mark the points where there is room for them. */
int chart_draw(const struct chart *chart, int width, cairo_surface_t **ret_image);

/* Widens [*lo, *hi] by the finite values of a series whose x lies in [x[0], x[1]]; start from +inf, -inf. */
void chart_range(const struct chart_series *series, const double x[2], double *lo, double *hi);

#endif
