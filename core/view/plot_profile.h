/* plot_profile.h - fields along a line of cells, as a chart with one panel per unit. */
#ifndef PLOT_PROFILE_H
#define PLOT_PROFILE_H

#include "view/chart.h"
#include "view/plot_picture.h"
#include "view/plot_view.h"

/* Draws the fields of a view with one axis. `window`: the part of its axis that is shown; `note`: the time. */
int plot_profile_draw(const struct plot_view *view, const struct plot_picture *picture, const double window[2],
                      const char *note, cairo_surface_t **ret_image);

/* Puts a series into the chart: into the last panel if that has the same unit and room, else into a new one.
 * `units` has a unit for each panel; STATUS_CASE if there are too many. */
int plot_profile_add(struct chart *chart, const char *units[CHART_PANELS], struct chart_series series,
                     const char *unit);

/* Sets the scale of every panel: from --range, or from the panel's `extremes` (NULL: from its series within the
 * window of x), with a little air. */
int plot_profile_scale(struct chart *chart, const char *const units[CHART_PANELS], const double window[2],
                       const struct plot_option *option, const double (*extremes)[2]);

#endif
