/* adopt.h - a level whose tiles or neighbours have changed: what its stage knows of them is made anew or taken
 * along. */
#ifndef ADOPT_H
#define ADOPT_H

#include "solve/stage.h"

/* After mesh_replace of this level or a neighbour of it: `from` as in mesh_change (NULL: the tiles are the same, only
 * links have changed); `born` (mesh_change, known tiles of the level). Tiles that came from other ranks are counted
 * anew, born ones get their primitives. Not collective. */
void adopt_level(struct stage *stage, const int *from, const bool *born);

/* Takes the boundary references from the present primitives (tests set states by hand). */
void adopt_bounds(struct stage *stage);

#endif
