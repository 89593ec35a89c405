/* deal.h - who gets which tiles of the levels that are made anew: all ranks tell rank 0 what their pieces cost, in runs
 * of equal cost, it cuts all levels and tells where. Nobody else holds costs of others. */
#ifndef DEAL_H
#define DEAL_H

#include "mesh/partition.h"

/* Tiles of a level in a row that cost the same. */
struct deal_run {
    uint32_t n;
    uint16_t level, cost;
};

struct deal {
    int base;      /* the levels above it are cut */
    bool subcycle; /* each level takes twice the steps of the one below */
    int n_level;   /* that have been added */
    uint64_t load; /* of this rank's tiles up to `base`, per coarse step */
    unsigned n, room;
    struct deal_run *runs; /* this rank's, levels ascending */
    uint32_t *first;       /* [n_level][ranks + 1] once it is cut: see partition_cut */
    bool root;             /* level 0 is to have other owners, too: those it has share the work badly */
};

/* Adds this rank's tiles of a level, levels ascending (every rank adds the same levels); cost[n]: 1 is a tile of one
 * material. */
void deal_add(struct deal *deal, int l, const double *cost, unsigned n);

/* Cuts. Collective. */
void deal_cut(struct deal *deal);

/* The table of a level: rank r gets the tiles [r] .. [r + 1] - 1. */
const uint32_t *deal_first(const struct deal *deal, int l);

/* What rank 0 does, for `size` ranks: `runs` of all, in their order; load[size]: of all, as above. Sets deal->first and
 * deal->root. */
void deal_share(struct deal *deal, const struct deal_run *runs, unsigned n, int size, uint64_t *load);

void deal_free(struct deal *deal);

#endif
