/* partition.h - which rank owns which tile: per level, equal cost along the Morton curve.
 *
 * Each level is cut on its own, because each sub-step of each level synchronises (simulated: docs/scaling.md).
 * Levels with fewer tiles than ranks are spread over stretches of ranks, in each of them they go to the ranks with
 * least work so far. A level whose tiles change is cut anew: keeping owners would save next to nothing. Costs are
 * integers, so that sums have no order and no rounding. Pure functions: they decide nothing by the clock or the rank.
 */
#ifndef PARTITION_H
#define PARTITION_H

#include "mesh/mesh.h"

/* Imbalance (largest over mean load, less 1) from which on a level whose tiles stay the same is cut anew. */
#define PARTITION_SLACK 0.1

/* Ranks of a stretch, at most, over which levels with fewer tiles than ranks are spread (where there are fewer tiles
 * than stretches, as many as tiles, and longer ones): less than a node has, so that all nodes get their share, and
 * enough to choose among. */
#define PARTITION_STRETCH 16

/* Tiles in a row that cost the same. */
struct partition_run {
    uint32_t n, cost; /* both at least 1 */
};

/* A level along its curve. */
struct partition_runs {
    unsigned n, room;
    struct partition_run *list;
};

/* A cost (1: a tile of one material) in hundredths, 1 to 65535. */
uint32_t partition_units(double cost);

/* Adds n tiles; those beside equal ones lengthen their run. */
void partition_add(struct partition_runs *runs, uint32_t n, uint32_t cost);
void partition_free(struct partition_runs *runs);

/* Cuts a level for `size` ranks, so that the largest load is the least that contiguous pieces can have: rank r gets the
 * tiles ret_first[r] .. ret_first[r + 1] - 1 (ret_first[size + 1]). load[size]: work per coarse step that the ranks
 * have so far, `weight` * cost is added; it decides who gets a tile where there are fewer tiles than ranks. */
void partition_cut(const struct partition_runs *runs, int size, uint64_t weight, uint64_t *load, uint32_t *ret_first);

/* The same of n tiles that cost the same, for ranks that have nothing yet. */
void partition_equal(uint32_t n, int size, uint32_t *ret_first);

/* Largest over mean of the loads that a level gives the ranks, less 1. The mean is over as many ranks as can have one
 * of its n tiles: 0 is reached with fewer tiles than ranks, too. */
double partition_imbalance(const uint64_t *load, uint32_t n, int size);

#endif
