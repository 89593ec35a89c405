/* series.c - see series.h. Rows are read one after the other into one growing block and turned
 * into columns at the end. */
#include "case/series.h"

#include "base/file.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SERIES_LINE = 1 << 16 }; /* longest line */

struct series_reader {
    struct series *series;
    unsigned line;
    char separator; /* ' ': any white space */
    char *remark;   /* what a comment said about the columns */
    double *rows;   /* [capacity][n_column] */
    size_t capacity;
};

/* Cuts one cell off the front of `*rest`, blanks trimmed; NULL when there is none left. */
static char *series_cell(char **rest, char separator)
{
    if (!*rest) return NULL;
    char *cell = *rest + strspn(*rest, " \t"),
         *end = cell + strcspn(cell, separator == ' ' ? " \t" : (char[2]){separator, 0});
    *rest = *end ? end + 1 : NULL;
    if (*rest && separator == ' ' && !(*rest)[strspn(*rest, " \t")]) *rest = NULL;
    *end = '\0';
    while (end > cell && isspace((unsigned char)end[-1])) *--end = '\0';
    return cell;
}

static bool series_number(const char *cell, double *ret_value)
{
    size_t length = text_number(cell, ret_value);
    return length && !cell[length] && isfinite(*ret_value);
}

static char series_separator(const char *line)
{
    return strchr(line, ';') ? ';' : strchr(line, ',') ? ',' : ' ';
}

static unsigned series_count(const char *line, char separator)
{
    char *copy = mem_text(line), *rest = copy;
    unsigned count = 0;
    while (series_cell(&rest, separator)) count++;
    mem_free(copy);
    return count;
}

/* What stands in brackets behind a name, or NULL. */
static char *series_unit(const char *name)
{
    const char *open = strpbrk(name, "[("), *close = open ? strchr(open, *open == '[' ? ']' : ')') : NULL;
    return close ? mem_text_n(open + 1, (size_t)(close - open - 1)) : NULL;
}

/* A unit belongs to the name before it, where blanks separate columns. */
static void series_squeeze(char *line)
{
    char *to = line;
    for (const char *at = line; *at; at++) {
        const char *next = at + strspn(at, " \t");
        if (to > line && (*next == '[' || *next == '(')) at = next;
        *to++ = *at;
    }
    *to = '\0';
}

/* Names from a line, if it has as many cells as there are columns. */
static void series_take_names(struct series *series, const char *line, char separator, bool remark)
{
    if (series_count(line, separator) != series->n_column) return;
    char *copy = mem_text(line), *rest = copy;
    series->names = mem_new(series->n_column + 1, sizeof *series->names);
    series->units = mem_new(series->n_column + 1, sizeof *series->units);
    for (unsigned i = 0; i < series->n_column; i++) {
        char *name = series_cell(&rest, separator);
        size_t length = strlen(name), cut = strcspn(name, " [(");
        series->units[i] = series_unit(name);
        if (remark && cut > 0) name[cut] = '\0';
        if (length > 1 && *name == '"' && name[length - 1] == '"') {
            name[length - 1] = '\0';
            name++;
        }
        series->names[i] = mem_text(name);
    }
    mem_free(copy);
}

/* The first line that is no comment: names, or already numbers. */
static int series_start(struct series_reader *reader, const char *line, bool *ret_header)
{
    struct series *series = reader->series;
    reader->separator = series_separator(line);
    series->n_column = series_count(line, reader->separator);
    if (series->n_column > SERIES_COLUMNS)
        return status_fail(STATUS_CASE, "%s:%u: %u columns; at most %d are read", series->path, reader->line,
                           series->n_column, SERIES_COLUMNS);
    char *copy = mem_text(line), *rest = copy;
    double value;
    *ret_header = true;
    for (char *cell = series_cell(&rest, reader->separator); cell; cell = series_cell(&rest, reader->separator))
        if (series_number(cell, &value)) *ret_header = false; /* a name is no number: a mistake among numbers is one */
    mem_free(copy);
    if (*ret_header) series_take_names(series, line, reader->separator, false);
    else if (reader->remark) series_take_names(series, reader->remark, ',', true);
    return STATUS_OK;
}

static int series_row(struct series_reader *reader, char *line)
{
    struct series *series = reader->series;
    if (series->n_row == SERIES_ROWS)
        return status_fail(STATUS_CASE, "%s:%u: more than %d rows", series->path, reader->line, SERIES_ROWS);
    if (series->n_row == reader->capacity) {
        size_t more = reader->capacity ? 2 * reader->capacity : 1024, width = series->n_column;
        reader->rows = mem_grow(reader->rows, reader->capacity * width, more * width, sizeof *reader->rows);
        series->lines = mem_grow(series->lines, reader->capacity, more, sizeof *series->lines);
        reader->capacity = more;
    }
    char *rest = line, *cell;
    unsigned count = 0;
    for (; (cell = series_cell(&rest, reader->separator)); count++) {
        double value;
        if (count == series->n_column) break;
        if (!series_number(cell, &value))
            return status_fail(STATUS_CASE, "%s:%u: column %u: '%.40s' is not a number%s", series->path, reader->line,
                               count + 1, cell, strchr(cell, ',') ? " (the decimal point is '.')" : "");
        reader->rows[series->n_row * series->n_column + count] = value;
    }
    if (cell || count != series->n_column)
        return status_fail(STATUS_CASE, "%s:%u: %s than %u columns, the number in the first line", series->path,
                           reader->line, cell ? "more" : "fewer", series->n_column);
    series->lines[series->n_row++] = reader->line;
    return STATUS_OK;
}

static int series_line(struct series_reader *reader, char *line)
{
    size_t length = strlen(line);
    while (length && isspace((unsigned char)line[length - 1])) line[--length] = '\0';
    if (reader->line == 1 && strncmp(line, "\xef\xbb\xbf", 3) == 0) line += 3; /* byte order mark */
    if (!*line) return STATUS_OK;
    if (*line == '#') {
        const char *remark = strstr(line, "columns:");
        if (!remark || reader->series->n_column) return STATUS_OK;
        mem_free(reader->remark);
        reader->remark = mem_text(remark + strlen("columns:"));
        return STATUS_OK;
    }
    if (!reader->series->n_column) {
        bool header;
        if (series_separator(line) == ' ') series_squeeze(line);
        TRY(series_start(reader, line, &header));
        if (header) return STATUS_OK;
    }
    return series_row(reader, line);
}

static void series_turn(struct series_reader *reader)
{
    struct series *series = reader->series;
    series->columns = mem_new(series->n_column, sizeof *series->columns);
    for (unsigned c = 0; c < series->n_column; c++) {
        series->columns[c] = mem_new(series->n_row, sizeof **series->columns);
        for (size_t r = 0; r < series->n_row; r++) series->columns[c][r] = reader->rows[r * series->n_column + c];
    }
}

/* The next line and its length; 0 at the end, SERIES_LINE if there was no room for all of it. */
static size_t series_next(FILE *file, char line[static SERIES_LINE + 1])
{
    size_t length = 0;
    for (int byte = 0; byte != '\n' && length < SERIES_LINE && (byte = getc_unlocked(file)) != EOF;)
        line[length++] = (char)byte;
    line[length] = '\0';
    return length;
}

static int series_read_file(struct series_reader *reader, FILE *file)
{
    char *line = mem_new(SERIES_LINE + 1, 1);
    int code = STATUS_OK;
    for (size_t length; !code && (length = series_next(file, line)) > 0;) {
        reader->line++;
        if (memchr(line, 0, length))
            code = status_fail(STATUS_CASE, "%s:%u: not a text file", reader->series->path, reader->line);
        else if (length == SERIES_LINE)
            code = status_fail(STATUS_CASE, "%s:%u: the line is longer than %d bytes", reader->series->path,
                               reader->line, SERIES_LINE - 1);
        else code = series_line(reader, line);
    }
    if (!code && ferror(file)) code = status_fail(STATUS_CASE, "%s: %s", reader->series->path, strerror(errno));
    mem_free(line);
    if (!code && !reader->series->n_row)
        code = status_fail(STATUS_CASE, "%s:%u: no numbers in this file", reader->series->path, reader->line);
    return code;
}

int series_read(const char *path, struct series *ret_series)
{
    const char *why;
    FILE *file = file_open(path, &why);
    if (!file) return status_fail(STATUS_CASE, "%s: %s", path, why);
    struct series series = {.path = mem_text(path)};
    struct series_reader reader = {.series = &series};
    int code = series_read_file(&reader, file);
    fclose(file);
    if (!code) series_turn(&reader);
    mem_free(reader.rows);
    mem_free(reader.remark);
    if (code) series_done(&series);
    else *ret_series = series;
    return code;
}

void series_done(struct series *series)
{
    for (unsigned c = 0; c < series->n_column; c++) {
        if (series->names) mem_free(series->names[c]);
        if (series->units) mem_free(series->units[c]);
        if (series->columns) mem_free(series->columns[c]);
    }
    mem_free(series->names);
    mem_free(series->units);
    mem_free(series->columns);
    mem_free(series->lines);
    mem_free(series->path);
    *series = (struct series){0};
}

/* The first column that has this name, by itself or before a unit; or -1. */
static int series_named(const struct series *series, const char *name, bool before_unit)
{
    for (unsigned c = 0; series->names && c < series->n_column; c++) {
        const char *here = series->names[c];
        size_t length = before_unit && series->units[c] ? strcspn(here, " [(") : strlen(here);
        if (length == strlen(name) && strncmp(here, name, length) == 0) return (int)c;
    }
    return -1;
}

/* The column of that number, from 1; or -1. */
static int series_numbered(const struct series *series, const char *name)
{
    char *end;
    unsigned long number = isdigit((unsigned char)*name) ? strtoul(name, &end, 10) : 0;
    return number > 0 && !*end && number <= series->n_column ? (int)number - 1 : -1;
}

int series_find(const struct series *series, const char *name, unsigned *ret_column)
{
    int found = series_named(series, name, false);
    if (found < 0) found = series_numbered(series, name);
    if (found < 0) found = series_named(series, name, true);
    if (found >= 0) {
        *ret_column = (unsigned)found;
        return STATUS_OK;
    }
    struct text all = {0};
    text_add(&all, "%s: no column '%s'; there ", series->path, name);
    text_add(&all, series->n_column == 1 ? "is" : "are");
    for (unsigned c = 0; c < series->n_column; c++)
        text_add(&all, "%s %u%s%s%s", c ? "," : "", c + 1, series->names ? " (" : "",
                 series->names ? series->names[c] : "", series->names ? ")" : "");
    status_fail(STATUS_CASE, "%s", all.at);
    text_done(&all);
    return STATUS_CASE;
}

int series_column(const struct series *series, const char *name, const double **ret_column)
{
    unsigned column;
    TRY(series_find(series, name, &column));
    *ret_column = series->columns[column];
    return STATUS_OK;
}

int series_ascending(const struct series *series, const char *name)
{
    const double *column;
    TRY(series_column(series, name, &column));
    for (size_t r = 1; r < series->n_row; r++)
        if (!(column[r] > column[r - 1]))
            return status_fail(STATUS_CASE, "%s:%u: column '%s' must ascend, but %.10g comes after %.10g", series->path,
                               series->lines[r], name, column[r], column[r - 1]);
    return STATUS_OK;
}
