/* matrix.h - the `matrix:` of a case: all combinations of its lists, as --set options.
 *
 *     matrix: {domain.cells: [[64, 64], [128, 128]], scheme.limiter: [mc, minmod]}
 *
 * makes four rows; the last key changes fastest. */
#ifndef MATRIX_H
#define MATRIX_H

#include "case/merge.h"

struct matrix_row {
    char **sets;  /* [n_set], then NULL: "domain.cells=[64, 64]" */
    char *cells;  /* "64 x 64", of this row's domain.cells or, without it, of the case's own */
    double count; /* the number of cells; 0 if it cannot be read off */
    unsigned dim; /* axes of domain.cells */
};

struct matrix {
    char *title;  /* of the case */
    double count; /* cells of the case as it stands; 0 if it cannot be read off */
    int levels;   /* mesh.levels of it; -1 if it is an expression */
    unsigned n_set, n_row;
    struct matrix_row *rows; /* one row without sets when the case has no matrix */
};

/* Reads a case file, with those it extends and `options` (NULL: none) laid over it, for these keys alone; mistakes in
 * the rest of the file are found when it runs. STATUS_CASE after printed errors. Release with matrix_done. */
int matrix_read(const char *path, const struct merge_options *options, struct matrix *ret_matrix);

/* The same for the tree of a case, or of anything else with a `matrix:`. The recorded message has no place. */
int matrix_combine(const struct node *root, struct matrix *ret_matrix);
void matrix_done(struct matrix *matrix);

#endif
