/* verify_point.h - what one run of a study of cost came to, and what a list of such points becomes: a front, a table, a
 * CSV file, a picture. */
#ifndef VERIFY_POINT_H
#define VERIFY_POINT_H

#include "base/text.h"

#include <stdbool.h>

struct verify_point {
    char *scheme, *cells; /* "koren + thinc", "64 x 32 + 1" */
    double error;         /* NaN: none, the run failed */
    double cpu;           /* of the steps; of another code: what it says [s] */
    double cell_steps;    /* 0 of another code */
    int code;             /* exit code */
    bool other;           /* of another code */
    bool front;           /* no run has both less error and less CPU time */
};

void verify_point_done(struct verify_point *point);

/* Marks the front. */
void verify_point_front(struct verify_point *points, unsigned n);

/* One line for each scheme, `n_size` points each: error and CPU seconds, bold on the front; then the others. */
void verify_point_table(struct text *out, const struct verify_point *points, unsigned n, unsigned n_size);

/* "# title", a line of names, then a line for each point: scheme, cells, error, cpu_s, cell_steps, kind (run, front,
 * other). STATUS_RUN if it cannot be written. */
int verify_point_csv(const char *path, const char *title, const struct verify_point *points, unsigned n);

/* `bulla plot CSV cost -o PNG`, as a process of its own. STATUS_RUN if it fails. */
int verify_point_picture(const char *csv, const char *png);

#endif
