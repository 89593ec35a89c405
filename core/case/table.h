/* table.h - a CSV file of numbers in memory: histories, probes, reference solutions.
 *
 * Names come from the header line, or, in reference files, from a comment that holds
 * "columns: a, b[unit], c (remark)": units in brackets and remarks after a space are cut off.
 * Lines that begin with '#' are comments. "nan" is a number here. */
#ifndef TABLE_H
#define TABLE_H

#include <stdbool.h>
#include <stddef.h>

enum table_kind {
    TABLE_OF_RUN, /* written by a run, perhaps a killed one: a last line that was cut short is dropped */
    TABLE_GIVEN,  /* given by somebody: all lines count, the last may lack its end */
};

struct table {
    unsigned n_column;
    char **names; /* [n_column], NULL after the last */
    size_t n_row;
    double **columns; /* [n_column][n_row] */
    long *lines;      /* [n_row], of the file */
    bool cut;         /* a last row was dropped */
};

/* Two columns of a reference. */
struct table_pair {
    struct table table;
    const double *x, *y; /* [table.n_row]; x does not descend, its ends differ */
};

/* Reads a file. STATUS_RUN when it cannot be read or a line is no row of numbers; the message
 * names file and line. Release with table_done. */
int table_read(const char *path, enum table_kind kind, struct table *ret_table);
void table_done(struct table *table);

/* Reads a reference and looks whether it can be one: both columns are there and finite, x ascends (two rows may share
 * an x: a step), and there are two rows at least. STATUS_RUN with file and line. Release `table`. */
int table_reference(const char *path, const char *coordinate, const char *column, struct table_pair *ret_pair);

/* The column of that name, or NULL. */
const double *table_column(const struct table *table, const char *name);

/* The value at `x` of the straight lines through (xs ascending, ys); the end values beyond. */
double table_interpolate(size_t n, const double *xs, const double *ys, double x);

/* The average of those lines over [lower, upper], lower < upper, both within or beyond the ends. */
double table_average(size_t n, const double *xs, const double *ys, double lower, double upper);

#endif
