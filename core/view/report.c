/* report.c - see report.h. Pictures are those of `bulla plot` with its defaults. */
#include "view/report.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "case/table.h"
#include "io/read.h"
#include "view/plot_case.h"
#include "view/plot_history.h"
#include "view/plot_picture.h"
#include "view/report_facts.h"
#include "view/report_html.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { REPORT_WIDTH = 900, REPORT_FRAMES = 4, REPORT_COLUMNS = 12 };

static const struct cli_option report_output = {"--output", "-o", "FILE.html", "Where to write (DIR/report.html)."};
const struct cli_option *const report_option_table[] = {&report_output, NULL};

static const struct plot_option report_plain = {.width = REPORT_WIDTH};
static const struct plot_option report_mirrored = {.width = REPORT_WIDTH, .mirror = true};

/* Axisymmetric planes show both halves. */
static const struct plot_option *report_option(const struct snapshot *snapshot)
{
    return snapshot->beta == 1 && snapshot->dim == 2 ? &report_mirrored : &report_plain;
}

static int report_picture(struct text *page, const struct snapshot *snapshot, const struct plot_picture *picture)
{
    cairo_surface_t *image;
    TRY(plot_picture_draw(snapshot, picture, &image));
    int code = report_html_figure(page, image, picture->fields[0]);
    cairo_surface_destroy(image);
    return code;
}

/* All fields of a snapshot: a plane each, or one chart of a line. */
static int report_fields(struct text *page, const struct snapshot *snapshot, double time_like)
{
    const struct plot_option *option = report_option(snapshot);
    struct plot_picture all = {.option = option, .time_like = time_like};
    bool plane = plot_picture_shape(snapshot, option) == 2;
    unsigned most = plane ? PLOT_PICTURE_FIELDS : 8;
    for (unsigned i = 0; i < snapshot->n_field && i < most; i++) {
        struct plot_picture one = {.option = option, .time_like = time_like, .n_field = 1};
        one.fields[0] = all.fields[all.n_field++] = snapshot->fields[i].name;
        if (plane) TRY(report_picture(page, snapshot, &one));
    }
    return plane || !all.n_field ? STATUS_OK : report_picture(page, snapshot, &all);
}

static int report_last(struct text *page, const struct snapshot_series *series)
{
    struct snapshot *snapshot;
    TRY(read_snapshot(series->paths[series->n - 1], NULL, &snapshot));
    text_add(page, "<h2>Last snapshot</h2>\n<div class=\"figures\">\n");
    int code = report_fields(page, snapshot, snapshot->time);
    text_add(page, "</div>\n");
    read_free(snapshot);
    return code;
}

/* The pressure, or else the first field, at a few times on one scale. */
static int report_frames(struct text *page, const struct snapshot_series *series)
{
    size_t frames = series->n < REPORT_FRAMES ? series->n : REPORT_FRAMES;
    struct snapshot *shown[REPORT_FRAMES] = {NULL};
    struct plot_picture picture = {.option = &report_plain,
                                   .n_field = 1,
                                   .common = true,
                                   .extremes = {{INFINITY, -INFINITY}}};
    picture.time_like = series->times[series->n - 1];
    int code = STATUS_OK;
    for (size_t i = 0; !code && i < frames; i++) {
        size_t index = frames > 1 ? i * (series->n - 1) / (frames - 1) : 0;
        code = read_snapshot(series->paths[index], NULL, &shown[i]);
        if (code || !shown[i]->n_field) break;
        picture.option = report_option(shown[i]);
        picture.fields[0] = read_field(shown[i], "pressure") ? "pressure" : shown[0]->fields[0].name;
        code = plot_picture_extremes(shown[i], &picture);
    }
    bool plane = !code && picture.fields[0] && plot_picture_shape(shown[0], &report_plain) == 2;
    if (plane) text_add(page, "<h2>Course of the %s</h2>\n<div class=\"figures\">\n", picture.fields[0]);
    for (size_t i = 0; !code && plane && i < frames; i++) code = report_picture(page, shown[i], &picture);
    if (plane) text_add(page, "</div>\n");
    for (size_t i = 0; i < frames; i++) read_free(shown[i]);
    return code;
}

static int report_snapshots(struct text *page, const char *directory)
{
    struct snapshot_series series;
    if (read_series(directory, &series)) return STATUS_OK; /* a run need not have snapshots */
    int code = STATUS_OK;
    if (series.n) code = report_last(page, &series);
    if (!code && series.n > 2) code = report_frames(page, &series);
    read_series_done(&series);
    return code;
}

static int report_columns(struct text *page, const char *directory, const char *title, const char *const *columns,
                          unsigned n)
{
    cairo_surface_t *image;
    TRY(plot_history_draw(directory, columns, n, &report_plain, &image));
    text_add(page, "<h2>%s</h2>\n<div class=\"figures\">\n", title);
    int code = report_html_figure(page, image, title);
    text_add(page, "</div>\n");
    cairo_surface_destroy(image);
    return code;
}

/* A chart of the columns of history.csv or probes.csv but t, step, dt and the counts of the guard. */
static int report_table(struct text *page, const char *directory, const char *name, const char *title)
{
    struct table table = {0};
    const char *columns[REPORT_COLUMNS];
    unsigned n = 0;
    char *path = mem_print("%s/%s", directory, name);
    int code = access(path, F_OK) == 0 ? table_read(path, TABLE_OF_RUN, &table) : STATUS_OK;
    for (unsigned c = 0; c < table.n_column && n < REPORT_COLUMNS; c++) {
        const char *column = table.names[c];
        if (strcmp(column, "t") && strcmp(column, "step") && strcmp(column, "dt") && strncmp(column, "guard_", 6))
            columns[n++] = column;
    }
    if (!code && n && table.n_row) code = report_columns(page, directory, title, columns, n);
    table_done(&table);
    mem_free(path);
    return code;
}

static int report_save(const struct text *page, const char *path)
{
    FILE *file = fopen(path, "w");
    if (!file) return status_fail(STATUS_RUN, "cannot write %s", path);
    bool whole = fwrite(page->at, 1, page->length, file) == page->length;
    if (fclose(file) != 0 || !whole) return status_fail(STATUS_RUN, "cannot write all of %s", path);
    printf("%s\n", path);
    return STATUS_OK;
}

static int report_compose(struct text *page, const char *directory)
{
    char *title = plot_case_title(directory);
    report_html_begin(page, title);
    mem_free(title);
    report_facts_head(page, directory);
    report_facts_run(page, directory);
    report_facts_expect(page, directory);
    TRY(report_table(page, directory, "history.csv", "History"));
    TRY(report_table(page, directory, "probes.csv", "Probes"));
    TRY(report_snapshots(page, directory));
    report_facts_case(page, directory);
    report_html_end(page);
    return STATUS_OK;
}

static int report_run(const char *directory, const char *output)
{
    struct stat entry;
    if (stat(directory, &entry) != 0 || !S_ISDIR(entry.st_mode))
        return status_fail(STATUS_CASE, "no directory %s: report wants the output directory of a run", directory);
    char *known = mem_print("%s/provenance.json", directory);
    bool run = access(known, F_OK) == 0;
    mem_free(known);
    if (!run)
        return status_fail(STATUS_CASE, "%s is no output directory of a run: it has no provenance.json", directory);
    struct text page = {0};
    char *path = output ? mem_text(output) : mem_print("%s/report.html", directory);
    int code = report_compose(&page, directory);
    if (!code) code = report_save(&page, path);
    text_done(&page);
    mem_free(path);
    return code;
}

int report_command(const struct cli_given *given)
{
    if (comm_rank() != 0) return STATUS_OK;
    char *directory = plot_case_directory(given->words[0]);
    int code = report_run(directory, cli_value(given, "--output"));
    mem_free(directory);
    return cli_failed(code);
}
