/* verify_hard.h - `bulla verify hard`: every scene of cases/hard, coarse, with every combination of cases/hard.yaml.
 *
 * One table says of each combination how many scenes finish, hold and stay symmetric to the bit, how errors compare
 * with those of the first one, what the guard did and what it cost; another has the scenes one by one. */
#ifndef VERIFY_HARD_H
#define VERIFY_HARD_H

#include <stdbool.h>

struct verify_hard_options {
    const char *source;       /* folder that holds cases/ and docs/ */
    const char *directory;    /* the runs write to DIRECTORY/hard */
    const char *ranks;        /* for -n, or NULL */
    const char *const *words; /* scenes: "h7", "h13"; a name, or the beginning of one up to a dash */
    int n_word;               /* 0: all */
    bool save;                /* into docs/hard.md, too */
};

/* Runs and prints. A scene that does not finish is a result, no failure. STATUS_CASE: there are no such scenes, or
 * cases/hard.yaml cannot be read; STATUS_RUN: a run could not be started. */
int verify_hard(const struct verify_hard_options *options);

#endif
