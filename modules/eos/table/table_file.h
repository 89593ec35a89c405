/* table_file.h - the states of a file of the equation of state `table`, read: what table_csv.h and table_h5.h fill, the
 * checks that do not depend on the format, and how a place in the file is named in a message. */
#ifndef TABLE_FILE_H
#define TABLE_FILE_H

#include "bulla/module.h"

#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TABLE_RHO, TABLE_T, TABLE_P, TABLE_E, TABLE_C, TABLE_S, TABLE_COLUMNS };
enum { TABLE_LEAST = 8, TABLE_MOST = 1500 };

/* What was read: row r is the state at density r/n_T, temperature r % n_T. */
struct table_file {
    size_t n_rho, n_T;
    double (*row)[TABLE_COLUMNS];
    size_t n_row, room;
    long line;   /* of a CSV file, while it is read */
    long *lines; /* of the rows; NULL: the file has arrays, not lines */
};

static const char *const table_file_names[TABLE_COLUMNS] = {"rho[kg/m3]", "T[K]",   "p[Pa]",
                                                            "e[J/kg]",    "c[m/s]", "s[J/kg/K]"};

static int table_file_say(const struct bulla_host *host, const char *place, const char *format, va_list list)
{
    char reason[256], text[1024];
    vsnprintf(reason, sizeof reason, format, list);
    snprintf(text, sizeof text, "%s: %s", place, reason);
    host->fail(text);
    return 1;
}

/* Says why, with the file and line (0: none); returns 1. */
__attribute__((format(printf, 4, 5))) static int table_file_fail(const struct bulla_host *host, const char *path,
                                                                 long line, const char *format, ...)
{
    char place[700];
    if (line) snprintf(place, sizeof place, "%.600s:%ld", path, line);
    else snprintf(place, sizeof place, "%.600s", path);
    va_list list;
    va_start(list, format);
    int code = table_file_say(host, place, format, list);
    va_end(list);
    return code;
}

/* The same at a state: by its line, or its place in the arrays. */
__attribute__((format(printf, 5, 6))) static int table_file_fail_at(const struct bulla_host *host, const char *path,
                                                                    const struct table_file *file, size_t r,
                                                                    const char *format, ...)
{
    char place[700];
    if (file->lines) snprintf(place, sizeof place, "%.600s:%ld", path, file->lines[r]);
    else snprintf(place, sizeof place, "%.600s, state [%zu][%zu]", path, r / file->n_T, r % file->n_T);
    va_list list;
    va_start(list, format);
    int code = table_file_say(host, place, format, list);
    va_end(list);
    return code;
}

static void table_file_free(struct table_file *file)
{
    free(file->row);
    free(file->lines);
    *file = (struct table_file){0};
}

/* At a density, p, e and s grow with temperature. */
static int table_file_monotone(const struct bulla_host *host, const char *path, const struct table_file *file)
{
    static const int columns[] = {TABLE_P, TABLE_E, TABLE_S};
    for (size_t r = 0; r < file->n_row; r++)
        for (size_t k = 0; k < 3 && r % file->n_T; k++)
            if (!(file->row[r][columns[k]] > file->row[r - 1][columns[k]]))
                return table_file_fail_at(host, path, file, r,
                                          "%s does not grow with temperature: %.9g after %.9g at density %g",
                                          table_file_names[columns[k]], file->row[r][columns[k]],
                                          file->row[r - 1][columns[k]], file->row[r][TABLE_RHO]);
    return 0;
}

#endif
