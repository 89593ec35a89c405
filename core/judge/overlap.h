/* overlap.h - two snapshots of one domain whose meshes differ in where they are refined, cell by cell.
 *
 * Everywhere one of the two has cells as coarse as those of the other, or coarser: the other's are averaged over them,
 * so that cell averages meet cell averages and nothing is interpolated. */
#ifndef OVERLAP_H
#define OVERLAP_H

#include "io/read.h"

/* One number per cell of a snapshot, `stride` apart. */
struct overlap_side {
    const struct snapshot *snapshot;
    const double *values;
    unsigned stride;
};

/* Calls `visit` once for each of these cells, which fill the domain, with their size (the product of the widths) and
 * the value of one side and of the other there; which side is which changes from cell to cell. STATUS_CASE: the cells
 * of the two cannot be halves of each other. */
int overlap_visit(const struct overlap_side *a, const struct overlap_side *b,
                  void (*visit)(void *data, double size, double one, double other), void *data);

#endif
