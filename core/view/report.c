/* report.c - see report.h. Pictures are those of `bulla plot` with its defaults. */
#include "view/report.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "io/read.h"
#include "view/picture_scale.h"
#include "view/plot_case.h"
#include "view/plot_interface.h"
#include "view/plot_draw.h"
#include "view/report_columns.h"
#include "view/report_course.h"
#include "view/report_facts.h"
#include "view/report_html.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { REPORT_WIDTH = 900 };

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
    char time[PICTURE_SCALE_LABEL], unit[PICTURE_SCALE_TEXT], caption[256];
    const struct snapshot_field *field = read_field(snapshot, picture->fields[0]);
    picture_scale_quantity(snapshot->time, snapshot->time, "s", time);
    TRY(plot_draw(snapshot, picture, &image));
    if (picture->n_field == 1)
        snprintf(caption, sizeof caption, "%s [%s] at t = %.48s", field->name, report_html_unit(field->unit, unit),
                 time);
    else snprintf(caption, sizeof caption, "%u of %u fields at t = %.48s", picture->n_field, snapshot->n_field, time);
    int code = report_html_figure(page, image, caption, caption);
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

/* What the pictures do not show. */
static void report_lacking(struct text *page, const struct snapshot *snapshot)
{
    char *lacking = plot_interface_lacking(snapshot);
    if (lacking) {
        text_add(page,
                 "<p class=\"note\">Interfaces of materials whose fraction is not in the snapshots are not drawn: ");
        report_html_text(page, lacking);
        text_add(page, ".</p>\n");
    }
    mem_free(lacking);
}

static int report_last(struct text *page, const struct snapshot_series *series)
{
    struct snapshot *snapshot;
    TRY(read_snapshot(series->paths[series->n - 1], NULL, &snapshot));
    text_add(page, "<h2>Last snapshot</h2>\n");
    report_lacking(page, snapshot);
    text_add(page, "<div class=\"figures\">\n");
    int code = report_fields(page, snapshot, snapshot->time);
    text_add(page, "</div>\n");
    read_free(snapshot);
    return code;
}

static int report_snapshots(struct text *page, const char *directory)
{
    struct snapshot_series series;
    if (read_series(directory, &series)) return STATUS_OK; /* a run need not have snapshots */
    int code = STATUS_OK;
    if (series.n) code = report_last(page, &series);
    if (!code) code = report_course_add(page, &series, &report_plain, &report_mirrored);
    read_series_done(&series);
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
    TRY(report_columns_add(page, directory, "history.csv", "History", &report_plain));
    TRY(report_columns_add(page, directory, "probes.csv", "Probes", &report_plain));
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
