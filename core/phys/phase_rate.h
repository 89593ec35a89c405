/* phase_rate.h - finite rates of evaporation in one cell, implicit in time: never past equilibrium, whatever dt.
 *
 * Hertz and Knudsen, with the accommodation s of Schrage (1953) and p_eq where mu_v = g_l:
 *     dm_v/dt = A K (p_eq - p_v),  K = 2 s/(2 - s)/sqrt(2 pi R_v T),  p_v = x_v p,  p_eq = p exp(-(g_v - g_l)/(R_v T))
 * [kg/m3/s] so that the rate has the sign of the drive for every law. Or a function of a script. */
#ifndef PHASE_RATE_H
#define PHASE_RATE_H

#include "phys/equilibrium_point.h"

/* m_v after dt from `before`, between it and `after`, the mass of equilibrium: the root of m - before - dt dm_v/dt(m),
 * one p and T inside. The point holds the cell and its guesses; it is changed. *status: STATUS_OK, or why a script gave
 * no rate: then `before`. */
double phase_rate_step(struct equilibrium_point *point, const struct scene_phase *scene, double before, double after,
                       double dt, int *ret_status);

#endif
