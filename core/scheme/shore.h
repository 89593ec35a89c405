/* shore.h - the last cells of a liquid before its vapour, for pairs with an `onset` (phys/phase.h).
 *
 * On a mesh the surface is smeared over some cells, and evaporation makes volume. Where it makes it, the velocity
 * rises, and what lies behind stays where it is: liquid that it leaves behind is lost to the surface. So what is hot
 * evaporates at the end of the smear alone, and which cell that is only its neighbours tell. A cell is at the shore if
 * one beside it (across a face) is dry, which is that vapour and gases fill `onset` of it, or if it is beyond the
 * surface of heat (phase_pair_front) and none beside it has more of them: a bubble too small to have a dry cell. Told
 * by the primitives at which the rates of a stage are taken. */
#ifndef SHORE_H
#define SHORE_H

#include "mesh/metric.h"
#include "phys/model.h"

/* How many marks a tile has: one per cell and pair of the scene; 0 if no pair has an `onset`. */
size_t shore_marks(const struct model *model, const struct mesh *mesh);

/* How many doubles shore_look needs to work with; 0 likewise. */
size_t shore_room(const struct model *model, const struct mesh *mesh);

/* Marks the cells of a tile: 1 at the shore of pair k of its path, 0 elsewhere, at ret_shore[k * n_cell]. around: as
 * term_tile.around says; room: shore_room() doubles, overwritten. */
void shore_look(const struct model *path, const struct mesh *mesh, const double *around, double *room,
                unsigned char *ret_shore);

#endif
