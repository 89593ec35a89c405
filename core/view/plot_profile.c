/* plot_profile.c - see plot_profile.h. Used for profiles in space and for histories. */
#include "view/plot_profile.h"

#include "base/mem.h"
#include "base/status.h"
#include "view/plot_interface.h"

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

/* The name of a panel, or what those of its series have in common: "volume fraction" of "volume fraction of air" and
 * "... of water". */
static void plot_profile_name(const struct chart_panel *panel, char *ret_name, size_t size)
{
    snprintf(ret_name, size, "%s", panel->name ? panel->name : panel->series[0].name);
    for (unsigned i = 1; !panel->name && i < panel->n_series && !panel->series[i].reference; i++) {
        size_t same = 0, word = 0;
        const char *other = panel->series[i].name;
        for (; ret_name[same] && ret_name[same] == other[same]; same++)
            if (ret_name[same] == ' ') word = same;
        if (!ret_name[same] && (!other[same] || other[same] == ' ')) word = same;
        ret_name[word] = '\0';
    }
    size_t length = strlen(ret_name);
    const char *tail = length > 3 ? ret_name + length - 3 : "";
    if (!panel->name && panel->n_series > 1 && !panel->series[1].reference &&
        (strcmp(tail, " of") == 0 || strcmp(tail, " at") == 0))
        ret_name[length - 3] = '\0';
}

/* The range that a panel shows of data that reach from range[0] to range[1]. */
static int plot_profile_range(const char *name, const struct plot_option *option, double range[2])
{
    if (option->range[0].given) {
        range[0] = option->range[0].lo;
        range[1] = option->range[0].hi;
    } else if (range[0] > range[1]) {
        range[0] = range[1] = option->log;
    } else if (option->log && range[0] <= 0.0) {
        return status_fail(STATUS_CASE, "--log: %s reaches %g; give --range LO,HI with LO > 0", name, range[0]);
    } else if (option->log) {
        double air = pow(range[1] / range[0], 0.05);
        range[0] /= air;
        range[1] *= air;
    } else {
        double air = 0.05 * (range[1] - range[0]);
        range[0] -= air;
        range[1] += air;
    }
    return STATUS_OK;
}

int plot_profile_scale(struct chart *chart, const char *const units[CHART_PANELS], const double window[2],
                       const struct plot_option *option, const double (*extremes)[2])
{
    for (unsigned p = 0; p < chart->n_panel; p++) {
        struct chart_panel *panel = &chart->panel[p];
        double range[2] = {INFINITY, -INFINITY};
        char name[PICTURE_SCALE_LABEL];
        if (extremes) memcpy(range, extremes[p], sizeof range);
        for (unsigned i = 0; !extremes && i < panel->n_series; i++)
            chart_range(&panel->series[i], window, &range[0], &range[1]);
        plot_profile_name(panel, name, sizeof name);
        TRY(plot_profile_range(panel->name ? name : panel->series[0].name, option, range));
        picture_scale_init(&panel->y,
                           &(struct picture_scale_inp){
                               .name = name, .unit = units[p], .lo = range[0], .hi = range[1], .log = option->log});
    }
    return STATUS_OK;
}

struct profile_data {
    struct plot_field fields[PLOT_PICTURE_FIELDS];
    double *values[PLOT_PICTURE_FIELDS];
    const char *units[CHART_PANELS];
    double extremes[CHART_PANELS][2]; /* of all snapshots, when the picture has them */
};

/* Widens the extremes of the panel that a field went to. */
static void plot_profile_widen(double panel[2], const double field[2])
{
    if (field[0] < panel[0]) panel[0] = field[0];
    if (field[1] > panel[1]) panel[1] = field[1];
}

static int plot_profile_fill(const struct plot_view *view, const struct plot_picture *picture, const double *x,
                             struct profile_data *data, struct chart *chart)
{
    for (unsigned i = 0; i < picture->n_field; i++) {
        struct plot_field *field = &data->fields[i];
        TRY(plot_field_find(view->snapshot, picture->fields[i], field));
        data->values[i] = plot_view_values(view, field);
        struct chart_series series = {.name = field->label, .n = view->n, .x = x, .y = data->values[i]};
        unsigned before = chart->n_panel;
        TRY(plot_profile_add(chart, data->units, series, field->field->unit));
        double *extremes = data->extremes[chart->n_panel - 1];
        if (chart->n_panel > before) memcpy(extremes, picture->extremes[i], sizeof data->extremes[0]);
        else plot_profile_widen(extremes, picture->extremes[i]);
    }
    return STATUS_OK;
}

int plot_profile_draw(const struct plot_view *view, const struct plot_picture *picture, const double window[2],
                      const char *note, cairo_surface_t **ret_image)
{
    struct chart chart = {.title = view->snapshot->title, .note = note};
    struct profile_data *data = mem_new(1, sizeof *data);
    double *x = mem_new(view->n, sizeof *x), *marks = NULL;
    for (size_t c = 0; c < view->n; c++) x[c] = 0.5 * (view->cells[c].at[0][0] + view->cells[c].at[0][1]);
    picture_scale_init(&chart.x, &(struct picture_scale_inp){.name = plot_field_axis(view->snapshot, view->axis[0]),
                                                             .unit = "m",
                                                             .lo = window[0],
                                                             .hi = window[1]});
    int code = plot_interface_places(view, picture->option->contours, &marks, &chart.n_mark);
    chart.marks = marks;
    if (!code) code = plot_profile_fill(view, picture, x, data, &chart);
    const double(*extremes)[2] = picture->common ? (const double(*)[2])data->extremes : NULL;
    if (!code) code = plot_profile_scale(&chart, data->units, window, picture->option, extremes);
    if (!code) code = chart_draw(&chart, picture->option->width, ret_image);
    for (unsigned i = 0; i < picture->n_field; i++) mem_free(data->values[i]);
    mem_free(data);
    mem_free(marks);
    mem_free(x);
    return code;
}
