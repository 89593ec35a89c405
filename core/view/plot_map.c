/* plot_map.c - see plot_map.h. The table is what a run writes as it goes, so that running and killed runs have
 * pictures too; a value fills the space half way to the places and times around it. */
#include "view/plot_map.h"

#include "base/mem.h"
#include "base/status.h"
#include "view/map_table.h"
#include "view/picture.h"
#include "view/picture_canvas.h"
#include "view/picture_text.h"
#include "view/plot_case.h"
#include "view/plot_picture.h"
#include "view/plot_time.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

struct map {
    struct map_table of;
    struct raster_cell *cells; /* [n], as the rows of the table */
    size_t n;                  /* n_time * n_place; of a rectangle n_place */
    double edge[2][2];         /* of all cells */
};

/* Edges of the cells around n ascending or descending values, `step` apart in the table: [n + 1]. */
static double *plot_map_edges(const double *values, size_t n, size_t step)
{
    double *edges = mem_new(n + 1, sizeof *edges);
    for (size_t i = 1; i < n; i++) edges[i] = 0.5 * (values[(i - 1) * step] + values[i * step]);
    edges[0] = values[0];
    edges[n] = values[(n - 1) * step];
    return edges;
}

/* Cells around n[0] times n[1] points, the second of which vary faster; at: where, `step` apart in the table; axis: of
 * the picture. */
static void plot_map_cells(struct map *map, const double *const at[2], const size_t n[2], const size_t step[2],
                           const int axis[2])
{
    double *edges[2];
    for (int k = 0; k < 2; k++) edges[k] = plot_map_edges(at[k], n[k], step[k]);
    map->n = n[0] * n[1];
    map->cells = mem_new(map->n, sizeof *map->cells);
    for (size_t i = 0; i < map->n; i++)
        for (int k = 0; k < 2; k++) {
            const double *edge = edges[k] + (k ? i % n[1] : i / n[1]);
            double *to = map->cells[i].at[axis[k]];
            to[0] = edge[0] < edge[1] ? edge[0] : edge[1];
            to[1] = edge[0] < edge[1] ? edge[1] : edge[0];
        }
    for (int k = 0; k < 2; k++) {
        double a = edges[k][0], b = edges[k][n[k]];
        map->edge[axis[k]][0] = a < b ? a : b;
        map->edge[axis[k]][1] = a < b ? b : a;
        mem_free(edges[k]);
    }
}

static int plot_map_open(const char *directory, const char *name, struct map *map)
{
    TRY(map_table_open(directory, name, &map->of));
    double *const *columns = map->of.table.columns;
    size_t n_place = map->of.n_place;
    if (map->of.n_side[0])
        plot_map_cells(map, (const double *[]){columns[1], columns[2]}, map->of.n_side,
                       (size_t[]){map->of.n_side[1], 1}, (int[]){0, 1});
    else
        plot_map_cells(map, (const double *[]){columns[0], columns[1]}, (size_t[]){map->of.n_time, n_place},
                       (size_t[]){n_place, 1}, (int[]){1, 0});
    return STATUS_OK;
}

static void plot_map_close(struct map *map)
{
    map_table_done(&map->of);
    mem_free(map->cells);
}

/* Least and largest finite value in the window; of positive ones for a logarithmic scale. */
static void plot_map_extremes(const struct map *map, const double *values, const double window[2][2], bool log,
                              double extremes[2])
{
    for (size_t i = 0; i < map->n; i++) {
        const struct raster_cell *cell = &map->cells[i];
        bool inside = true;
        for (int axis = 0; axis < 2; axis++)
            inside = inside && cell->at[axis][1] > window[axis][0] && cell->at[axis][0] < window[axis][1];
        if (!inside || !isfinite(values[i]) || (log && !(values[i] > 0.0))) continue;
        if (values[i] < extremes[0]) extremes[0] = values[i];
        if (values[i] > extremes[1]) extremes[1] = values[i];
    }
}

static int plot_map_window(const struct map *map, const struct plot_option *option, double ret_window[2][2])
{
    memcpy(ret_window, map->edge, sizeof map->edge);
    for (int axis = 0; axis < 2; axis++) {
        const struct plot_option_span *limit = &option->limit[axis];
        if (!limit->given) continue;
        if (limit->hi <= map->edge[axis][0] || limit->lo >= map->edge[axis][1])
            return status_fail(STATUS_CASE, "--%clim %g,%g: the map reaches from %g to %g", 'x' + axis, limit->lo,
                               limit->hi, map->edge[axis][0], map->edge[axis][1]);
        ret_window[axis][0] = limit->lo;
        ret_window[axis][1] = limit->hi;
    }
    return STATUS_OK;
}

/* Axes: the coordinate by its symbol, and t; of a rectangle both distances. */
static void plot_map_axes(const struct map *map, const double window[2][2], struct picture *drawn)
{
    for (int axis = 0; axis < 2 && map->of.n_side[0]; axis++)
        picture_scale_init(&drawn->axis[axis], &(struct picture_scale_inp){.name = map->of.table.names[1 + axis],
                                                                           .unit = "m",
                                                                           .lo = window[axis][0],
                                                                           .hi = window[axis][1]});
    if (map->of.n_side[0]) return;
    char *place = map_table_place(&map->of);
    const struct picture_scale_inp axes[] = {
        {.name = place, .unit = "m", .lo = window[0][0], .hi = window[0][1]},
        {.name = PICTURE_ITALIC "t" PICTURE_UPRIGHT, .unit = "s", .lo = window[1][0], .hi = window[1][1]},
    };
    for (int axis = 0; axis < 2; axis++) picture_scale_init(&drawn->axis[axis], &axes[axis]);
    mem_free(place);
}

static int plot_map_layer(const struct map *map, const char *field, const double *values,
                          const struct plot_option *option, const double window[2][2], struct picture_layer *layer)
{
    double extremes[2] = {INFINITY, -INFINITY};
    layer->cells = map->cells;
    layer->n = map->n;
    layer->values = values;
    plot_map_extremes(map, layer->values, window, option->log, extremes);
    const char *colours = option->map ? option->map : colormap_for_field(field, extremes[0], extremes[1]);
    TRY(colormap_find(colours, &layer->map));
    TRY(plot_picture_range(&option->range[0], option->log, field, colours, extremes));
    char *label = map_table_label(&map->of, field);
    picture_scale_init(&layer->scale, &(struct picture_scale_inp){.name = label,
                                                                  .unit = map_table_unit(&map->of, field),
                                                                  .lo = extremes[0],
                                                                  .hi = extremes[1],
                                                                  .log = option->log});
    mem_free(label);
    return STATUS_OK;
}

/* DIR/plots/map_NAME_FIELD.png, or what -o says; `many`: the other fields have files of their own. */
static char *plot_map_path(const struct map *map, const char *directory, const char *field, const char *output,
                           bool many)
{
    if (!output) return mem_print("%s/plots/map_%s_%s.png", directory, map->of.name, field);
    return many ? plot_option_file(output, field) : mem_text(output);
}

/* The values that are drawn: a column; of a rectangle its part at a time, with a note that says which. */
static int plot_map_values(const struct map *map, const char *field, const struct plot_option *option,
                           const double **ret_values, char **ret_note)
{
    static const double all[] = {-INFINITY, INFINITY};
    const double *times = map->of.table.columns[0];
    char moment[PICTURE_SCALE_LABEL];
    size_t row;
    TRY(map_table_column(&map->of, field, ret_values));
    if (option->n_time > 1 || (option->n_time && !map->of.n_side[0]))
        return status_fail(STATUS_CASE, map->of.n_side[0]
                                            ? "--time: one time for a picture of a rectangle"
                                            : "--time: a map shows all of its times; 'profile' shows one");
    if (!map->of.n_side[0]) {
        *ret_note = mem_text(map->of.name);
        return STATUS_OK;
    }
    row = map_table_highest(&map->of, *ret_values, all);
    if (option->n_time)
        TRY(plot_time_nearest(times, map->of.n_time, map->of.n_place, option->times[0], "the map's rows", &row));
    *ret_values += row * map->of.n_place;
    picture_scale_quantity(times[row * map->of.n_place], times[row * map->of.n_place], "s", moment);
    *ret_note = mem_print("%s, %s", map->of.name, moment);
    return STATUS_OK;
}

static int plot_map_draw(const struct map *map, const char *directory, const char *field,
                         const struct plot_option *option, bool many)
{
    char *title = plot_case_title(directory), *path = NULL, *note = NULL;
    struct picture drawn = {.title = title, .n_layer = 1, .aspect = map->of.n_side[0] ? 0.0 : 0.8};
    double window[2][2];
    const double *values;
    cairo_surface_t *image = NULL;
    int code = plot_map_window(map, option, window);
    if (!code) code = plot_map_values(map, field, option, &values, &note);
    drawn.note = note;
    if (!code) code = plot_map_layer(map, field, values, option, window, &drawn.layer[0]);
    if (!code) plot_map_axes(map, window, &drawn);
    if (!code) code = picture_draw(&drawn, option->width, &image);
    if (!code) {
        path = plot_map_path(map, directory, field, option->output, many);
        code = picture_canvas_write(image, path);
    }
    if (!code) printf("%s\n", path);
    if (image) cairo_surface_destroy(image);
    mem_free(path);
    mem_free(note);
    mem_free(title);
    return code;
}

int plot_map_write(const char *directory, const char *const *words, unsigned n, const struct plot_option *option)
{
    struct map map = {0};
    if (n < 1) return map_table_missing(directory, NULL);
    if (n != 2)
        return status_fail(STATUS_CASE, "a map and a field are needed: bulla plot %s map %s FIELD", directory,
                           words[0]);
    int code = plot_map_open(directory, words[0], &map);
    bool many = strchr(words[1], ',') != NULL;
    char *list = mem_text(words[1]);
    for (char *field = strtok(list, ","); !code && field; field = strtok(NULL, ","))
        code = plot_map_draw(&map, directory, field, option, many);
    mem_free(list);
    plot_map_close(&map);
    return code;
}
