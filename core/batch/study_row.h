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
    double equals;      /* what it should be; NaN if no one value is */
    char *reference;    /* of a norm: what with; else NULL */
    bool passed, is_norm;
};

/* What the guard did in a run: cell-steps at first order, relaxed and clipped; steps halved. 0 if it did not say. */
struct study_guard {
    double fallback, relaxed, clipped, retries;
};

struct study_row {
    int code;         /* exit code of the run: 0, 1, or a failure */
    double cpu, wall; /* time of the run, all ranks; from its start to its end [s]; NaN if it did not say */
    double cells;     /* cells updated, in both stages of a step; NaN if it did not say */
    double work;      /* cells advanced, summed over steps and levels; 0 if unknown */
    double steps_cpu; /* CPU time of the steps and of regridding alone, without start and output [s]; NaN likewise */
    struct study_guard guard;
    bool judged;      /* as fine as the case itself or finer: its bounds hold here */
    unsigned n_value; /* 0 for a run that failed */
    struct study_value *values;
};

/* Reads what the run in `directory` left after it had ended with `code`; replaces the contents of *row but
 * `judged`. Start from {0}. */
void study_row_read(const char *directory, int code, struct study_row *row);
void study_row_done(struct study_row *row);

/* How far the value is from the truth: a norm, or the distance to what it should equal, over that where it is not 0.
 * NaN: no truth is known to it (a bound, a mirror image). */
double study_row_error(const struct study_value *value);

/* The exit code with which the run in `directory` ended, by its provenance.json; -1: none has ended there. */
int study_row_exit(const char *directory);

#endif
