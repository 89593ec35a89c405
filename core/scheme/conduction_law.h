/* conduction_law.h - what conduction asks the laws of a material: k, and the heat that it holds. */
#ifndef CONDUCTION_LAW_H
#define CONDUCTION_LAW_H

#include "phys/model.h"
#include "scheme/swell.h"

enum { CONDUCTION_LAW_BATCH = SWELL_BATCH };

/* Does material l of a path conduct? */
static inline bool conduction_law_is(const struct model *path, unsigned l)
{
    return path->conductivity[l].law != NULL;
}

/* k of n states of material l, which conducts [W/(m K)]. */
void conduction_law_ask(const struct model *path, unsigned l, size_t n, const double *T, const double *p,
                        const double *rho, double *k);

/* Temperature [K] and rho cv [J/(m3 K)] of n <= CONDUCTION_LAW_BATCH states of an equation of state: a quotient of
 * differences over 1e-4 rho c^2 in pressure, at least DBL_MIN. */
void conduction_law_capacity(const struct model_eos *eos, size_t n, const double *rho, const double *p, double *T,
                             double *c);

#endif
