/* series.h - a CSV file of numbers: measured pulses, reference data.
 *
 * Lines that begin with '#' are comments; empty lines are skipped. Cells are separated by ';',
 * or ',', or white space: the first of these that the first line has. The first line may hold
 * names; else a comment "# columns: t, p[Pa], ..." gives them (what follows a blank or bracket is
 * cut off); what stands in brackets, p[Pa] or p (Pa), is the unit; else columns are known by their number alone,
 * from 1. Every other cell is a finite decimal number. Failures are STATUS_CASE and begin with file:line. */
#ifndef SERIES_H
#define SERIES_H

#include <stddef.h>

struct series {
    char *path;
    unsigned n_column;
    char **names; /* [n_column]; NULL: the columns have no names */
    char **units; /* [n_column] what stands in brackets behind a name, or NULL; NULL with names */
    size_t n_row;
    double **columns; /* [n_column][n_row] */
    unsigned *lines;  /* [n_row] where a row stands in the file */
};

enum { SERIES_ROWS = 10000000, SERIES_COLUMNS = 1000 };

/* Reads a file of at most SERIES_ROWS rows. Free with series_done. */
int series_read(const char *path, struct series *ret_series);
void series_done(struct series *series); /* a zeroed series is fine */

/* The column of that name, with or without its unit in brackets, or of that number ("2"). The message lists what there
 * is. */
int series_find(const struct series *series, const char *name, unsigned *ret_column);
int series_column(const struct series *series, const char *name, const double **ret_column);

/* Is the column strictly ascending (a time)? The message names the line where it is not. */
int series_ascending(const struct series *series, const char *name);

#endif
