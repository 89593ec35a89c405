/* table_csv.h - states from a CSV file.
 *
 * Lines that begin with # are comments. The first other line names the columns with their units, in any order:
 *     rho[kg/m3],T[K],p[Pa],e[J/kg],c[m/s],s[J/kg/K]
 * Then one state per line, temperatures ascending, the same for every density, densities ascending. Anything else
 * is refused with the line and the reason. */
#ifndef TABLE_CSV_H
#define TABLE_CSV_H

#include "table_file.h"

enum { TABLE_LINE = 1024 };

/* The next line that is no comment, without its end. 0: there is one, 1: end, 2: too long. */
static int table_csv_line(FILE *stream, struct table_file *file, char text[static TABLE_LINE])
{
    while (fgets(text, TABLE_LINE, stream)) {
        size_t length = strlen(text);
        file->line++;
        if (length == TABLE_LINE - 1) return 2;
        while (length && strchr("\r\n \t", text[length - 1])) text[--length] = '\0';
        if (length && text[0] != '#') return 0;
    }
    return 1;
}

/* Which field of a line is which column. */
static int table_csv_header(const struct bulla_host *host, const char *path, const struct table_file *file, char *text,
                            int column[static TABLE_COLUMNS])
{
    int n = 0, found = 0;
    for (char *next = text; next; n++) {
        char *name = next;
        next = strchr(name, ',');
        if (next) *next++ = '\0';
        int which = 0;
        while (which < TABLE_COLUMNS && strcmp(name, table_file_names[which]) != 0) which++;
        if (which == TABLE_COLUMNS)
            return table_file_fail(host, path, file->line,
                                   "column '%.40s' is not known; columns are rho[kg/m3], T[K], p[Pa], e[J/kg], c[m/s], "
                                   "s[J/kg/K], in these units",
                                   name);
        if (n == TABLE_COLUMNS || (found >> which & 1))
            return table_file_fail(host, path, file->line, "column '%s' is there twice", name);
        found |= 1 << which;
        column[n] = which;
    }
    for (int which = 0; which < TABLE_COLUMNS; which++)
        if (!(found >> which & 1))
            return table_file_fail(host, path, file->line, "column '%s' is missing", table_file_names[which]);
    return 0;
}

/* One state. */
static int table_csv_row(const struct bulla_host *host, const char *path, struct table_file *file, const char *text,
                         const int column[static TABLE_COLUMNS])
{
    double *row = file->row[file->n_row];
    const char *at = text;
    for (int i = 0; i < TABLE_COLUMNS; i++) {
        const char *name = table_file_names[column[i]];
        char *end;
        row[column[i]] = strtod(at, &end);
        if (end == at) return table_file_fail(host, path, file->line, "%s: '%.30s' is no number", name, at);
        if (!isfinite(row[column[i]])) return table_file_fail(host, path, file->line, "%s is not finite", name);
        bool more = i + 1 < TABLE_COLUMNS;
        if (*end != (more ? ',' : '\0'))
            return table_file_fail(host, path, file->line,
                                   "%d numbers with commas between them are wanted, not '%.60s'", TABLE_COLUMNS, text);
        at = end + (more ? 1 : 0);
    }
    if (!(row[TABLE_RHO] > 0.0 && row[TABLE_T] > 0.0 && row[TABLE_C] > 0.0))
        return table_file_fail(host, path, file->line, "rho, T and c must be above 0");
    file->lines[file->n_row++] = file->line;
    return 0;
}

static int table_csv_grow(const struct bulla_host *host, const char *path, struct table_file *file)
{
    if (file->n_row < file->room) return 0;
    size_t room = file->room ? 2 * file->room : 4096;
    if (room > (size_t)2 * TABLE_MOST * TABLE_MOST)
        return table_file_fail(host, path, file->line, "more than %d x %d states", TABLE_MOST, TABLE_MOST);
    void *row = realloc(file->row, room * sizeof *file->row);
    if (row) file->row = row;
    long *lines = realloc(file->lines, room * sizeof *lines);
    if (lines) file->lines = lines;
    if (!row || !lines) return table_file_fail(host, path, file->line, "out of memory");
    file->room = room;
    return 0;
}

/* The states must be a grid: the same ascending temperatures at every one of the ascending densities. */
static int table_csv_grid(const struct bulla_host *host, const char *path, struct table_file *file)
{
    size_t n_T = 1;
    while (n_T < file->n_row && file->row[n_T][TABLE_RHO] == file->row[0][TABLE_RHO]) n_T++;
    size_t n_rho = file->n_row / n_T;
    if (n_T < TABLE_LEAST || n_rho < TABLE_LEAST || n_T > TABLE_MOST || n_rho > TABLE_MOST)
        return table_file_fail(
            host, path, 0,
            "%zu densities and %zu temperatures: %d to %d of each are wanted, the states of one density "
            "after another",
            n_rho, n_T, TABLE_LEAST, TABLE_MOST);
    for (size_t r = 0; r < file->n_row; r++) {
        const double *row = file->row[r], *first = file->row[r - r % n_T], *same = file->row[r % n_T];
        if (r % n_T && row[TABLE_RHO] != first[TABLE_RHO])
            return table_file_fail(host, path, file->lines[r],
                                   "the grid is not rectangular: density %g after %zu of %zu temperatures at %g",
                                   row[TABLE_RHO], r % n_T, n_T, first[TABLE_RHO]);
        if (row[TABLE_T] != same[TABLE_T])
            return table_file_fail(host, path, file->lines[r],
                                   "the grid is not rectangular: temperature %g where the first density has %g",
                                   row[TABLE_T], same[TABLE_T]);
        if (r % n_T && !(row[TABLE_T] > file->row[r - 1][TABLE_T]))
            return table_file_fail(host, path, file->lines[r], "temperatures must ascend");
        if (r >= n_T && r % n_T == 0 && !(row[TABLE_RHO] > file->row[r - n_T][TABLE_RHO]))
            return table_file_fail(host, path, file->lines[r], "densities must ascend");
    }
    if (file->n_row % n_T)
        return table_file_fail(host, path, file->line, "the file ends after %zu of %zu temperatures at density %g",
                               file->n_row % n_T, n_T, file->row[file->n_row - 1][TABLE_RHO]);
    file->n_rho = n_rho;
    file->n_T = n_T;
    return 0;
}

static int table_csv_states(const struct bulla_host *host, const char *path, FILE *stream, struct table_file *file)
{
    char text[TABLE_LINE];
    int column[TABLE_COLUMNS], end = table_csv_line(stream, file, text);
    if (end)
        return table_file_fail(host, path, file->line, end == 2 ? "the line is too long" : "there is no line of names");
    if (table_csv_header(host, path, file, text, column)) return 1;
    while ((end = table_csv_line(stream, file, text)) == 0)
        if (table_csv_grow(host, path, file) || table_csv_row(host, path, file, text, column)) return 1;
    if (end == 2) return table_file_fail(host, path, file->line, "the line is too long");
    if (ferror(stream)) return table_file_fail(host, path, file->line, "cannot be read");
    return table_csv_grid(host, path, file);
}

/* Non-zero after host->fail. */
static int table_csv_read(const struct bulla_host *host, const char *path, struct table_file *file)
{
    FILE *stream = fopen(path, "r");
    if (!stream) return table_file_fail(host, path, 0, "cannot be opened");
    int code = table_csv_states(host, path, stream, file);
    fclose(stream);
    return code;
}

#endif
