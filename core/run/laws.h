/* laws.h - what is said about equations of state at the end of a run. */
#ifndef LAWS_H
#define LAWS_H

#include "solve/state.h"

/* What iterated pressures took, and a warning per material whose law was left: how often, and where it ends;
 * likewise of liquids and vapours past the end of their saturation curve.
 * Collective. */
void laws_say(const struct state *state);

#endif
