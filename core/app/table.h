/* table.h - a CSV file of numbers in memory: histories, probes, reference solutions.
 *
 * Names come from the header line, or, in reference files, from a comment that holds
 * "columns: a, b[unit], c (remark)": units in brackets and remarks after a space are cut off.
 * Lines that begin with '#' are comments. "nan" is a number here. A last line that is cut
 * short (a killed run) is dropped. */
#ifndef TABLE_H
#define TABLE_H

#include <stddef.h>

struct table {
    unsigned n_column;
    char **names; /* [n_column], NULL after the last */
    size_t n_row;
    double **columns; /* [n_column][n_row] */
};

/* Reads a file. STATUS_RUN when it cannot be read or a line is no row of numbers; the message
 * names file and line. Release with table_done. */
int table_read(const char *path, struct table *ret_table);
void table_done(struct table *table);

/* The column of that name, or NULL. */
const double *table_column(const struct table *table, const char *name);

/* The value at `x` of the straight lines through (xs ascending, ys); the end values beyond. */
double table_interpolate(size_t n, const double *xs, const double *ys, double x);

/* The average of those lines over [lower, upper], lower < upper, both within or beyond the ends. */
double table_average(size_t n, const double *xs, const double *ys, double lower, double upper);

#endif
