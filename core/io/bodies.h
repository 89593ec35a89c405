/* bodies.h - columns of the history that tell of rigid bodies: what fluids do to them, and where they are. */
#ifndef BODIES_H
#define BODIES_H

#include "solve/state.h"

/* Force along an axis, or power, of the fluids in a tile of level l on the body of a column [N, W; per metre in 2D, per
 * m2 in 1D]. */
double bodies_load(const struct state *state, int l, unsigned local, const struct scene_column *column, int axis);

/* How far the body of a column has moved along an axis [m], its velocity [m/s], its angle [rad]; NaN where its script
 * has failed. */
double bodies_motion(const struct state *state, const struct scene_column *column, int axis);

#endif
