/* plot_beside.c - see plot_beside.h. */
#include "view/plot_beside.h"

#include "base/mem.h"
#include "base/status.h"
#include "view/picture_canvas.h"
#include "view/plot_case.h"
#include "view/plot_draw.h"
#include "view/plot_film.h"
#include "view/plot_time.h"

#include <math.h>
#include <stdio.h>

enum {
    BESIDE_ONE = 1080,
    BESIDE_ALL = 1920,
    BESIDE_PANEL = 900
}; /* pixels: a film of one run; of several; a panel at most */

struct beside {
    unsigned n; /* runs */
    const char *const *directories;
    char *names[PLOT_BESIDE_RUNS]; /* what panels are called; NULL: as their case */
    struct snapshot_series series[PLOT_BESIDE_RUNS];
    struct plot_option option; /* of a panel */
    struct plot_picture picture;
};

/* Are the ends of all scales given? */
static bool plot_beside_is_ranged(const struct plot_picture *picture)
{
    for (unsigned i = 0; i < picture->n_field; i++)
        if (i >= PLOT_RANGES || !picture->option->range[i].given) return false;
    return true;
}

int plot_beside_gather(char *const *paths, size_t n, struct plot_picture *picture)
{
    if (plot_beside_is_ranged(picture)) return STATUS_OK;
    for (unsigned i = 0; i < picture->n_field && !picture->common; i++) {
        picture->extremes[i][0] = INFINITY;
        picture->extremes[i][1] = -INFINITY;
    }
    picture->common = true;
    for (size_t i = 0; i < n; i++) {
        struct snapshot *snapshot;
        TRY(read_snapshot(paths[i], NULL, &snapshot));
        int code = plot_draw_extremes(snapshot, picture);
        read_free(snapshot);
        if (code) return status_wrap(code, "%s: ", paths[i]);
    }
    return STATUS_OK;
}

static size_t plot_beside_nearest(const struct snapshot_series *series, double t)
{
    size_t near = 0;
    for (size_t i = 1; i < series->n; i++)
        if (fabs(series->times[i] - t) < fabs(series->times[near] - t)) near = i;
    return near;
}

/* The run whose times are the frames. */
static const struct snapshot_series *plot_beside_clock(const struct beside *beside)
{
    const struct snapshot_series *clock = &beside->series[0];
    for (unsigned i = 1; i < beside->n; i++)
        if (beside->series[i].times[beside->series[i].n - 1] > clock->times[clock->n - 1]) clock = &beside->series[i];
    return clock;
}

/* The snapshots of a still picture: that of --time, or the last of each run. */
static int plot_beside_still(const struct beside *beside, char **ret_paths)
{
    for (unsigned i = 0; i < beside->n; i++) {
        const struct snapshot_series *series = &beside->series[i];
        size_t index = series->n - 1;
        if (beside->option.when == PLOT_TIME &&
            plot_time_nearest(series->times, series->n, 1, beside->option.times[0], "the snapshots", &index))
            return status_wrap(STATUS_CASE, "%s: ", beside->directories[i]);
        ret_paths[i] = series->paths[index];
    }
    return STATUS_OK;
}

static int plot_beside_panel(const struct beside *beside, unsigned run, const char *path, cairo_surface_t **ret_image)
{
    struct snapshot *snapshot;
    TRY(read_snapshot(path, NULL, &snapshot));
    if (beside->names[run]) {
        mem_free(snapshot->title);
        snapshot->title = mem_text(beside->names[run]);
    }
    int code = plot_draw(snapshot, &beside->picture, ret_image);
    read_free(snapshot);
    return code;
}

/* Panels from left to right, their upper edges in line, on white; takes them. */
static int plot_beside_join(cairo_surface_t *const *panels, unsigned n, cairo_surface_t **ret_image)
{
    int width = 0, height = 0, x = 0;
    for (unsigned i = 0; i < n; i++) {
        int tall = cairo_image_surface_get_height(panels[i]);
        width += cairo_image_surface_get_width(panels[i]);
        height = tall > height ? tall : height;
    }
    cairo_surface_t *image = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
    cairo_t *cr = cairo_create(image);
    cairo_set_source_rgb(cr, 1.0, 1.0, 1.0);
    cairo_paint(cr);
    for (unsigned i = 0; i < n; i++) {
        cairo_set_source_surface(cr, panels[i], x, 0.0);
        cairo_paint(cr);
        x += cairo_image_surface_get_width(panels[i]);
    }
    cairo_status_t status = cairo_status(cr);
    cairo_destroy(cr);
    *ret_image = image;
    if (status == CAIRO_STATUS_SUCCESS) return STATUS_OK;
    cairo_surface_destroy(image);
    return status_fail(STATUS_RUN, "cannot draw %u panels: %s", n, cairo_status_to_string(status));
}

static int plot_beside_draw(const struct beside *beside, char *const *paths, cairo_surface_t **ret_image)
{
    cairo_surface_t *panels[PLOT_BESIDE_RUNS];
    unsigned n = 0;
    int code = STATUS_OK;
    for (; n < beside->n && !code; n++) code = plot_beside_panel(beside, n, paths[n], &panels[n]);
    unsigned drawn = code ? n - 1 : n;
    if (!code) code = plot_beside_join(panels, n, ret_image);
    for (unsigned i = 0; i < drawn; i++) cairo_surface_destroy(panels[i]);
    return code;
}

/* DIR1/plots/beside_FIELD.png, or what -o says. */
static int plot_beside_picture(struct beside *beside)
{
    char *paths[PLOT_BESIDE_RUNS];
    cairo_surface_t *image;
    const char *output = beside->option.output;
    TRY(plot_beside_still(beside, paths));
    TRY(plot_beside_gather(paths, beside->n, &beside->picture));
    TRY(plot_beside_draw(beside, paths, &image));
    char *path = output ? mem_text(output)
                        : mem_print("%s/plots/beside_%s.png", beside->directories[0],
                                    beside->picture.n_field ? beside->picture.fields[0] : "iso");
    int code = picture_canvas_write(image, path);
    if (!code) printf("%s\n", path);
    cairo_surface_destroy(image);
    mem_free(path);
    return code;
}

static int plot_beside_frames(const struct beside *beside, struct plot_film *film)
{
    const struct snapshot_series *clock = plot_beside_clock(beside);
    for (size_t frame = 0; frame < clock->n; frame++) {
        char *paths[PLOT_BESIDE_RUNS];
        cairo_surface_t *image;
        for (unsigned i = 0; i < beside->n; i++)
            paths[i] = beside->series[i].paths[plot_beside_nearest(&beside->series[i], clock->times[frame])];
        TRY(plot_beside_draw(beside, paths, &image));
        int code = plot_film_add(film, image);
        cairo_surface_destroy(image);
        if (code) return code;
    }
    return STATUS_OK;
}

/* One scale for all frames of all runs. */
static int plot_beside_film(struct beside *beside)
{
    struct plot_film film;
    TRY(plot_film_begin(beside->option.movie, plot_beside_clock(beside)->n, &film));
    int code = STATUS_OK;
    for (unsigned i = 0; i < beside->n && !code; i++)
        code = plot_beside_gather(beside->series[i].paths, beside->series[i].n, &beside->picture);
    if (!code) code = plot_beside_frames(beside, &film);
    return plot_film_end(&film, beside->option.pace, code);
}

static int plot_beside_open(struct beside *beside)
{
    for (unsigned i = 0; i < beside->n; i++) {
        struct snapshot_series *series = &beside->series[i];
        if (read_series(beside->directories[i], series)) return status_fail(STATUS_CASE, "%s", status_text());
        if (!series->n) return status_fail(STATUS_CASE, "no snapshots in %s/fields", beside->directories[i]);
        beside->picture.time_like = fmax(beside->picture.time_like, series->times[series->n - 1]);
    }
    if (beside->n > 1) plot_case_names(beside->directories, beside->n, beside->names);
    return STATUS_OK;
}

/* A plane holds one field; a width is that of all panels together. */
static int plot_beside_check(struct beside *beside)
{
    struct snapshot *snapshot;
    TRY(read_snapshot(beside->series[0].paths[0], NULL, &snapshot));
    int shape = plot_picture_shape(snapshot, &beside->option);
    unsigned most = beside->option.left ? 2 : 1;
    read_free(snapshot);
    if (beside->option.inside_field) most++;
    if (shape == 2 && beside->picture.n_field > most)
        return status_fail(STATUS_CASE, "--beside and --movie show one field of a plane: %s, or %s",
                           beside->picture.fields[0], beside->picture.fields[1]);
    int total = beside->option.width;
    if (!total && beside->option.movie) total = beside->n > 1 ? BESIDE_ALL : BESIDE_ONE;
    int panel = total / (int)beside->n;
    beside->option.width = total ? (panel < 100 ? 100 : panel) : BESIDE_PANEL;
    return STATUS_OK;
}

int plot_beside_write(const char *const *directories, unsigned n, const struct plot_picture *picture)
{
    if (n > PLOT_BESIDE_RUNS)
        return status_fail(STATUS_CASE, "--beside: at most %d runs fit beside each other", PLOT_BESIDE_RUNS);
    struct beside beside = {.n = n, .directories = directories, .picture = *picture, .option = *picture->option};
    beside.picture.option = &beside.option;
    int code = plot_beside_open(&beside);
    if (!code) code = plot_beside_check(&beside);
    if (!code) code = (beside.option.movie ? plot_beside_film : plot_beside_picture)(&beside);
    for (unsigned i = 0; i < n; i++) {
        mem_free(beside.names[i]);
        read_series_done(&beside.series[i]);
    }
    return code;
}
