/* gather.h - what all ranks have, on rank 0, in the order of the ranks, and sums over the ranks before each: a tree, so
 * that it takes as many messages as there are doublings of the ranks, and for sums as many again. */
#ifndef GATHER_H
#define GATHER_H

#include <stddef.h>

/* Each rank's n items of `size` bytes: on rank 0 those of all, *ret_n of them (mem_free), elsewhere NULL and 0.
 * Collective. */
void *gather_items(const void *items, size_t size, unsigned n, unsigned *ret_n);

/* Sums `count` values over all ranks, in place; ret_before[count]: over the ranks below this one. Collective. */
void gather_sums(long long *values, int count, long long *ret_before);

#endif
