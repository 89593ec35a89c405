/* csv.h - a table of numbers that grows row by row: one header line, '%.17g', flushed with every
 * row, so that a killed run leaves whole rows. Rank 0 writes; the calls are collective. */
#ifndef CSV_H
#define CSV_H

#include <stdbool.h>

struct csv;

/* Starts a file. With `resume` one that has the same header goes on: rows whose first number is
 * larger than `limit` (the future of the state that is taken up) and a broken last one are cut off. */
int csv_open(const char *path, const char *header, bool resume, double limit, struct csv **ret_csv);

/* Appends a row; whole numbers are written as such. */
int csv_row(struct csv *csv, unsigned n, const double *values);

void csv_close(struct csv *csv); /* NULL is fine */

#endif
