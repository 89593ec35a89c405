/* share.h - memory that the ranks of a machine have in common: large tables that all of them only read.
 *
 * The first rank of a machine makes a file without a name (memfd_create), the others open it through /proc. Nothing is
 * left behind however the ranks end, and /dev/shm, which is small in containers, is not used. Where the others
 * cannot open it, every rank gets memory of its own. */
#ifndef SHARE_H
#define SHARE_H

#include <stdbool.h>
#include <stddef.h>

struct share {
    void *at; /* page-aligned; zeros at first */
    size_t bytes;
    int part, parts; /* which of the ranks that have this memory in common, of how many */
};

/* Makes it. `together`: all ranks call, with the same size; else it is this rank's alone. STATUS_RUN on all ranks of a
 * machine where there is no memory. */
int share_new(size_t bytes, bool together, struct share *ret_share);

/* Waits for all that have it in common. */
void share_meet(const struct share *share);

/* Gives it up; every rank for itself. */
void share_free(struct share *share);

#endif
