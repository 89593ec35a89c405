/* plot_profile.c - see plot_profile.h. Used for profiles in space and for histories. */
#include "app/plot_profile.h"

#include "app/plot_interface.h"
#include "base/mem.h"
#include "base/status.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

int plot_profile_add(struct chart *chart, const char *units[CHART_PANELS], struct chart_series series, const char *unit)
{
    struct chart_panel *last = chart->n_panel ? &chart->panel[chart->n_panel - 1] : NULL;
    bool joins = last && *unit && strcmp(units[chart->n_panel - 1], unit) == 0 && last->n_series < CHART_SERIES;
    if (!joins && chart->n_panel == CHART_PANELS)
        return status_fail(STATUS_CASE, "too many quantities for one chart: at most %d panels", CHART_PANELS);
    if (!joins) {
        units[chart->n_panel] = unit;
        last = &chart->panel[chart->n_panel++];
    }
    last->series[last->n_series++] = series;
    return STATUS_OK;
}

/* What the names of a panel have in common: "volume fraction" of "volume fraction of air" and "... of water". */
static void profile_name(const struct chart_panel *panel, char *ret_name, size_t size)
{
    snprintf(ret_name, size, "%s", panel->series[0].name);
    for (unsigned i = 1; i < panel->n_series; i++) {
        size_t same = 0, word = 0;
        const char *other = panel->series[i].name;
        for (; ret_name[same] && ret_name[same] == other[same]; same++)
            if (ret_name[same] == ' ') word = same;
        if (!ret_name[same] && (!other[same] || other[same] == ' ')) word = same;
        ret_name[word] = '\0';
    }
    size_t length = strlen(ret_name);
    const char *tail = length > 3 ? ret_name + length - 3 : "";
    if (panel->n_series > 1 && (strcmp(tail, " of") == 0 || strcmp(tail, " at") == 0)) ret_name[length - 3] = '\0';
}

static int profile_panel_range(const struct chart_panel *panel, const double window[2],
                               const struct plot_option *option, double extremes[2])
{
    extremes[0] = INFINITY;
    extremes[1] = -INFINITY;
    for (unsigned i = 0; i < panel->n_series; i++) chart_range(&panel->series[i], window, &extremes[0], &extremes[1]);
    if (option->range.given) {
        extremes[0] = option->range.lo;
        extremes[1] = option->range.hi;
    } else if (extremes[0] > extremes[1]) {
        extremes[0] = extremes[1] = option->log;
    } else if (option->log && extremes[0] <= 0.0) {
        return status_fail(STATUS_CASE, "--log: %s reaches %g; give --range LO,HI with LO > 0", panel->series[0].name,
                           extremes[0]);
    } else if (option->log) {
        double air = pow(extremes[1] / extremes[0], 0.05);
        extremes[0] /= air;
        extremes[1] *= air;
    } else {
        double air = 0.05 * (extremes[1] - extremes[0]);
        extremes[0] -= air;
        extremes[1] += air;
    }
    return STATUS_OK;
}

int plot_profile_scale(struct chart *chart, const char *const units[CHART_PANELS], const double window[2],
                       const struct plot_option *option)
{
    for (unsigned p = 0; p < chart->n_panel; p++) {
        struct chart_panel *panel = &chart->panel[p];
        double extremes[2];
        char name[PICTURE_SCALE_LABEL];
        TRY(profile_panel_range(panel, window, option, extremes));
        profile_name(panel, name, sizeof name);
        picture_scale_init(&panel->y, &(struct picture_scale_inp){.name = name,
                                                                  .unit = units[p],
                                                                  .lo = extremes[0],
                                                                  .hi = extremes[1],
                                                                  .log = option->log});
    }
    return STATUS_OK;
}

static int profile_fill(const struct plot_view *view, const struct plot_picture *picture, const double *x,
                        struct plot_field *fields, double **values, struct chart *chart, const char **units)
{
    for (unsigned i = 0; i < picture->n_field; i++) {
        TRY(plot_field_find(view->snapshot, picture->fields[i], &fields[i]));
        values[i] = plot_view_values(view, &fields[i]);
        struct chart_series series = {.name = fields[i].label, .n = view->n, .x = x, .y = values[i]};
        TRY(plot_profile_add(chart, units, series, fields[i].field->unit));
    }
    return STATUS_OK;
}

int plot_profile_draw(const struct plot_view *view, const struct plot_picture *picture, const double window[2],
                      const char *note, cairo_surface_t **ret_image)
{
    struct chart chart = {.title = view->snapshot->title, .note = note};
    struct plot_field *fields = mem_new(picture->n_field, sizeof *fields);
    double *values[PLOT_PICTURE_FIELDS] = {0}, *x = mem_new(view->n, sizeof *x);
    double *marks = NULL;
    const char *units[CHART_PANELS];
    for (size_t c = 0; c < view->n; c++) x[c] = 0.5 * (view->cells[c].at[0][0] + view->cells[c].at[0][1]);
    picture_scale_init(&chart.x, &(struct picture_scale_inp){.name = plot_field_axis(view->snapshot, view->axis[0]),
                                                             .unit = "m",
                                                             .lo = window[0],
                                                             .hi = window[1]});
    int code = plot_interface_places(view, picture->option->contours, &marks, &chart.n_mark);
    chart.marks = marks;
    if (!code) code = profile_fill(view, picture, x, fields, values, &chart, units);
    if (!code) code = plot_profile_scale(&chart, units, window, picture->option);
    if (!code) code = chart_draw(&chart, picture->option->width, ret_image);
    for (unsigned i = 0; i < picture->n_field; i++) mem_free(values[i]);
    mem_free(marks);
    mem_free(fields);
    mem_free(x);
    return code;
}
