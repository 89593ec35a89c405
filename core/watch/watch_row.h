/* watch_row.h - the last row of a table that a run is writing, and the names and units of its columns. */
#ifndef WATCH_ROW_H
#define WATCH_ROW_H

#include <jansson.h>

struct watch_row {
    char *text;     /* what the others point into */
    unsigned n;     /* columns */
    char **names;   /* [n] */
    double *values; /* [n]; NaN: none */
};

/* Of DIR/NAME; a table that is missing or has no row yet has 0 columns, or values that are all NaN. */
void watch_row_read(const char *directory, const char *name, struct watch_row *ret_row);
void watch_row_done(struct watch_row *row);

/* The value of a column, or NaN. */
double watch_row_value(const struct watch_row *row, const char *column);

/* All columns of history.csv and probes.csv in their order, "file", "name", "unit" each ("": not known). Numbers of
 * columns elsewhere (watch_curve.h) count along this list. */
json_t *watch_row_columns(const char *directory);

#endif
