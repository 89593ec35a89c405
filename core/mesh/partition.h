/* partition.h - which rank owns which tile: per level, equal cost along the Morton curve.
 *
 * Each level is cut on its own, because each sub-step of each level synchronises (simulated: docs/scaling.md).
 * Levels with fewer tiles than ranks go to the ranks with least work so far. A level whose tiles change is cut anew:
 * keeping owners would save next to nothing. Pure functions: they decide nothing by the clock or the rank. */
#ifndef PARTITION_H
#define PARTITION_H

#include "mesh/mesh.h"

/* Imbalance (largest over mean load, less 1) from which on a level whose tiles stay the same is cut anew. */
#define PARTITION_SLACK 0.1

/* Sets tiles[i].rank, ascending, for `size` ranks, so that the largest load is the least that contiguous pieces can
 * have. cost[n]: work per tile (not negative); load[size]: work per coarse step that the ranks have so far,
 * `weight` * cost is added. */
void partition_cut(struct tile *tiles, unsigned n, const double *cost, int size, double weight, double *load);

/* Largest over mean load of a level with the owners it has (ascending), less 1. The mean is over as many ranks as
 * can have a tile: 0 is reached with fewer tiles than ranks, too. */
double partition_imbalance(const struct tile *tiles, unsigned n, const double *cost, int size);

#endif
