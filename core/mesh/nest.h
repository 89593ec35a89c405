/* nest.h - from cells that want refinement to tile sets that nest.
 *
 * Tags of level l ask for tiles of level l + 1: every octant within `buffer` cells of a tagged cell. A tile is
 * made at once and removed when it has been unwanted in `patience` successive regrids. Sets are made from the
 * finest level down, so that each level also holds what the finer one needs to nest (mesh.h); what could not nest
 * in the fixed level `base` is left out.
 * Every rank makes the piece of each set that lies in its piece of the curve as it is cut now (mesh/span.h): wishes
 * and needs go to who answers for their keys (nest_share.h). Work and messages of a rank follow what it has, not what
 * all have. All of it is integer arithmetic: the same sets for any number of ranks, cut in any way. */
#ifndef NEST_H
#define NEST_H

#include "mesh/mesh.h"
#include "mesh/nest_keys.h"

/* Adds the octants (tiles of the next level) within `buffer` cells of the tagged cells (mark != 0) of a tile. */
void nest_wish(const struct mesh *mesh, const struct level *level, const struct tile *tile, const double *marks,
               int buffer, struct nest_keys *keys);

/* Takes keys of `count` levels from `lowest` on (keys[0] first) to the ranks that answer for them: what is left here is
 * what all ranks have brought to this one, sorted and without repetition. Collective. */
void nest_join(const struct mesh *mesh, int lowest, int count, struct nest_keys *keys);

/* This rank's pieces of the new sets of levels base + 1 .. most_level, ret_sets[l] for level l from the joined keys
 * wishes[l]; they are the caller's (nest_keys_free_set). Collective. */
void nest_sets(const struct mesh *mesh, int base, const struct nest_keys *wishes, int patience,
               struct nest_set *ret_sets);

/* Is the piece `set` what this rank's piece of level l already is (keys; not owners)? */
bool nest_same(const struct mesh *mesh, int l, const struct nest_set *set);

/* Do all levels nest, are they sorted, and in the domain, and does level 0 cover it? STATUS_RUN with the offending
 * tile, the same one for any number of ranks; always checked. Each rank checks its own tiles, and that it knows what
 * they need: a tile that the fringe has not brought is missed, too. Collective, one reduction where all is well. */
int nest_check(const struct mesh *mesh);

struct nest_families;

/* What a rank does with what is asked of its piece of level l, without messages. The new piece, from what is used: */
struct nest_set nest_piece(const struct mesh *mesh, int l, struct nest_families *used, int patience);

/* Does its piece of level l need a tile of level l - 1 that it does not know? Then *ret_missing is the first. */
bool nest_lacks(const struct mesh *mesh, int l, uint64_t *ret_missing);

#endif
