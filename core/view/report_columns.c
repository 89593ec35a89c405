/* report_columns.c - see report_columns.h. The table has all columns, the picture the first of them. */
#include "view/report_columns.h"

#include "base/mem.h"
#include "base/status.h"
#include "case/table.h"
#include "view/plot_history.h"
#include "view/plot_unit.h"
#include "view/report_html.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

enum { COLUMNS_DRAWN = 12 };

struct columns {
    struct table table;
    struct scene *scene; /* or NULL: units are not known */
    unsigned n;
    unsigned *shown; /* [n] of the table */
};

static bool report_columns_is_shown(const char *name)
{
    return strcmp(name, "t") != 0 && strcmp(name, "step") != 0 && strncmp(name, "guard_", 6) != 0;
}

static void report_columns_number(struct text *page, double value)
{
    if (isfinite(value)) text_add(page, "<td>%.5g</td>", value);
    else text_add(page, "<td>not finite</td>");
}

static void report_columns_row(struct text *page, const struct columns *columns, unsigned c)
{
    const double *values = columns->table.columns[c];
    double least = INFINITY, most = -INFINITY;
    char unit[PICTURE_SCALE_TEXT];
    for (size_t i = 0; i < columns->table.n_row; i++) {
        if (!isfinite(values[i])) continue;
        if (values[i] < least) least = values[i];
        if (values[i] > most) most = values[i];
    }
    text_add(page, "<tr><td>");
    report_html_text(page, columns->table.names[c]);
    text_add(page, "</td><td>%s</td>", report_html_unit(plot_unit_of(columns->scene, columns->table.names[c]), unit));
    report_columns_number(page, values[0]);
    report_columns_number(page, least);
    report_columns_number(page, most);
    report_columns_number(page, values[columns->table.n_row - 1]);
    text_add(page, "</tr>\n");
}

static void report_columns_list(struct text *page, const struct columns *columns)
{
    text_add(page, "<div class=\"wide\"><table class=\"numbers\">\n<tr><th>column</th><th>unit</th><th>first</th>"
                   "<th>least</th><th>greatest</th><th>last</th></tr>\n");
    for (unsigned i = 0; i < columns->n; i++) report_columns_row(page, columns, columns->shown[i]);
    text_add(page, "</table></div>\n");
}

static int report_columns_draw(struct text *page, const char *directory, const struct columns *columns,
                               const char *title, const struct plot_option *option)
{
    const char *names[COLUMNS_DRAWN];
    unsigned n = 0;
    cairo_surface_t *image;
    struct text caption = {0};
    char unit[PICTURE_SCALE_TEXT];
    text_add(&caption, "Against time [s]: ");
    for (unsigned i = 0; i < columns->n && n < COLUMNS_DRAWN; i++) {
        if (strcmp(columns->table.names[columns->shown[i]], "dt") == 0) continue;
        names[n] = columns->table.names[columns->shown[i]];
        text_add(&caption, "%s%s [%s]", n ? ", " : "", names[n],
                 report_html_unit(plot_unit_of(columns->scene, names[n]), unit));
        n++;
    }
    if (n == COLUMNS_DRAWN) text_add(&caption, "; further columns are in the table only");
    int code = n ? plot_history_draw(directory, names, n, option, &image) : STATUS_OK;
    if (!code && n) {
        code = report_html_figure(page, image, title, caption.at);
        cairo_surface_destroy(image);
    }
    text_done(&caption);
    return code;
}

static int report_columns_section(struct text *page, const char *directory, struct columns *columns, const char *title,
                                  const struct plot_option *option)
{
    columns->shown = mem_new(columns->table.n_column + 1, sizeof *columns->shown);
    for (unsigned c = 0; c < columns->table.n_column; c++)
        if (report_columns_is_shown(columns->table.names[c])) columns->shown[columns->n++] = c;
    if (!columns->n || !columns->table.n_row || !table_column(&columns->table, "t")) return STATUS_OK;
    columns->scene = plot_unit_scene(directory);
    text_add(page, "<h2>%s</h2>\n<div class=\"figures\">\n", title);
    int code = report_columns_draw(page, directory, columns, title, option);
    report_columns_list(page, columns);
    text_add(page, "</div>\n");
    return code;
}

int report_columns_add(struct text *page, const char *directory, const char *name, const char *title,
                       const struct plot_option *option)
{
    struct columns columns = {0};
    char *path = mem_print("%s/%s", directory, name);
    int code = access(path, F_OK) == 0 ? table_read(path, TABLE_OF_RUN, &columns.table) : STATUS_OK;
    if (!code) code = report_columns_section(page, directory, &columns, title, option);
    table_done(&columns.table);
    scene_free(columns.scene);
    mem_free(columns.shown);
    mem_free(path);
    return code;
}
