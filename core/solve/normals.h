/* normals.h - the normals of the surfaces of solids (scheme/normal.h) that a run begins with: stages make later
 * ones. */
#ifndef NORMALS_H
#define NORMALS_H

#include "solve/state.h"

/* Makes them from the painted fractions of all levels; primitives follow. Nothing in scenes without normals.
 * Collective. */
int normals_begin(struct state *state);

/* What verdict_start() before that is to count with: nothing, where there are no normals yet. */
static inline long long *normals_count(struct state *state)
{
    return state->model->n_normal ? NULL : &state->counts.relaxed;
}

#endif
