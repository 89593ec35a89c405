/* verify_cost.h - `bulla verify --cost ID`: error against CPU seconds, of schemes, cell counts and levels.
 *
 * cases/cost.yaml lists schemes (a scene may have its own), and for each scene its cells, levels, the expectation that
 * is the error, and the rows of other codes. Out come DIRECTORY/cost/ID.csv, a row for each run, those that no other
 * run beats in both marked as the front; the picture of it, ID.png, by `bulla plot ID.csv cost`; and a table. */
#ifndef VERIFY_COST_H
#define VERIFY_COST_H

#include <stdbool.h>

struct verify_cost_options {
    const char *source;    /* folder that holds cases/ and docs/ */
    const char *directory; /* the runs write to DIRECTORY/cost */
    const char *ranks;     /* for -n, or NULL */
    bool save;             /* table and picture go into docs/cost.md and docs/images too */
};

/* One scene. STATUS_CASE: cases/cost.yaml has no such scene, or says it wrongly; STATUS_RUN: nothing could be run or
 * written. A run that fails is a row without an error. */
int verify_cost(const struct verify_cost_options *options, const char *id);

#endif
