/* csv.h - a table of numbers that grows row by row: one header line, '%.17g', flushed with every
 * row, so that a killed run leaves whole rows. Rank 0 writes; the calls are collective. */
#ifndef CSV_H
#define CSV_H

#include "io/notes.h"

#include <stdbool.h>

struct csv;

/* Where rows come in blocks, one row for each place: the numbers behind the first one that tell places apart. */
struct csv_places {
    unsigned n, n_number;
    const double *numbers; /* [n][n_number] */
};

/* Starts a file. With `resume` one that has the same header, and in its first block the same places, goes on: rows
 * whose first number is larger than `limit` (the future of the state that is taken up) and a broken last one are cut
 * off. Another one is kept under another name. `places`: NULL, of single rows. */
int csv_open(const char *path, const char *header, const struct csv_places *places, bool resume, double limit,
             struct csv **ret_csv);

/* Appends a row; whole numbers are written as such. */
int csv_row(struct csv *csv, unsigned n, const double *values);

/* Appends several rows of n numbers each at once. */
int csv_rows(struct csv *csv, unsigned rows, unsigned n, const double *values);

/* Makes all rows lasting, and notes under `name` how long the file is and what its checksum. */
int csv_keep(struct csv *csv, const char *name, struct notes *notes);

/* Goes back to where the file was when csv_keep noted it. The rows up to there are those of the file itself or, if it
 * has not them (another directory), of the file `origin`; without either the table begins anew, which is said in a
 * warning. */
int csv_recall(struct csv *csv, const char *name, const struct notes *notes, const char *origin);

void csv_close(struct csv *csv); /* NULL is fine */

#endif
