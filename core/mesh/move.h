/* move.h - the blocks of a level when its list of tiles changes. Used by core/mesh alone. */
#ifndef MOVE_H
#define MOVE_H

#include "mesh/mesh.h"

/* Replaces the arrays u_old, u_new, w and kept of a level, which still has its old list, by those for the sorted list
 * `tiles`; see mesh_replace. The level's list is not touched. Collective. */
void move_blocks(struct mesh *mesh, int l, const struct mesh_set *set, struct mesh_change *ret_change);

#endif
