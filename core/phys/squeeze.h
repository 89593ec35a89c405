/* squeeze.h - one material brought to another pressure without heat, doing work against that pressure:
 *     e(v, p) + p v = e0 + p v0
 * (Saurel, Petitpas & Berry 2009, J. Comput. Phys. 228, 1678, eq. 31). For small changes it is the isentrope. */
#ifndef SQUEEZE_H
#define SQUEEZE_H

#include "phys/model.h"

/* rho e at (rho, p) [J/m3] and, at constant p, its slope over rho [J/kg]. */
double squeeze_energy(const struct model_eos *eos, double rho, double p, double *ret_slope);

/* v(p) from v0 and e0 [m3/kg, J/kg]. */
double squeeze_volume(const struct model_eos *eos, double v0, double e0, double p);

/* dv/dp at such a v(p) [m3/kg/Pa], negative. */
double squeeze_slope(const struct model_eos *eos, double v0, double v, double p);

/* v(p) of a solid that shares the traction -p with others and keeps its stretch: it does work against p, and its own
 * pressure is p + s'_nn, s'_nn = own v0/v (traction.h):
 *     e(v, p + own v0/v) + p v = e0 + p v0
 * What its deviator takes of the work, s'_nn dv, of second order, so is its own heat. own: s'_nn at v0 [Pa], far below
 * rho c^2; 0: squeeze_volume() to the bit. *ret_slope: dv/dp. */
double squeeze_solid(const struct model_eos *eos, double v0, double e0, double own, double p, double *ret_slope);

#endif
