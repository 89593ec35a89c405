/* paint_star.h - what two bodies of fluid that meet have between them: the pressure and the velocity of their contact.
 *
 * Each body answers a pressure p with a velocity (Toro 2009, ch. 4): rarefied along its isentrope, compressed along its
 * Hugoniot, as one fluid of frozen fractions, whatever its laws are,
 *     p <= p_0:  du = dp/(rho c), d ln rho = dp/(rho c^2)     p > p_0:  e - e_0 = (p + p_0)/2 (1/rho_0 - 1/rho)
 * and p* is where both have one velocity. */
#ifndef PAINT_STAR_H
#define PAINT_STAR_H

#include "phys/model.h"

#include <stdbool.h>

struct paint_star {
    double p, u; /* u along the normal from the first body to the second */
};

/* w_a, w_b: primitives of the bodies, stride 1; u_a, u_b: their velocities along the normal; near: where p* is looked
 * for first [Pa]. False: no p* is found that both bear. */
bool paint_star_find(const struct model *model, const double *w_a, const double *w_b, double u_a, double u_b,
                     double near, struct paint_star *ret_star);

#endif
