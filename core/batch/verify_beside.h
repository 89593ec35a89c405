/* verify_beside.h - `bulla verify --beside PATH=VALUE`: every scene twice, as it is and with other settings.
 *
 * What a change of a default does is a table over all scenes: of each the error that changes most, what both runs cost,
 * and whether what it expects still holds. Coarse variants run where there are any. */
#ifndef VERIFY_BESIDE_H
#define VERIFY_BESIDE_H

#include <stdbool.h>

struct verify_beside_options {
    const char *source;    /* folder that holds docs/; for `save` */
    const char *directory; /* the runs write to DIRECTORY/beside */
    const char *ranks;     /* for -n, or NULL */
    char *const *paths;    /* case files, sorted; [n_path] */
    unsigned n_path;
    char *const *plain, *const *beside; /* settings of the first and of the second run, "scheme.cfl=0.8" as --set takes
                                           them; both end with NULL */
    const char *title;                  /* what is beside what */
    bool save;                          /* into docs/beside.md, too */
};

/* Runs and prints. A run that fails is a result, no failure. STATUS_RUN: a run could not be started. */
int verify_beside(const struct verify_beside_options *options);

#endif
