/* present.h - asks a law only where its material is present.
 *
 * Fractions weigh what a law says; where one is 0 the answer goes nowhere, and a law that needs an iteration costs more
 * than sorting the points. What it says at a point does not depend on the row it stands in (eos.h), so neither does
 * anything here. Laws in closed form are asked at all points: that is cheaper. */
#ifndef PRESENT_H
#define PRESENT_H

#include "phys/model.h"

#include <stddef.h>

/* One material at n points: where alpha is 0 its values are either the law's or 0. alpha NULL: it is alone. */
struct present {
    size_t n;
    const double *alpha, *rho, *p;
};

/* rho e and rho c^2 [J/m3, Pa]. */
void present_state(const struct model_eos *eos, const struct present *points, double *rho_e, double *rho_c2);

/* rho e and d(rho e)/dp [J/m3, 1]. */
void present_energy(const struct model_eos *eos, const struct present *points, double *rho_e, double *de_dp);

#endif
