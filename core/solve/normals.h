/* normals.h - the normals of the surfaces of solids (scheme/normal.h) that a run begins with: stages make later
 * ones. */
#ifndef NORMALS_H
#define NORMALS_H

#include "solve/state.h"

/* Makes them from the painted fractions of all levels; primitives follow. Nothing in scenes without normals.
 * Collective. */
int normals_begin(struct state *state);

#endif
