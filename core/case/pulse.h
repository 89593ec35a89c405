/* pulse.h - the gauge pressure of an incoming wave at a boundary. */
#ifndef PULSE_H
#define PULSE_H

#include "case/scene.h"

/* Gauge pressure [Pa] of the boundary's pulse at the time t [s] and the place x, counted from boundary->delay.
 * Before that, and outside of a series, it is 0. With compressive_only what is not above 0 is 0, and so is all that
 * follows the first zero after the pulse has begun (a Lua pulse: only the first). STATUS_CASE: the script failed. */
int pulse_pressure(const struct scene_boundary *boundary, double t, const double x[SCENE_AXES], double *ret_pressure);

#endif
