/* rebuild.h - from an open checkpoint to a state in memory. */
#ifndef REBUILD_H
#define REBUILD_H

#include "io/resume.h"
#include "solve/state.h"

/* The state that was saved, with its counts, for a scene that has enough in common with it (facts.h); levels that
 * the scene no longer allows are left out. What the file says is checked against the scene and itself. STATUS_CASE
 * with one line that says what is wrong. Collective. */
int rebuild_state(const struct resume *resume, const struct scene *scene, struct state **ret_state);

#endif
