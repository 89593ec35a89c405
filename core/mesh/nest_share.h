/* nest_share.h - what making tile sets asks of other ranks: each answers for the keys in its piece of
 * the curve (mesh/span.h), one message per pair of ranks that have something for each other. Used by nest.c; the
 * lists of what goes where are pure functions of a rank's tiles, so that the partition study counts with them. */
#ifndef NEST_SHARE_H
#define NEST_SHARE_H

#include "mesh/nest_family.h"
#include "mesh/nest_keys.h"
#include "mesh/span.h"

/* Sends sorted keys of `count` levels from `lowest` on to those who answer for them and leaves what has come for this
 * rank: false if that is still sorted. Collective. */
bool nest_share_keys(const struct mesh *mesh, int lowest, int count, struct nest_keys *keys);

/* Adds what the tiles of level l of all ranks, of which `set` is this rank's piece, need of level l - 1 in this rank's
 * piece of that. Collective. */
void nest_share_needs(const struct mesh *mesh, int l, const struct nest_set *set, struct nest_families *families);

/* Of the 3^d tiles around each of `places` (sorted keys of level l), which exist or lie outside the domain: new
 * array (mem_free); 0 where the place itself is no tile. Collective. */
uint32_t *nest_share_around(const struct mesh *mesh, int l, const struct nest_keys *places);

/* Families (sorted) for their owners, those across a cut for several: a new list, with the ranks ret_to[n]
 * (mem_free). */
struct nest_families nest_share_deal(const struct span *span, const struct nest_families *needs, int **ret_to);

/* Adds what lies in a rank's piece of n families that have come for it. */
void nest_share_take(const struct span *span, int rank, const struct nest_family *list, unsigned n,
                     struct nest_families *families);

#endif
