/* watch_curve.h - a column of a run against time, with as many points as a screen has room for: of each stretch of rows
 * the least and the largest value, so that no peak is lost. */
#ifndef WATCH_CURVE_H
#define WATCH_CURVE_H

#include "case/table.h"

#include <jansson.h>
#include <stddef.h>
#include <sys/stat.h>

enum { WATCH_CURVE_STRETCHES = 400 };

/* The table read last: a page asks for one column after the other, and a long table takes long to read. Start from
 * {0}. */
struct watch_curve_kept {
    char *path; /* NULL: none */
    struct stat file;
    struct table table;
};

void watch_curve_done(struct watch_curve_kept *kept);

/* Rows to show of n values: ascending, at most 2 WATCH_CURVE_STRETCHES + 2, in ret_rows (room for them); the first and
 * the last among them. NaN rows are shown where a stretch has nothing else, as gaps. */
size_t watch_curve_choose(size_t n, const double *values, size_t *ret_rows);

/* Column `index` of a run (watch_row_columns): "name", "rows" (of the table), "t", "v" (null: none), and "fault", a
 * text, where there is nothing to show; NULL: there is no such column. */
json_t *watch_curve_look(struct watch_curve_kept *kept, const char *directory, unsigned long index);

#endif
