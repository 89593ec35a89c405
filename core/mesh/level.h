/* level.h - what follows from the list of tiles of a level that a rank knows: who finds a tile, who neighbours whom,
 * what finer tiles cover. Nothing here is collective. Used by core/mesh alone. */
#ifndef LEVEL_H
#define LEVEL_H

#include "mesh/mesh.h"

/* The local piece of a list of tiles whose ranks ascend. */
void level_local(const struct tile *tiles, unsigned n_tile, unsigned *ret_first, unsigned *ret_n_local);

/* Gives the level its list (taken over, the old one is freed; ranks are set) and makes the table that level_find looks
 * in. */
void level_adopt(struct level *level, struct tile *tiles, unsigned n_known);

/* Frees list, table and neighbours, not the blocks. */
void level_drop(struct level *level);

/* The tile with a key, if it is known, or -1. */
int level_find(const struct level *level, uint64_t key);

/* Tile coordinates behind a face, wrapped on periodic axes; false outside the domain. */
bool level_step(const struct mesh *mesh, const struct level *level, const struct tile *tile, int face, int ret_at[3]);

/* The tile behind a face of an own tile, or -1. */
int level_behind(const struct mesh *mesh, const struct level *level, const struct tile *tile, int face);

/* Makes the neighbours of the local tiles anew. */
void level_connect(const struct mesh *mesh, struct level *level);

/* The known tiles around an own one, across edges and corners too, indices in the list; returns how many. *ret_all: are
 * there tiles at all places around it that lie in the domain? */
int level_around(const struct mesh *mesh, const struct level *level, const struct tile *tile,
                 unsigned ret_tiles[static 26], bool *ret_all);

/* Bits of all octants of a tile. */
unsigned char level_whole(const struct mesh *mesh);

/* Sets `covered` of the tiles of level l, and `hidden` of the local ones, from that of level l + 1. */
void level_cover(struct mesh *mesh, int l);

/* Its parts, and that of level_adopt, which the partition study takes the time of: `covered`, `hidden`, the table. */
void level_mark(struct mesh *mesh, int l);
void level_hide(struct mesh *mesh, int l);
void level_tabulate(struct level *level);

#endif
