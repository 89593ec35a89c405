/* doze.h - which hidden tiles sleep: those whose averages nobody looks at after each step of their level.
 *
 * A hidden tile is not advanced; but tiles beside it that are advanced read its cells. Where all around it, across
 * edges and corners too, are hidden, it is the averages over its own octant of the next coarser tile alone that need
 * what is in it. These are made after steps of that tile's level, half as many; if that tile sleeps, too, after steps
 * of a level further down. So a tile sleeps one level deeper than the one below it. What nothing below asks for (all
 * of level 0 around it is hidden) is asked for by regrids, checkpoints and their like alone (solve/wake.h).
 *
 * What ranks know alone they tell those who need it: who has a wholly covered tile whether it is hidden, to the owners
 * of such tiles around it; and how deep it sleeps, to the owners of the tiles that cover it. Both ends know which tiles
 * these are, so there is no handshake. */
#ifndef DOZE_H
#define DOZE_H

#include "mesh/mesh.h"

/* Sets `sleeps` of the own tiles of level l, and of the tiles of level l - 1 that lie under them, after that level had
 * its turn. `covered` and `hidden` are set (level_cover). Collective. */
void doze_level(struct mesh *mesh, int l);

#endif
