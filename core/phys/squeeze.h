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

#endif
