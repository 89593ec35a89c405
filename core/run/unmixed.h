/* unmixed.h - what a run says of a liquid that touches its vapour (or the gases that take it up) in no cell at the
 * start: the surface then lies on faces of cells, and exchange of mass, an operator in cells (phys/phase.h), has
 * nothing to act on until something moves it. */
#ifndef UNMIXED_H
#define UNMIXED_H

#include "solve/state.h"

/* A warning for each pair that exchanges mass at interfaces only, of which no cell holds both sides while both are
 * there. Collective. */
void unmixed_say(const struct state *state);

#endif
