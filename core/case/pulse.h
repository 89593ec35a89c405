/* pulse.h - the gauge pressure of an incoming wave at a boundary. */
#ifndef PULSE_H
#define PULSE_H

#include "case/scene.h"

/* Gauge pressure [Pa] of the boundary's pulse at the time t [s] and the place x, counted from boundary->delay and
 * from when its beam comes there.
 * Before that, and outside of a series, it is 0. With compressive_only what is not above 0 is 0, and so is all that
 * follows the first zero after the pulse has begun (a Lua pulse: only the first). STATUS_CASE: the script failed. */
int pulse_pressure(const struct scene_boundary *boundary, double t, const double x[SCENE_AXES], double *ret_pressure);

/* What enters across the face at `axis`, `side` [Pa]: half of p' + Z u' of the wave, u' along the inward normal. p'
 * along the normal; under an angle less (beam.h); near a focus, at the distance r, Z u' lags behind p' by c/r times the
 * impulse of p'. STATUS_CASE: the script failed. */
int pulse_entering(const struct scene_boundary *boundary, double t, const double x[SCENE_AXES], int axis, int side,
                   double *ret_pressure);

/* Sums a pulse up to the time `until`, for the impulse near a focus. Scripts are not summed: their waves have no
 * lag. */
void pulse_sum(struct scene_boundary *boundary, double until);

#endif
