/* plot.c - see plot.h. Chooses snapshots and names of files; what they show is plot_picture's. */
#include "view/plot.h"

#include "base/comm.h"
#include "base/log.h"
#include "base/mem.h"
#include "base/status.h"
#include "io/read.h"
#include "view/picture_canvas.h"
#include "view/plot_along.h"
#include "view/plot_beside.h"
#include "view/plot_case.h"
#include "view/plot_cost.h"
#include "view/plot_history.h"
#include "view/plot_interface.h"
#include "view/plot_map.h"
#include "view/plot_draw.h"
#include "view/plot_time.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static bool plot_is_directory(const char *path)
{
    struct stat entry;
    return stat(path, &entry) == 0 && S_ISDIR(entry.st_mode);
}

static int plot_no_directory(const char *directory)
{
    return status_fail(STATUS_CASE, "no directory %s: plot wants the output directory of a run", directory);
}

/* The step in the name of a snapshot, "<case>_<step>.hdf"; -1 if it has none. */
static long plot_step_of(const char *path)
{
    const char *last = strrchr(path, '_');
    return last ? strtol(last + 1, NULL, 10) : -1;
}

static int plot_find_step(const struct snapshot_series *series, long step, size_t *ret_index)
{
    size_t near = 0;
    for (size_t i = 1; i < series->n; i++)
        if (labs(plot_step_of(series->paths[i]) - step) < labs(plot_step_of(series->paths[near]) - step)) near = i;
    *ret_index = near;
    if (plot_step_of(series->paths[near]) == step) return STATUS_OK;
    return status_fail(STATUS_CASE, "no snapshot of step %ld; the nearest is --step %ld (t = %.6g s); there are %zu",
                       step, plot_step_of(series->paths[near]), series->times[near], series->n);
}

/* Snapshots [*ret_first, *ret_end) of the series. */
static int plot_choose(const struct snapshot_series *series, const struct plot_option *option, size_t *ret_first,
                       size_t *ret_end)
{
    size_t index = series->n - 1;
    if (option->when == PLOT_STEP) TRY(plot_find_step(series, option->step, &index));
    if (option->when == PLOT_TIME)
        TRY(plot_time_nearest(series->times, series->n, 1, option->times[0], "the snapshots", &index));
    *ret_first = option->when == PLOT_ALL ? 0 : index;
    *ret_end = index + 1;
    return STATUS_OK;
}

/* DIR/plots/<case>_<step>_<fields>.png, or what -o says; `many`: the other fields have files of their own. */
static char *plot_path(const char *directory, const struct snapshot *snapshot, const struct plot_picture *picture,
                       bool many)
{
    const char *output = picture->option->output;
    if (output && !plot_is_directory(output))
        return many ? plot_option_file(output, picture->fields[0]) : mem_text(output);
    char *path = output ? mem_print("%s/%s_%06ld", output, snapshot->name, snapshot->step)
                        : mem_print("%s/plots/%s_%06ld", directory, snapshot->name, snapshot->step);
    for (unsigned i = 0; i < picture->n_field; i++) {
        char *longer = mem_print("%s%c%s", path, i ? '+' : '_', picture->fields[i]);
        mem_free(path);
        path = longer;
    }
    char *complete = mem_print("%s%s.png", path, picture->option->n_iso ? "_iso" : "");
    mem_free(path);
    return complete;
}

static int plot_write(const char *directory, const struct snapshot *snapshot, const struct plot_picture *picture,
                      bool many)
{
    cairo_surface_t *image;
    TRY(plot_draw(snapshot, picture, &image));
    char *path = plot_path(directory, snapshot, picture, many);
    int code = picture_canvas_write(image, path);
    if (!code) printf("%s\n", path);
    cairo_surface_destroy(image);
    mem_free(path);
    return code;
}

/* A plane shows one field (or a pair), perhaps another one inside of a material: one file for each of the list. A line
 * shows all in one file. */
static int plot_fields(const char *directory, const struct snapshot *snapshot, const struct plot_picture *picture)
{
    if (picture->option->left || !picture->n_field || plot_picture_shape(snapshot, picture->option) != 2)
        return plot_write(directory, snapshot, picture, false);
    unsigned inside = picture->option->inside_field ? 1 : 0, last = picture->n_field - 1;
    for (unsigned i = 0; i + inside < picture->n_field; i++) {
        struct plot_picture one = *picture;
        one.n_field = 1 + inside;
        one.fields[0] = picture->fields[i];
        one.fields[inside] = picture->fields[inside ? last : i];
        memcpy(one.extremes[0], picture->extremes[i], sizeof one.extremes[0]);
        memcpy(one.extremes[inside], picture->extremes[inside ? last : i], sizeof one.extremes[0]);
        TRY(plot_write(directory, snapshot, &one, picture->n_field > 1 + inside));
    }
    return STATUS_OK;
}

/* Says once what pictures do not show. */
static void plot_warn(const struct snapshot *snapshot, const struct plot_option *option)
{
    char *lacking = option->contours ? NULL : plot_interface_lacking(snapshot);
    if (lacking)
        fprintf(stderr,
                "note: interfaces of materials whose fraction is not in the snapshots are not drawn: %s; list them in "
                "output: snapshots: fields: (one may be left out)\n",
                lacking);
    mem_free(lacking);
}

static int plot_series(const char *directory, const struct snapshot_series *series, struct plot_picture *picture)
{
    size_t first, end;
    TRY(plot_choose(series, picture->option, &first, &end));
    if (end - first > 1 && picture->option->output && !plot_is_directory(picture->option->output))
        return status_fail(STATUS_CASE, "-o %s: --all writes many files; name a directory that is there",
                           picture->option->output);
    picture->time_like = series->times[series->n - 1];
    if (end - first > 1) TRY(plot_beside_gather(series->paths, series->n, picture));
    for (size_t i = first; i < end; i++) {
        struct snapshot *snapshot;
        TRY(read_snapshot(series->paths[i], NULL, &snapshot));
        if (i == first) plot_warn(snapshot, picture->option);
        int code = plot_fields(directory, snapshot, picture);
        read_free(snapshot);
        if (code) return code;
    }
    return STATUS_OK;
}

/* Splits "pressure,density" in place. */
static int plot_split(char *list, struct plot_picture *picture)
{
    for (char *name = strtok(list, ","); name; name = strtok(NULL, ",")) {
        if (picture->n_field == PLOT_PICTURE_FIELDS)
            return status_fail(STATUS_CASE, "too many fields: at most %d", PLOT_PICTURE_FIELDS);
        picture->fields[picture->n_field++] = name;
    }
    return STATUS_OK;
}

static int plot_one(const char *directory, struct plot_picture *picture)
{
    struct snapshot_series series;
    if (read_series(directory, &series)) return status_fail(STATUS_CASE, "%s", status_text());
    int code = series.n ? plot_series(directory, &series, picture)
                        : status_fail(STATUS_CASE, "no snapshots in %s/fields", directory);
    read_series_done(&series);
    return code;
}

/* Of one run, or of several beside each other. */
static int plot_snapshots(const char *const *directories, unsigned n, const char *fields,
                          const struct plot_option *option)
{
    struct plot_picture picture = {.option = option};
    char *list = option->left ? mem_print("%s,%s", option->left, option->right) : mem_text(fields ? fields : "");
    int code = plot_split(list, &picture);
    if (!code && option->inside_field) {
        if (picture.n_field == PLOT_PICTURE_FIELDS) picture.n_field--;
        picture.fields[picture.n_field++] = option->inside_field;
    }
    if (!code)
        code = n > 1 || option->movie ? plot_beside_write(directories, n, &picture) : plot_one(*directories, &picture);
    mem_free(list);
    return code;
}

/* Fields of runs beside each other; words: the field, none with --left. */
static int plot_panels(const char *const *directories, unsigned n_directory, const char *const *words, unsigned n,
                       const struct plot_option *option)
{
    for (unsigned i = 0; i < n_directory; i++)
        if (!plot_is_directory(directories[i])) return plot_no_directory(directories[i]);
    if (n_directory < 2)
        return status_fail(STATUS_CASE, "--beside is for several runs: bulla plot DIR1 DIR2 FIELD --beside");
    return plot_snapshots(directories, n_directory, n ? words[0] : NULL, option);
}

/* Pictures that several runs share: what draws them, by the word that asks for it. */
static const struct plot_shared {
    const char *word; /* NULL: an option asks for it */
    int (*write)(const char *const *directories, unsigned n_directory, const char *const *words, unsigned n,
                 const struct plot_option *option);
} plot_shared[] = {{"history", plot_history_write}, {"profile", plot_along_write}, {0}},
  plot_shared_panels = {NULL, plot_panels};

/* Which of them is asked for, and by how many runs: the directories that stand before the word; NULL: none. */
static const struct plot_shared *plot_find_shared(const struct cli_given *given, const struct plot_option *option,
                                                  unsigned *ret_runs)
{
    if (option->beside && given->n_word > 0) {
        bool none = option->left || (option->n_iso && plot_is_directory(given->words[given->n_word - 1]));
        *ret_runs = (unsigned)given->n_word - (none ? 0 : 1);
        return &plot_shared_panels;
    }
    for (int i = 1; i < given->n_word; i++) {
        *ret_runs = (unsigned)i;
        for (const struct plot_shared *shared = plot_shared; shared->word; shared++)
            if (strcmp(given->words[i], shared->word) == 0) return shared;
        if (!plot_is_directory(given->words[i])) break;
    }
    return NULL;
}

static int plot_together(const struct cli_given *given, const struct plot_shared *shared, unsigned n_run,
                         const struct plot_option *option)
{
    char **directories = mem_new(n_run, sizeof *directories);
    int code = STATUS_OK;
    for (unsigned i = 0; i < n_run; i++) directories[i] = plot_case_directory(given->words[i]);
    if (!plot_is_directory(directories[0])) code = plot_no_directory(directories[0]);
    unsigned before = n_run + (shared->word ? 1 : 0);
    if (!code)
        code = shared->write((const char *const *)directories, n_run, given->words + before,
                             (unsigned)given->n_word - before, option);
    for (unsigned i = 0; i < n_run; i++) mem_free(directories[i]);
    mem_free(directories);
    return code;
}

static int plot_run(const struct cli_given *given, const char *directory)
{
    struct plot_option option;
    TRY(plot_option_read(given, &option));
    const char *what = given->n_word > 1 ? given->words[1] : NULL;
    unsigned n_run = 0;
    const struct plot_shared *shared = plot_find_shared(given, &option, &n_run);
    if (!what && !option.left && !option.n_iso)
        return status_fail(
            STATUS_CASE, "which field? bulla plot %s pressure, or history, map, profile; `bulla info` lists the fields",
            directory);
    bool map = !option.beside && what && strcmp(what, "map") == 0;
    if (!shared && !map && given->n_word > 2 && plot_is_directory(what))
        return status_fail(
            STATUS_CASE,
            "several runs share pictures of histories and profiles (bulla plot %s %s history COLUMN...), and "
            "those of fields with --beside",
            directory, what);
    if (!shared && !map && given->n_word > 2)
        return status_fail(STATUS_CASE, "plot does not know what to do with '%s'; several fields go by comma: %s,%s",
                           given->words[2], what, given->words[2]);
    if (option.left && what && !option.beside)
        return status_fail(STATUS_CASE, "--left and --right name the fields; '%s' is one too many", what);
    if (option.n_over && !(shared && shared->write == plot_history_write))
        return status_fail(STATUS_CASE,
                           "--over %s: references go over histories: bulla plot %s history COLUMN --over %s",
                           option.over[0], directory, option.over[0]);
    if (option.movie && (map || (shared && !option.beside)))
        return status_fail(STATUS_CASE, "--movie %s: films are of snapshots: bulla plot %s FIELD --movie %s",
                           option.movie, directory, option.movie);
    if (shared) return plot_together(given, shared, n_run, &option);
    if (what && strcmp(what, "cost") == 0 && !plot_is_directory(directory))
        return plot_cost_write(given->words[0], &option);
    if (!plot_is_directory(directory)) return plot_no_directory(directory);
    if (!map && option.n_time > 1)
        return status_fail(STATUS_CASE, "--time %g and %g: one time for a picture of a snapshot", option.times[0],
                           option.times[1]);
    if (map) return plot_map_write(directory, given->words + 2, (unsigned)(given->n_word - 2), &option);
    return plot_snapshots(&directory, 1, what, &option);
}

int plot_command(const struct cli_given *given)
{
    if (comm_rank() != 0) return STATUS_OK;
    log_set_quiet(true); /* the case is opened for its units only: what its laws say of their tables is no news */
    char *directory = plot_case_directory(given->words[0]);
    int code = plot_run(given, directory);
    mem_free(directory);
    return cli_failed(code);
}
