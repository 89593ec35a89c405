/* prolong.h - from a level to the next finer one: ghosts, and the first states of new tiles.
 *
 * Ghosts need not be conservative (refluxing is): primitives, c +- s/4 per axis with minmod slopes s of
 * the coarse cell, so that bounds, positivity and uniform p and u survive for every law (design notes:
 * docs/decisions). Between the beginning and the end of the coarse step they are linear in time.
 * New tiles must be conservative: central slopes of the conserved fields about the centroid of the volume, times one
 * factor phi in [0, 1] per coarse cell for all fields, so that every field, every rho_l and p stay
 * within the range of the coarse cell and its face neighbours, and every child is admissible (levels/prolong_cell.h).
 * phi is common to all fields because only then linear relations (sum alpha = 1, rho E at uniform p and u) survive.
 * Both interpolate the components of the stretch and make them a stretch again (elastic_settle); masses, momentum and
 * energy of children stay what they are, so that their pressure takes up what elastic energy is not linear.
 *
 * This folder, levels: what passes between two levels: ghosts, first states, averages, refluxing, and what of it
 * cells cannot bear. */
#ifndef PROLONG_H
#define PROLONG_H

#include "mesh/link.h"
#include "phys/model.h"
#include "scheme/bound.h"

struct prolong;

struct prolong *prolong_new(const struct model *model, const struct mesh *mesh);
void prolong_free(struct prolong *prolong);

/* Writes the strips `slot` (0: beginning, 1: end of the step) of all sources of the link between levels l and
 * l + 1, from the primitives of level l (its halo exchanged and finished). `bound`: of level l, its time set.
 * Not collective; link_down sends them. */
void prolong_strips(struct prolong *prolong, const struct mesh *mesh, int l, struct bound *bound, int slot);

/* Fills u_old, and the pressure in w (where iterated closures start), of the tiles of level l >= 1 that are marked in
 * born[n_known] (of the level), from u_old and w of level l - 1 (halo of w exchanged and
 * finished; `bound` of level l - 1). Returns the number of coarse cells of this rank where phi was below 1.
 * Collective. */
long long prolong_tiles(struct prolong *prolong, struct mesh *mesh, int l, struct bound *bound, const bool *born);

#endif
