/* plot_history.c - see plot_history.h. Columns of one unit that follow each other share a panel; of several runs every
 * column has its own. */
#include "view/plot_history.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "case/table.h"
#include "view/chart.h"
#include "view/picture_canvas.h"
#include "view/picture_text.h"
#include "view/plot_case.h"
#include "view/plot_over.h"
#include "view/plot_profile.h"
#include "view/plot_unit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { HISTORY_TABLES = 2, HISTORY_LABEL = 128 };

struct history {
    struct table tables[HISTORY_TABLES]; /* history.csv, probes.csv */
    char *title;
    char *name; /* in a legend, or NULL */
    char labels[CHART_PANELS * CHART_SERIES][HISTORY_LABEL];
    unsigned n_label;
    struct scene *scene; /* or NULL */
};

/* What is drawn: the panels with their units, and which panel each column is in. */
struct history_sheet {
    struct chart chart;
    const char *units[CHART_PANELS];
    unsigned n_column;
    const char *columns[CHART_PANELS * CHART_SERIES];
    unsigned panel[CHART_PANELS * CHART_SERIES];
    struct plot_over over[PLOT_OVERS];
};

static int plot_history_read(const char *directory, const char *name, struct table *table)
{
    char *path = mem_print("%s/%s", directory, name);
    int code = STATUS_OK;
    if (access(path, F_OK) == 0) code = table_read(path, TABLE_OF_RUN, table);
    mem_free(path);
    return code;
}

static int plot_history_open(const char *directory, struct history *history)
{
    *history = (struct history){0};
    TRY(plot_history_read(directory, "history.csv", &history->tables[0]));
    TRY(plot_history_read(directory, "probes.csv", &history->tables[1]));
    if (!history->tables[0].n_column && !history->tables[1].n_column)
        return status_fail(STATUS_CASE, "no history.csv and no probes.csv in %s", directory);
    history->title = plot_case_title(directory);
    history->scene = plot_unit_scene(directory);
    return STATUS_OK;
}

static void plot_history_done(struct history *history)
{
    for (int i = 0; i < HISTORY_TABLES; i++) table_done(&history->tables[i]);
    mem_free(history->title);
    mem_free(history->name);
    scene_free(history->scene);
}

/* `directory`: which of several runs, or NULL. */
static int plot_history_unknown(const struct history *history, const char *directory, const char *column)
{
    struct text list = {0};
    unsigned count = history->tables[0].n_column + history->tables[1].n_column, n = 0;
    const char **names = mem_new(count + 1, sizeof *names);
    for (int i = 0; i < HISTORY_TABLES; i++)
        for (unsigned c = 0; c < history->tables[i].n_column; c++) {
            if (strcmp(history->tables[i].names[c], "t") == 0) continue;
            names[n] = history->tables[i].names[c];
            text_add(&list, "%s%s", n ? ", " : "", names[n]);
            n++;
        }
    const char *near = text_nearest(column, names);
    int code = status_fail(STATUS_CASE, "%s%sno column '%s'%s%s%s; there are: %s", directory ? directory : "",
                           directory ? ": " : "", column, near ? " (did you mean '" : "", near ? near : "",
                           near ? "'?)" : "", list.at ? list.at : "none");
    mem_free(names);
    text_done(&list);
    return code;
}

/* "wall.pressure" is the pressure at wall; columns of the case keep their names. */
static const char *plot_history_label(struct history *history, const char *column)
{
    char *label = history->labels[history->n_label++ % (CHART_PANELS * CHART_SERIES)];
    const char *dot = strchr(column, '.');
    if (!dot) return column;
    snprintf(label, HISTORY_LABEL, "%s at %.*s", dot + 1, (int)(dot - column), column);
    for (char *c = label; *c && *c != ' '; c++)
        if (*c == '_') *c = ' ';
    return label;
}

/* The table that has the column and the times of its rows, or NULL. */
static const struct table *plot_history_table(const struct history *history, const char *column)
{
    for (int i = 0; i < HISTORY_TABLES; i++) {
        const struct table *table = &history->tables[i];
        if (table_column(table, column) && table_column(table, "t")) return table;
    }
    return NULL;
}

/* The column is in the last panel. */
static void plot_history_note(struct history_sheet *sheet, const char *column)
{
    sheet->columns[sheet->n_column] = column;
    sheet->panel[sheet->n_column++] = sheet->chart.n_panel - 1;
}

static int plot_history_add(struct history *history, const char *column, struct history_sheet *sheet)
{
    const struct table *table = plot_history_table(history, column);
    if (!table) return plot_history_unknown(history, NULL, column);
    struct chart_series series = {.name = plot_history_label(history, column),
                                  .n = table->n_row,
                                  .x = table_column(table, "t"),
                                  .y = table_column(table, column)};
    TRY(plot_profile_add(&sheet->chart, sheet->units, series, plot_unit_of(history->scene, column)));
    plot_history_note(sheet, column);
    return STATUS_OK;
}

/* Worth a panel without being asked for: what the case measures, and what the guard did if it did anything. */
static bool plot_history_is_telling(const struct table *table, unsigned c)
{
    const char *name = table->names[c];
    if (strcmp(name, "t") == 0 || strcmp(name, "step") == 0 || strcmp(name, "dt") == 0) return false;
    if (strncmp(name, "guard_", 6) != 0) return true;
    return table->n_row && table->columns[c][table->n_row - 1] > 0.0;
}

static int plot_history_fill(struct history *history, const char *const *columns, unsigned n,
                             struct history_sheet *sheet)
{
    for (unsigned i = 0; i < n; i++) TRY(plot_history_add(history, columns[i], sheet));
    const struct table *table = &history->tables[0];
    for (unsigned c = 0; n == 0 && c < table->n_column && sheet->chart.n_panel < CHART_PANELS; c++)
        if (plot_history_is_telling(table, c)) TRY(plot_history_add(history, table->names[c], sheet));
    if (!sheet->chart.n_panel)
        return status_fail(STATUS_CASE,
                           "history.csv has no columns of its own; name one: dt, or a column of probes.csv");
    return STATUS_OK;
}

/* A reference in the panels that show what it has. */
static int plot_history_refer(struct history_sheet *sheet, struct plot_over *over)
{
    for (unsigned c = 0; c < sheet->n_column; c++)
        TRY(plot_over_add(over, sheet->columns[c], false, &sheet->chart.panel[sheet->panel[c]]));
    if (!over->used && over->column) return plot_over_add(over, sheet->columns[0], true, &sheet->chart.panel[0]);
    return over->used ? STATUS_OK : plot_over_unused(over);
}

static int plot_history_refer_all(struct history_sheet *sheet, const struct plot_option *option)
{
    for (unsigned i = 0; i < option->n_over; i++) {
        TRY(plot_over_read(option->over[i], &sheet->over[i]));
        TRY(plot_history_refer(sheet, &sheet->over[i]));
    }
    return STATUS_OK;
}

/* The times of the runs, however far a reference goes. */
static void plot_history_window(const struct chart *chart, const struct plot_option *option, double ret_window[2])
{
    ret_window[0] = INFINITY;
    ret_window[1] = -INFINITY;
    for (unsigned p = 0; p < chart->n_panel; p++)
        for (unsigned i = 0; i < chart->panel[p].n_series; i++) {
            const struct chart_series *series = &chart->panel[p].series[i];
            struct chart_series times = {.n = series->n, .x = series->x, .y = series->x};
            chart_range(&times, (const double[2]){-INFINITY, INFINITY}, &ret_window[0], &ret_window[1]);
        }
    if (option->limit[0].given) {
        ret_window[0] = option->limit[0].lo;
        ret_window[1] = option->limit[0].hi;
    }
}

/* Scales and draws what was filled in. */
static int plot_history_finish(struct history_sheet *sheet, const struct plot_option *option,
                               cairo_surface_t **ret_image)
{
    double window[2];
    struct chart *chart = &sheet->chart;
    plot_history_window(chart, option, window);
    if (window[0] > window[1]) return status_fail(STATUS_CASE, "the history has no rows yet");
    picture_scale_init(&chart->x, &(struct picture_scale_inp){.name = PICTURE_ITALIC "t" PICTURE_UPRIGHT,
                                                              .unit = "s",
                                                              .lo = window[0],
                                                              .hi = window[1]});
    int code = plot_history_refer_all(sheet, option);
    if (!code) code = plot_profile_scale(chart, sheet->units, window, option, NULL);
    if (!code) code = chart_draw(chart, option->width, ret_image);
    for (unsigned i = 0; i < option->n_over; i++) plot_over_done(&sheet->over[i]);
    return code;
}

static int plot_history_draw_one(struct history *history, const char *const *columns, unsigned n,
                                 const struct plot_option *option, cairo_surface_t **ret_image)
{
    struct history_sheet *sheet = mem_new(1, sizeof *sheet);
    sheet->chart = (struct chart){.title = history->title, .note = ""};
    int code = plot_history_fill(history, columns, n, sheet);
    if (!code) code = plot_history_finish(sheet, option, ret_image);
    mem_free(sheet);
    return code;
}

int plot_history_draw(const char *directory, const char *const *columns, unsigned n, const struct plot_option *option,
                      cairo_surface_t **ret_image)
{
    struct history history;
    int code = plot_history_open(directory, &history);
    if (!code) code = plot_history_draw_one(&history, columns, n, option, ret_image);
    plot_history_done(&history);
    return code;
}

/* A panel for each column with a line for each run. */
static int plot_history_overlay(struct history *runs, const char *const *directories, unsigned n_run,
                                const char *const *columns, unsigned n, struct history_sheet *sheet)
{
    for (unsigned c = 0; c < n; c++) {
        struct chart_panel *panel = &sheet->chart.panel[sheet->chart.n_panel++];
        sheet->units[c] = plot_unit_of(runs[0].scene, columns[c]);
        panel->name = plot_history_label(&runs[0], columns[c]);
        plot_history_note(sheet, columns[c]);
        for (unsigned i = 0; i < n_run; i++) {
            const struct table *table = plot_history_table(&runs[i], columns[c]);
            if (!table) return plot_history_unknown(&runs[i], directories[i], columns[c]);
            panel->series[panel->n_series++] = (struct chart_series){.name = runs[i].name,
                                                                     .n = table->n_row,
                                                                     .x = table_column(table, "t"),
                                                                     .y = table_column(table, columns[c])};
        }
    }
    return STATUS_OK;
}

static int plot_history_compare(const char *const *directories, unsigned n_run, const char *const *columns, unsigned n,
                                const struct plot_option *option, cairo_surface_t **ret_image)
{
    if (n_run > CHART_SERIES)
        return status_fail(STATUS_CASE, "%u runs in one picture: at most %d", n_run, CHART_SERIES);
    if (n > CHART_PANELS) return status_fail(STATUS_CASE, "%u columns in one picture: at most %d", n, CHART_PANELS);
    if (!n)
        return status_fail(STATUS_CASE, "which columns of the %u runs? bulla plot DIR1 DIR2 ... history COLUMN...",
                           n_run);
    struct history runs[CHART_SERIES] = {0};
    struct history_sheet *sheet = mem_new(1, sizeof *sheet);
    char *names[CHART_SERIES], *title = plot_case_common_title(directories, n_run);
    plot_case_names(directories, n_run, names);
    sheet->chart = (struct chart){.title = title, .note = ""};
    unsigned open = 0;
    int code = STATUS_OK;
    while (!code && open < n_run) {
        code = plot_history_open(directories[open], &runs[open]);
        runs[open].name = names[open];
        open++;
    }
    if (!code) code = plot_history_overlay(runs, directories, n_run, columns, n, sheet);
    if (!code) code = plot_history_finish(sheet, option, ret_image);
    for (unsigned i = 0; i < open; i++) plot_history_done(&runs[i]);
    for (unsigned i = open; i < n_run; i++) mem_free(names[i]);
    mem_free(sheet);
    mem_free(title);
    return code;
}

int plot_history_write(const char *const *directories, unsigned n_directory, const char *const *columns, unsigned n,
                       const struct plot_option *option)
{
    cairo_surface_t *image;
    if (n_directory > 1) TRY(plot_history_compare(directories, n_directory, columns, n, option, &image));
    else TRY(plot_history_draw(directories[0], columns, n, option, &image));
    char *path = option->output ? mem_text(option->output)
                                : mem_print("%s/plots/%s.png", directories[0], n_directory > 1 ? "compare" : "history");
    int code = picture_canvas_write(image, path);
    if (!code) printf("%s\n", path);
    cairo_surface_destroy(image);
    mem_free(path);
    return code;
}
