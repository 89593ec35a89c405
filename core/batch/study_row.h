/* study_row.h - what one run of a study left: expectations as it judged them, and what it cost.
 *
 * Read from expect.json and provenance.json, so that a run of yesterday counts like one of now. */
#ifndef STUDY_ROW_H
#define STUDY_ROW_H

#include <stdbool.h>

/* One expectation as a run judged it (expect.json). */
struct study_value {
    char *what, *bound; /* "L1(density)", "<= 0.5" */
    double value;       /* NaN if it was not finite */
    double order;       /* of a norm: least order of convergence wanted, or 0 */
    bool passed, is_norm;
};

struct study_row {
    int code;         /* exit code of the run: 0, 1, or a failure */
    double cpu, wall; /* time of the run, all ranks; from its start to its end [s]; NaN if it did not say */
    double cells;     /* cells updated, in both stages of a step; NaN if it did not say */
    double work;      /* cells advanced, summed over steps and levels; 0 if unknown */
    bool judged;      /* as fine as the case itself or finer: its bounds hold here */
    unsigned n_value; /* 0 for a run that failed */
    struct study_value *values;
};

/* Reads what the run in `directory` left after it had ended with `code`; replaces the contents of *row but
 * `judged`. Start from {0}. */
void study_row_read(const char *directory, int code, struct study_row *row);
void study_row_done(struct study_row *row);

/* The exit code with which the run in `directory` ended, by its provenance.json; -1: none has ended there. */
int study_row_exit(const char *directory);

#endif
