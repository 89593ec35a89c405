/* sweep_table.c - see sweep_table.h. Both forms are the same cells, written in another way. */
#include "batch/sweep_table.h"

#include "base/mem.h"
#include "batch/sweep_name.h"
#include "case/unit.h"
#include "cli/human.h"

#include <math.h>
#include <string.h>

/* An expectation that any run has judged: combinations may differ in what they expect. */
struct sweep_table_expect {
    const char *what;
    unsigned nth; /* among those that are called the same */
};

struct sweep_table_grid {
    const struct sweep_table *table;
    struct sweep_table_expect *expects;
    unsigned n_expect, n_row, n_column;
    bool csv;
    char **cells; /* [n_row + 1][n_column], the first row holds the titles */
};

static const char *const sweep_table_costs[] = {"exit", "wall_s", "cpu_s", "cells_updated"};
enum { COSTS = 4 };

static const struct study_value *sweep_table_find(const struct study_row *row, const struct sweep_table_expect *expect)
{
    unsigned seen = 0;
    for (unsigned v = 0; v < row->n_value; v++)
        if (strcmp(row->values[v].what, expect->what) == 0 && seen++ == expect->nth) return &row->values[v];
    return NULL;
}

static void sweep_table_collect(struct sweep_table_grid *grid)
{
    for (unsigned i = 0; i < grid->n_row; i++) {
        const struct study_row *run = &grid->table->rows[i].run;
        for (unsigned v = 0; v < run->n_value; v++) {
            struct sweep_table_expect expect = {run->values[v].what, 0};
            for (unsigned b = 0; b < v; b++) expect.nth += strcmp(run->values[b].what, expect.what) == 0;
            bool known = false;
            for (unsigned e = 0; e < grid->n_expect && !known; e++)
                known = grid->expects[e].nth == expect.nth && strcmp(grid->expects[e].what, expect.what) == 0;
            if (known) continue;
            grid->expects = mem_grow(grid->expects, grid->n_expect, grid->n_expect + 1, sizeof *grid->expects);
            grid->expects[grid->n_expect++] = expect;
        }
    }
}

static char *sweep_table_number(double value, bool csv)
{
    if (isnan(value)) return mem_text("");
    return mem_print(csv ? "%.17g" : "%.6g", value);
}

/* The value of "path=value": in SI units for CSV if it is a quantity. */
static char *sweep_table_setting(const char *set, bool csv)
{
    const char *text = strchr(set, '=') + 1;
    struct unit unit;
    char bad[32];
    double value;
    if (csv && unit_quantity(text, &value, &unit, bad) == UNIT_FINE) return sweep_table_number(value, true);
    size_t length = strlen(text);
    if (length > 1 && *text == '"') return mem_text_n(text + 1, length - 2);
    return mem_text(text);
}

static char *sweep_table_cost(const struct study_row *run, unsigned which, bool csv)
{
    char text[HUMAN_ROOM];
    const double figures[COSTS] = {(double)run->code, run->wall, run->cpu, run->cells};
    if (run->code == SWEEP_TABLE_WAITING) return mem_text("");
    if (which == 0) return mem_print("%d", run->code);
    if (csv || isnan(figures[which])) return sweep_table_number(figures[which], csv);
    return which == 3 ? mem_text(human_count(figures[which], text)) : mem_print("%.3g", figures[which]);
}

static char *sweep_table_judged(const struct study_value *value, bool csv)
{
    if (!value) return mem_text("");
    if (csv) return sweep_table_number(value->value, true);
    char *number = isnan(value->value) ? mem_text("nan") : sweep_table_number(value->value, false);
    char *text = mem_print("%s%s", number, value->passed ? "" : " FAIL");
    mem_free(number);
    return text;
}

/* The next free cell of a row. */
static void sweep_table_add(struct sweep_table_grid *grid, unsigned row, unsigned *column, char *text)
{
    grid->cells[row * grid->n_column + (*column)++] = text;
}

static void sweep_table_titles(struct sweep_table_grid *grid)
{
    const struct sweep_table *table = grid->table;
    const struct matrix *matrix = &table->plan->matrix;
    unsigned at = 0;
    if (grid->csv) sweep_table_add(grid, 0, &at, mem_text("combination"));
    for (unsigned k = 0; k < matrix->n_set; k++) {
        const char *path = grid->csv ? matrix->rows[0].sets[k] : sweep_name_key(matrix, k);
        sweep_table_add(grid, 0, &at, mem_text_n(path, strcspn(path, "=")));
    }
    for (unsigned c = 0; c < COSTS; c++) sweep_table_add(grid, 0, &at, mem_text(sweep_table_costs[c]));
    for (unsigned e = 0; e < grid->n_expect; e++) {
        sweep_table_add(grid, 0, &at, mem_text(grid->expects[e].what));
        if (grid->csv) sweep_table_add(grid, 0, &at, mem_print("%s: holds", grid->expects[e].what));
    }
    for (unsigned v = 0; v < table->n_value; v++) sweep_table_add(grid, 0, &at, mem_text(table->values[v].label));
}

static void sweep_table_row(struct sweep_table_grid *grid, unsigned index)
{
    const struct sweep_table *table = grid->table;
    const struct matrix *matrix = &table->plan->matrix;
    const struct sweep_table_row *row = &table->rows[index];
    unsigned at = 0;
    if (grid->csv) sweep_table_add(grid, index + 1, &at, mem_text(table->plan->rows[index].name));
    for (unsigned k = 0; k < matrix->n_set; k++)
        sweep_table_add(grid, index + 1, &at, sweep_table_setting(matrix->rows[index].sets[k], grid->csv));
    for (unsigned c = 0; c < COSTS; c++)
        sweep_table_add(grid, index + 1, &at, sweep_table_cost(&row->run, c, grid->csv));
    for (unsigned e = 0; e < grid->n_expect; e++) {
        const struct study_value *value = sweep_table_find(&row->run, &grid->expects[e]);
        sweep_table_add(grid, index + 1, &at, sweep_table_judged(value, grid->csv));
        if (grid->csv) sweep_table_add(grid, index + 1, &at, mem_text(!value ? "" : value->passed ? "1" : "0"));
    }
    for (unsigned v = 0; v < table->n_value; v++)
        sweep_table_add(grid, index + 1, &at, sweep_table_number(row->values[v], grid->csv));
}

static struct sweep_table_grid sweep_table_fill(const struct sweep_table *table, bool csv)
{
    const struct matrix *matrix = &table->plan->matrix;
    struct sweep_table_grid grid = {.table = table, .n_row = matrix->n_row, .csv = csv};
    sweep_table_collect(&grid);
    grid.n_column = csv + matrix->n_set + COSTS + (csv ? 2 : 1) * grid.n_expect + table->n_value;
    grid.cells = mem_new((size_t)(grid.n_row + 1) * grid.n_column, sizeof *grid.cells);
    sweep_table_titles(&grid);
    for (unsigned i = 0; i < grid.n_row; i++) sweep_table_row(&grid, i);
    return grid;
}

static void sweep_table_free(struct sweep_table_grid *grid)
{
    for (unsigned i = 0; i < (grid->n_row + 1) * grid->n_column; i++) mem_free(grid->cells[i]);
    mem_free(grid->cells);
    mem_free(grid->expects);
}

/* A field of a CSV file (RFC 4180). */
static void sweep_table_field(struct text *out, const char *field)
{
    if (!field[strcspn(field, ",\"\n\r")]) {
        text_add(out, "%s", field);
        return;
    }
    text_add(out, "\"");
    for (; *field; field++) text_add(out, *field == '"' ? "\"\"" : "%c", *field);
    text_add(out, "\"");
}

void sweep_table_csv(const struct sweep_table *table, struct text *out)
{
    struct sweep_table_grid grid = sweep_table_fill(table, true);
    for (unsigned i = 0; i < (grid.n_row + 1) * grid.n_column; i++) {
        sweep_table_field(out, grid.cells[i]);
        text_add(out, (i + 1) % grid.n_column ? "," : "\n");
    }
    sweep_table_free(&grid);
}

/* Characters of the widest cell of a column. */
static int sweep_table_width(const struct sweep_table_grid *grid, unsigned column)
{
    size_t wide = 1;
    for (unsigned r = 0; r <= grid->n_row; r++) {
        size_t length = strlen(grid->cells[r * grid->n_column + column]);
        wide = length > wide ? length : wide;
    }
    return (int)wide;
}

void sweep_table_print(const struct sweep_table *table, struct text *out)
{
    struct sweep_table_grid grid = sweep_table_fill(table, false);
    int *widths = mem_new(grid.n_column, sizeof *widths);
    for (unsigned c = 0; c < grid.n_column; c++) widths[c] = sweep_table_width(&grid, c);
    for (unsigned i = 0; i < (grid.n_row + 1) * grid.n_column; i++) {
        unsigned column = i % grid.n_column;
        text_add(out, "%*s%s", widths[column], *grid.cells[i] ? grid.cells[i] : "-",
                 column + 1 < grid.n_column ? "  " : "\n");
    }
    mem_free(widths);
    sweep_table_free(&grid);
}
