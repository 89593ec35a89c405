/* beyond.h - how often a run leaves what its laws say, and its liquids and vapours their saturation curve: once per
 * step of level 0, over all leaves. */
#ifndef BEYOND_H
#define BEYOND_H

#include "solve/state.h"

/* Adds the present state to counts.outside and counts.past. Collective; the same on any number of ranks. */
void beyond_count(struct state *state);

#endif
