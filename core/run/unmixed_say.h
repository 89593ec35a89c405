/* unmixed_say.h - what a run says of a surface that nothing can start (solve/unmixed.h). */
#ifndef UNMIXED_SAY_H
#define UNMIXED_SAY_H

#include "solve/state.h"

/* A warning for each pair of which no cell holds both sides. Collective. */
void unmixed_say(const struct state *state);

#endif
