/* phase.h - a liquid and its vapour exchange mass in the cells of a tile: which cells act, and what becomes of them.
 *
 * What changes are the masses of liquid and vapour and the fractions of the cell; the sum of both masses, all other
 * masses, momentum and total energy stay, so the pressure follows from the closure as always and is that of the
 * equilibrium (equilibrium.h). A cell acts where liquid and vapour (or a gas of the family) both have more than
 * 1e-6 (PHASE_PAIR_FELT) of it; with `where: everywhere` also liquid alone, once it is beyond what it bears. A cell
 * that fits already keeps its bits. */
#ifndef PHASE_H
#define PHASE_H

#include "phys/equilibrium.h"

/* Family k of the model on n cells, components of u and w at q * stride: what the state has come to after dt, in cells
 * of size h [m] (of the largest side). w holds pressures from which to start, and gets those of cells that changed.
 * shore[n]: 1 where liquid evaporates although vapour fills less than the pair's `onset` (scheme/shore.h); NULL:
 * nowhere. STATUS_OK, or why a script gave no rate.
 */
int phase_act(const struct model *model, unsigned k, size_t n, size_t stride, double dt, double h,
              const unsigned char *shore, double *w, double *u, struct equilibrium_effort *effort);

#endif
