/* unmixed.h - a liquid that touches its vapour (or the gases that take it up) in no cell: the surface lies on faces of
 * cells, and exchange of mass, an operator in cells (phys/phase.h), has nothing to act on until something moves it.
 *
 * Where heat or vapour is carried to the surface (conduction, diffusion of gases) the state is painted again with
 * surfaces that reach a trace into the cells on both sides (paint/paint.h). Elsewhere, and where a script paints cells
 * of one material alone, the run says so (run/unmixed_say.h). */
#ifndef UNMIXED_H
#define UNMIXED_H

#include "solve/state.h"

/* Has pair k of the scene, which exchanges mass at interfaces only, no cell that holds both sides, while both are
 * there? Collective. */
bool unmixed_is(const struct state *state, unsigned k);

#endif
