/* table.c - see table.h. Rows are collected one after the other and turned into columns at the
 * end, so that a file is read once and grows in one block. */
#include "case/table.h"

#include "base/file.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TABLE_LINE = 1 << 20 }; /* longest line */

struct table_reader {
    const char *path;
    long line;
    char **names;
    unsigned n_column;
    double *cells; /* row by row */
    long *lines;   /* of the rows */
    size_t n_row, capacity;
    bool cut; /* the last row was incomplete */
};

/* "Rdot[m/s]" -> "Rdot"; "T (nan: no cv given)" -> "T"; "rho(T)" stays. */
static size_t table_name_length(const char *name, size_t length)
{
    size_t used = 0;
    while (used < length && name[used] != '[' && name[used] != ' ' && name[used] != '\t') used++;
    return used;
}

static void table_forget_names(struct table_reader *reader)
{
    for (unsigned c = 0; c < reader->n_column; c++) mem_free(reader->names[c]);
    mem_free(reader->names);
    reader->names = NULL;
    reader->n_column = 0;
}

static void table_take_names(struct table_reader *reader, const char *list)
{
    table_forget_names(reader);
    for (const char *at = list; *at;) {
        at += strspn(at, " \t");
        size_t length = strcspn(at, ",;\r\n");
        reader->names = mem_grow(reader->names, reader->n_column, reader->n_column + 1, sizeof *reader->names);
        reader->names[reader->n_column++] = mem_text_n(at, table_name_length(at, length));
        at += length;
        if (*at != ',') break;
        at++;
    }
}

/* Reads one number; the locale is always "C", so strtod is safe. Returns false if there is none. */
static bool table_number(const char **at, double *ret)
{
    char *end;
    *ret = strtod(*at, &end);
    if (end == *at) return false;
    *at = end + strspn(end, " \t");
    return true;
}

static void table_row(struct table_reader *reader, const char *line)
{
    unsigned n = reader->n_column;
    if ((reader->n_row + 1) * n > reader->capacity) {
        size_t more = 2 * (reader->n_row + 1) * n + 1024;
        reader->cells = mem_grow(reader->cells, reader->capacity, more, sizeof *reader->cells);
        reader->lines = mem_grow(reader->lines, reader->capacity / n, more / n, sizeof *reader->lines);
        reader->capacity = more;
    }
    const char *at = line + strspn(line, " \t");
    for (unsigned c = 0; c < n; c++) {
        bool last = c + 1 == n;
        double value;
        if (!table_number(&at, &value) || (last ? !strchr("\r\n", *at) : *at != ',')) {
            reader->cut = true;
            return;
        }
        if (!last) at++;
        reader->cells[reader->n_row * n + c] = value;
    }
    reader->lines[reader->n_row++] = reader->line;
}

static int table_line(struct table_reader *reader, const char *line)
{
    reader->line++;
    if (reader->cut)
        return status_fail(STATUS_RUN, "%s:%ld: not a row of %u numbers", reader->path, reader->line - 1,
                           reader->n_column);
    if (line[strspn(line, " \t\r\n")] == '\0') return STATUS_OK;
    if (*line == '#') {
        const char *mark = strstr(line, "columns:");
        if (mark && reader->n_row == 0) table_take_names(reader, mark + strlen("columns:"));
        return STATUS_OK;
    }
    double value;
    const char *at = line;
    if (reader->n_row == 0 && !table_number(&at, &value)) {
        table_take_names(reader, line);
        return STATUS_OK;
    }
    if (reader->n_column == 0)
        return status_fail(STATUS_RUN, "%s:%ld: numbers before a line that names the columns", reader->path,
                           reader->line);
    table_row(reader, line);
    return STATUS_OK;
}

static void table_transpose(struct table_reader *reader, struct table *table)
{
    unsigned n = reader->n_column;
    *table = (struct table){.n_column = n, .n_row = reader->n_row, .lines = reader->lines, .cut = reader->cut};
    table->names = mem_grow(reader->names, n, n + 1, sizeof *table->names);
    reader->names = NULL;
    reader->n_column = 0;
    reader->lines = NULL;
    table->columns = mem_new(n + 1, sizeof *table->columns);
    for (unsigned c = 0; c < n; c++) {
        table->columns[c] = mem_new(reader->n_row + 1, sizeof **table->columns);
        for (size_t r = 0; r < reader->n_row; r++) table->columns[c][r] = reader->cells[r * n + c];
    }
}

/* All lines of the file, by a room of TABLE_LINE + 2 bytes. */
static int table_lines(struct table_reader *reader, FILE *file, enum table_kind kind, char *room)
{
    room[TABLE_LINE + 1] = 'x'; /* overwritten when the room is full */
    while (fgets(room, TABLE_LINE + 2, file)) {
        size_t length = strlen(room);
        bool whole = length && room[length - 1] == '\n';
        if (room[TABLE_LINE + 1] == '\0' && !whole)
            return status_fail(STATUS_RUN, "%s:%ld: longer than %d bytes", reader->path, reader->line + 1, TABLE_LINE);
        if (!whole && !feof(file))
            return status_fail(STATUS_RUN, "%s:%ld: not a text file", reader->path, reader->line + 1);
        if (whole || kind == TABLE_GIVEN) TRY(table_line(reader, room));
    }
    return ferror(file) ? status_fail(STATUS_RUN, "cannot read %s to its end", reader->path) : STATUS_OK;
}

int table_read(const char *path, enum table_kind kind, struct table *ret_table)
{
    const char *why;
    FILE *file = file_open(path, &why);
    if (!file) return status_fail(STATUS_RUN, "cannot read %s: %s", path, why);
    struct table_reader reader = {.path = path};
    char *room = mem_new(TABLE_LINE + 2, 1);
    int code = table_lines(&reader, file, kind, room);
    if (!code && reader.n_column == 0) code = status_fail(STATUS_RUN, "%s: no line names the columns", path);
    if (!code && reader.cut && kind == TABLE_GIVEN)
        code = status_fail(STATUS_RUN, "%s:%ld: not a row of %u numbers", path, reader.line, reader.n_column);
    if (!code) table_transpose(&reader, ret_table);
    table_forget_names(&reader);
    mem_free(reader.cells);
    mem_free(reader.lines);
    mem_free(room);
    fclose(file);
    return code;
}

void table_done(struct table *table)
{
    for (unsigned c = 0; c < table->n_column; c++) {
        mem_free(table->names[c]);
        mem_free(table->columns[c]);
    }
    mem_free(table->names);
    mem_free(table->columns);
    mem_free(table->lines);
    *table = (struct table){0};
}

const double *table_column(const struct table *table, const char *name)
{
    for (unsigned c = 0; c < table->n_column; c++)
        if (strcmp(table->names[c], name) == 0) return table->columns[c];
    return NULL;
}

static int table_need(const struct table *table, const char *path, const char *name, const double **ret)
{
    *ret = table_column(table, name);
    struct text known = {0};
    for (unsigned c = 0; c < table->n_column && !*ret; c++) text_add(&known, " %s", table->names[c]);
    int code = *ret ? STATUS_OK : status_fail(STATUS_RUN, "%s has no column '%s'; it has%s", path, name, known.at);
    text_done(&known);
    if (code) return code;
    for (size_t r = 0; r < table->n_row; r++)
        if (!isfinite((*ret)[r]))
            return status_fail(STATUS_RUN, "%s:%ld: '%s' is %g there, not a finite number", path, table->lines[r], name,
                               (*ret)[r]);
    return STATUS_OK;
}

static int table_check_axis(const struct table *table, const char *path, const char *name, const double *x)
{
    size_t n = table->n_row;
    if (n < 2) return status_fail(STATUS_RUN, "%s has less than two rows", path);
    for (size_t r = 1; r < n; r++)
        if (x[r] < x[r - 1])
            return status_fail(STATUS_RUN, "%s:%ld: '%s' must not descend, but is %.10g after %.10g", path,
                               table->lines[r], name, x[r], x[r - 1]);
    return x[n - 1] > x[0] ? STATUS_OK : status_fail(STATUS_RUN, "%s: '%s' is %.10g in all rows", path, name, x[0]);
}

int table_reference(const char *path, const char *coordinate, const char *column, struct table_pair *ret_pair)
{
    struct table_pair pair;
    TRY(table_read(path, TABLE_GIVEN, &pair.table));
    int code = table_need(&pair.table, path, coordinate, &pair.x);
    if (!code) code = table_need(&pair.table, path, column, &pair.y);
    if (!code) code = table_check_axis(&pair.table, path, coordinate, pair.x);
    if (code) table_done(&pair.table);
    else *ret_pair = pair;
    return code;
}

/* Number of leading entries of xs that are <= x. */
static size_t table_below(size_t n, const double *xs, double x)
{
    size_t low = 0, high = n;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (xs[middle] <= x) low = middle + 1;
        else high = middle;
    }
    return low;
}

double table_interpolate(size_t n, const double *xs, const double *ys, double x)
{
    size_t after = table_below(n, xs, x);
    if (after == 0) return ys[0];
    if (after == n) return ys[n - 1];
    double weight = (x - xs[after - 1]) / (xs[after] - xs[after - 1]);
    return ys[after - 1] + weight * (ys[after] - ys[after - 1]);
}

/* At a vertical step on an edge the limit from inside counts. */
double table_average(size_t n, const double *xs, const double *ys, double lower, double upper)
{
    double sum = 0, x = lower, y = table_interpolate(n, xs, ys, lower);
    size_t i = table_below(n, xs, lower);
    for (; i < n && xs[i] < upper; i++) {
        sum += (xs[i] - x) * (y + ys[i]) / 2;
        x = xs[i];
        y = ys[i];
    }
    double last = y;
    if (i > 0 && i < n) last += (ys[i] - y) * (upper - x) / (xs[i] - x);
    return (sum + (upper - x) * (y + last) / 2) / (upper - lower);
}
