/* fringe.h - which tiles of others a rank knows: those around its own.
 *
 * Of level l these are the tiles within one tile of its own (neighbours, and what covers them or not tells who is
 * hidden); on the next coarser level those that hold the 3^d octants around its own (where ghosts and children come
 * from); on the next finer one the children of its own and of those around them. Their owners send them: the table of
 * first keys (mesh/span.h) says who answers for the places around a tile, so that nobody has to ask, and nobody makes
 * a list of all. A tile is sent to a rank once. Most tiles have nobody else around: the curve grows along every axis,
 * so that two keys tell of a whole box. */
#ifndef FRINGE_H
#define FRINGE_H

#include "base/swap.h"
#include "mesh/mesh.h"

/* A tile of some level for another rank. */
struct fringe_item {
    uint64_t key;
    uint32_t level, born;
};

/* What `rank`, the tiles of which are level->tiles + first, has of level l for others, as struct fringe_item; nothing
 * is sent. In order, ranks ascending, then levels and keys: */
void fringe_list(const struct mesh *mesh, int l, int rank, struct swap_list *fringe);
void fringe_sort(struct swap_list *fringe);

/* The list of level l that `rank` knows then, ret_n tiles (mem_free): its own and those it has got. */
struct tile *fringe_merge(const struct level *level, int l, int rank, const struct swap *got, unsigned *ret_n);

/* Makes the lists of the levels `lowest` to `highest` anew: own tiles (now tiles[first .. first + n_local), whatever
 * else the lists hold), and what others send. `covered` and `hidden` are not set. Collective. */
void fringe_learn(struct mesh *mesh, int lowest, int highest);

#endif
