/* nest.h - from cells that want refinement to tile sets that nest.
 *
 * Tags of level l ask for tiles of level l + 1: every octant within `buffer` cells of a tagged cell. A tile is
 * made at once and removed when it has been unwanted in `patience` successive regrids. Sets are made from the
 * finest level down, so that each level also holds what the finer one needs to nest (mesh.h); what could not nest
 * in the fixed level `base` is left out. All of it is integer arithmetic on replicated lists: equal on all ranks
 * for any number of them. */
#ifndef NEST_H
#define NEST_H

#include "mesh/mesh.h"

/* A growing list of Morton keys of tiles of one level. */
struct nest_keys {
    unsigned n, room;
    uint64_t *keys;
};

struct nest_set {
    unsigned n;
    struct tile *tiles; /* sorted; rank not set; `unwanted` counted on */
};

/* Adds the octants (tiles of the next level) within `buffer` cells of the tagged cells (mark != 0) of a tile. */
void nest_wish(const struct mesh *mesh, const struct level *level, const struct tile *tile, const double *marks,
               int buffer, struct nest_keys *keys);

/* Joins the keys of all ranks, sorted and without repetition. Collective. */
void nest_join(struct nest_keys *keys);

/* The new sets of levels base + 1 .. most_level, ret_sets[l] for level l from the joined keys wishes[l]; they are the
 * caller's (nest_free_set, or their tiles handed to mesh_replace). */
void nest_sets(const struct mesh *mesh, int base, const struct nest_keys *wishes, int patience,
               struct nest_set *ret_sets);

/* Is `set` what level l already is (keys; not owners)? */
bool nest_same(const struct mesh *mesh, int l, const struct nest_set *set);

/* Do all levels nest, are they sorted, and in the domain, and does level 0 cover it? STATUS_RUN with the offending
 * tile; always checked. */
int nest_check(const struct mesh *mesh);

/* Tile coordinates of a key. */
void nest_at(uint64_t key, int ret_at[3]);

void nest_free_keys(struct nest_keys *keys);
void nest_free_set(struct nest_set *set);

#endif
