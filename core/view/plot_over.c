/* plot_over.c - see plot_over.h. */
#include "view/plot_over.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* The columns of the file by comma, in new memory. */
static char *plot_over_columns(const struct table *table)
{
    struct text list = {0};
    for (unsigned c = 0; c < table->n_column; c++) text_add(&list, "%s%s", c ? ", " : "", table->names[c]);
    char *names = mem_text(list.at ? list.at : "none");
    text_done(&list);
    return names;
}

static int plot_over_unknown(const struct plot_over *over, const char *column)
{
    const char *near = text_nearest(column, (const char **)over->table.names);
    char *there = plot_over_columns(&over->table);
    int code = status_fail(STATUS_CASE, "--over %s: no column '%s'%s%s%s; there are: %s; choose two: --over %s:X,Y",
                           over->given, column, near ? " (did you mean '" : "", near ? near : "", near ? "'?)" : "",
                           there, over->path);
    mem_free(there);
    return code;
}

/* "FILE:X,Y" in three, X in new memory (NULL: not given); a file whose name has a colon needs no columns. */
static char *plot_over_split(struct plot_over *over)
{
    const char *colon = strrchr(over->given, ':'), *comma = colon ? strchr(colon, ',') : NULL;
    if (!comma || access(over->given, F_OK) == 0) {
        over->path = mem_text(over->given);
        return NULL;
    }
    over->path = mem_text_n(over->given, (size_t)(colon - over->given));
    over->column = mem_text(comma + 1);
    return mem_text_n(colon + 1, (size_t)(comma - colon - 1));
}

static int plot_over_open(struct plot_over *over, const char *x)
{
    if (access(over->path, R_OK) != 0)
        return status_fail(STATUS_CASE, "--over %s: %s: %s; FILE.csv or FILE.csv:X,Y is needed", over->given,
                           over->path, strerror(errno));
    if (table_read(over->path, TABLE_GIVEN, &over->table)) {
        char *why = mem_text(status_text());
        int code = status_fail(STATUS_CASE, "--over: %s", why);
        mem_free(why);
        return code;
    }
    if (!over->table.n_row) return status_fail(STATUS_CASE, "--over %s: no rows of numbers", over->given);
    over->x = table_column(&over->table, x);
    if (!over->x) return plot_over_unknown(over, x);
    if (over->column && !table_column(&over->table, over->column)) return plot_over_unknown(over, over->column);
    return STATUS_OK;
}

int plot_over_read(const char *given, struct plot_over *ret_over)
{
    *ret_over = (struct plot_over){.given = given};
    char *x = plot_over_split(ret_over);
    int code = plot_over_open(ret_over, x ? x : "t");
    const char *slash = strrchr(ret_over->path, '/');
    snprintf(ret_over->label, sizeof ret_over->label, "%.80s%s%.60s", slash ? slash + 1 : ret_over->path,
             ret_over->column ? ": " : "", ret_over->column ? ret_over->column : "");
    mem_free(x);
    return code;
}

void plot_over_done(struct plot_over *over)
{
    table_done(&over->table);
    mem_free(over->path);
    mem_free(over->column);
}

int plot_over_add(struct plot_over *over, const char *column, bool other, struct chart_panel *panel)
{
    const char *wanted = over->column ? over->column : column;
    const double *y = table_column(&over->table, wanted);
    if (!y || (!other && strcmp(wanted, column) != 0)) return STATUS_OK;
    if (panel->n_series == CHART_SERIES)
        return status_fail(STATUS_CASE, "--over %s: the panel of %s has %d lines already", over->given, column,
                           CHART_SERIES);
    panel->series[panel->n_series++] =
        (struct chart_series){.name = over->label, .reference = true, .n = over->table.n_row, .x = over->x, .y = y};
    over->used = true;
    return STATUS_OK;
}

int plot_over_unused(const struct plot_over *over)
{
    char *there = plot_over_columns(&over->table);
    int code = status_fail(STATUS_CASE,
                           "--over %s: none of the columns drawn is in it; there are: %s; choose two: "
                           "--over %s:X,Y",
                           over->given, there, over->path);
    mem_free(there);
    return code;
}
