/* study.h - one verification scene, run once per row of its matrix by this program itself.
 *
 * Every run is a process of its own: a crash ends a row, not the study. */
#ifndef STUDY_H
#define STUDY_H

#include "batch/matrix.h"
#include "batch/study_child.h"
#include "batch/study_row.h"

#include <stdbool.h>

struct study {
    char *id, *path;        /* file name without .yaml; the case file */
    struct matrix matrix;   /* its counts are of cells as fine as the finest level, everywhere */
    bool levels;            /* has a row levels of refinement? */
    struct study_row *rows; /* [matrix.n_row] */
};

struct study_options {
    const char *directory; /* outputs go to DIRECTORY/id/ROW */
    const char *ranks;     /* for -n, or NULL */
};

/* Reads the matrix of a case; no row has run yet. */
int study_new(const char *path, struct study *ret_study);
void study_done(struct study *study);

/* Runs row `index`. A run that fails is noted in the row, not an error; STATUS_RUN: it could not be started. */
int study_run(struct study *study, unsigned index, const struct study_options *options);

/* One run, waited for: reads what it left into *ret_row. A run that fails is noted there, not an error; STATUS_RUN: it
 * could not be started. */
int study_trial(const struct study_child *child, struct study_row *ret_row);

/* Observed order of value `v` from row `from` to row `to`, which must be finer; NaN if there is none. */
double study_order(const struct study *study, unsigned from, unsigned to, unsigned v);

/* Did everything hold: all runs finished, the bounds of judged rows, and orders? An order is kept when the
 * last two rows or the first and the last show it: with shocks single pairs scatter with the place
 * of the jumps in their cells, with smooth waves coarse rows are not asymptotic yet. */
bool study_passed(const struct study *study);

#endif
