/* plot_along.c - see plot_along.h. */
#include "view/plot_along.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "view/map_table.h"
#include "view/picture_canvas.h"
#include "view/plot_case.h"
#include "view/plot_profile.h"
#include "view/plot_time.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { ALONG_LABEL = 256 };

struct along_line {
    const struct map_table *map;
    size_t row; /* of the table: the first of the time */
    char label[ALONG_LABEL];
};

struct along {
    unsigned n_map, n_field, n_line;
    const char *const *directories;
    struct map_table maps[CHART_SERIES];
    char *fields[CHART_PANELS];
    char *labels[CHART_PANELS];
    char *runs[CHART_SERIES]; /* names, one for each map */
    struct along_line lines[CHART_SERIES];
};

static void plot_along_add(struct along *along, const struct map_table *map, size_t time, const char *run)
{
    struct along_line *line = &along->lines[along->n_line++];
    const double *times = map->table.columns[0];
    char moment[PICTURE_SCALE_LABEL];
    line->map = map;
    line->row = time * map->n_place;
    picture_scale_quantity(times[line->row], times[line->row], "s", moment);
    snprintf(line->label, sizeof line->label, "%.80s%s%s", run ? run : "", run ? ", " : "", moment);
}

static int plot_along_lines(struct along *along, const struct plot_option *option)
{
    const struct plot_option_span *limit = &option->limit[0];
    const double window[] = {limit->given ? limit->lo : -INFINITY, limit->given ? limit->hi : INFINITY};
    unsigned each = option->n_time ? option->n_time : 1;
    if (along->n_map * each > CHART_SERIES)
        return status_fail(STATUS_CASE, "%u lines in one picture (%u runs, %u times): at most %d", along->n_map * each,
                           along->n_map, each, CHART_SERIES);
    for (unsigned m = 0; m < along->n_map; m++) {
        const struct map_table *map = &along->maps[m];
        const char *run = along->n_map > 1 ? along->runs[m] : NULL;
        const double *values;
        if (map->n_side[0])
            return status_fail(STATUS_CASE, "map %s is a rectangle, which 'bulla plot %s map %s %s --time T' draws",
                               map->name, along->directories[m], map->name, along->fields[0]);
        TRY(map_table_column(map, along->fields[0], &values));
        for (unsigned i = 0; i < option->n_time; i++) {
            size_t time;
            TRY(plot_time_nearest(map->table.columns[0], map->n_time, map->n_place, option->times[i], "the map's rows",
                                  &time));
            plot_along_add(along, map, time, run);
        }
        if (!option->n_time) plot_along_add(along, map, map_table_highest(map, values, window), run);
    }
    return STATUS_OK;
}

static int plot_along_fields(struct along *along, char *list)
{
    for (char *field = strtok(list, ","); field; field = strtok(NULL, ",")) {
        if (along->n_field == CHART_PANELS)
            return status_fail(STATUS_CASE, "too many fields: at most %d", CHART_PANELS);
        along->fields[along->n_field++] = field;
    }
    return along->n_field ? STATUS_OK : status_fail(STATUS_CASE, "a field is needed");
}

static int plot_along_fill(struct along *along, struct chart *chart, const char **units, double window[2])
{
    for (unsigned f = 0; f < along->n_field; f++) {
        struct chart_panel *panel = &chart->panel[chart->n_panel++];
        units[f] = map_table_unit(&along->maps[0], along->fields[f]);
        along->labels[f] = map_table_label(&along->maps[0], along->fields[f]);
        panel->name = along->labels[f];
        for (unsigned i = 0; i < along->n_line; i++) {
            const struct along_line *line = &along->lines[i];
            const double *values, *places = line->map->table.columns[1];
            size_t n = line->map->n_place;
            TRY(map_table_column(line->map, along->fields[f], &values));
            panel->series[panel->n_series++] =
                (struct chart_series){.name = line->label, .n = n, .x = places, .y = values + line->row};
            window[0] = fmin(window[0], fmin(places[0], places[n - 1]));
            window[1] = fmax(window[1], fmax(places[0], places[n - 1]));
        }
    }
    return STATUS_OK;
}

static int plot_along_draw(struct along *along, const char *const *directories, const struct plot_option *option,
                           cairo_surface_t **ret_image)
{
    char *title = plot_case_common_title(directories, along->n_map), *place = map_table_place(&along->maps[0]);
    char *note = along->n_line > 1 ? mem_text(along->maps[0].name)
                                   : mem_print("%s, %s", along->maps[0].name, along->lines[0].label);
    struct chart chart = {.title = title, .note = note};
    const char *units[CHART_PANELS];
    double window[2] = {INFINITY, -INFINITY};
    int code = plot_along_fill(along, &chart, units, window);
    if (option->limit[0].given) {
        window[0] = option->limit[0].lo;
        window[1] = option->limit[0].hi;
    }
    picture_scale_init(&chart.x,
                       &(struct picture_scale_inp){.name = place, .unit = "m", .lo = window[0], .hi = window[1]});
    if (!code) code = plot_profile_scale(&chart, units, window, option, NULL);
    if (!code) code = chart_draw(&chart, option->width, ret_image);
    mem_free(note);
    mem_free(place);
    mem_free(title);
    return code;
}

static char *plot_along_path(const struct along *along, const char *directory, const struct plot_option *option)
{
    if (option->output) return mem_text(option->output);
    struct text path = {0};
    text_add(&path, "%s/plots/profile_%s", directory, along->maps[0].name);
    for (unsigned f = 0; f < along->n_field; f++) text_add(&path, "%c%s", f ? '+' : '_', along->fields[f]);
    text_add(&path, ".png");
    char *result = mem_text(path.at);
    text_done(&path);
    return result;
}

static int plot_along_picture(struct along *along, const char *const *directories, const struct plot_option *option)
{
    cairo_surface_t *image;
    TRY(plot_along_lines(along, option));
    TRY(plot_along_draw(along, directories, option, &image));
    char *path = plot_along_path(along, directories[0], option);
    int code = picture_canvas_write(image, path);
    if (!code) printf("%s\n", path);
    cairo_surface_destroy(image);
    mem_free(path);
    return code;
}

int plot_along_write(const char *const *directories, unsigned n_directory, const char *const *words, unsigned n,
                     const struct plot_option *option)
{
    if (n < 1) return map_table_missing(directories[0], NULL);
    if (n != 2)
        return status_fail(STATUS_CASE, "a map and a field are needed: bulla plot %s profile %s FIELD", directories[0],
                           words[0]);
    if (n_directory > CHART_SERIES)
        return status_fail(STATUS_CASE, "%u runs in one picture: at most %d", n_directory, CHART_SERIES);
    struct along *along = mem_new(1, sizeof *along);
    char *list = mem_text(words[1]);
    plot_case_names(directories, n_directory, along->runs);
    along->directories = directories;
    int code = plot_along_fields(along, list);
    while (!code && along->n_map < n_directory) {
        code = map_table_open(directories[along->n_map], words[0], &along->maps[along->n_map]);
        along->n_map++;
    }
    if (!code) code = plot_along_picture(along, directories, option);
    for (unsigned m = 0; m < along->n_map; m++) map_table_done(&along->maps[m]);
    for (unsigned m = 0; m < n_directory; m++) mem_free(along->runs[m]);
    for (unsigned f = 0; f < along->n_field; f++) mem_free(along->labels[f]);
    mem_free(list);
    mem_free(along);
    return code;
}
