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

/* A growing list of Morton keys of tiles of one level. */
struct nest_keys {
    unsigned n, room;
    uint64_t *keys;
};

/* A piece of a set, or all of it. */
struct nest_set {
    unsigned n;
    struct tile *tiles; /* sorted; rank not set; `unwanted` counted on */
};

/* Adds the octants (tiles of the next level) within `buffer` cells of the tagged cells (mark != 0) of a tile. */
void nest_wish(const struct mesh *mesh, const struct level *level, const struct tile *tile, const double *marks,
               int buffer, struct nest_keys *keys);

/* Takes keys of level l to the ranks that answer for them: what is left here is what all ranks have brought to this
 * one, sorted and without repetition. Collective. */
void nest_join(const struct mesh *mesh, int l, struct nest_keys *keys);

/* This rank's pieces of the new sets of levels base + 1 .. most_level, ret_sets[l] for level l from the joined keys
 * wishes[l]; they are the caller's (nest_free_set). Collective. */
void nest_sets(const struct mesh *mesh, int base, const struct nest_keys *wishes, int patience,
               struct nest_set *ret_sets);

/* All pieces of a set, in place of this rank's. Collective. */
void nest_whole(struct nest_set *set);

/* What travels for that, two words per family: its key (that of the tile below); which octants are there (8 bits) and
 * their counts (7 bits each: more than any patience). */
enum { NEST_UNWANTED = 127 };
struct nest_keys nest_pack(const struct nest_set *set);
struct nest_set nest_unpack(const struct nest_keys *words);

/* All tiles of level l as they are, with their counts, which only owners keep. Collective. */
struct nest_set nest_of(const struct mesh *mesh, int l);

/* Is the piece `set` what this rank's piece of level l already is (keys; not owners)? */
bool nest_same(const struct mesh *mesh, int l, const struct nest_set *set);

/* Do all levels nest, are they sorted, and in the domain, and does level 0 cover it? STATUS_RUN with the offending
 * tile; always checked. Each rank checks its own tiles, and what all need of them. Collective. */
int nest_check(const struct mesh *mesh);

struct nest_families;

/* What a rank does with what is asked of its piece of level l, without messages. The new piece, from what is used: */
struct nest_set nest_piece(const struct mesh *mesh, int l, struct nest_families *used, int patience);

/* Is a tile of the piece needed that is not there? */
bool nest_lacks(const struct mesh *mesh, int l, struct nest_families *needs, uint64_t *ret_missing);

/* Tile coordinates of a key. */
void nest_at(uint64_t key, int ret_at[3]);

void nest_free_keys(struct nest_keys *keys);
void nest_free_set(struct nest_set *set);

#endif
