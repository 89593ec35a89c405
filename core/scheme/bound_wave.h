/* bound_wave.h - simple waves of a mixture at a point, and what strong ones do to pressure and velocity.
 *
 * In a wave that runs one way du = +-dp/Z, Z = rho c, along the isentrope. With K = rho c^2 linear in p, exact for
 * stiffened gases, U = int dp/Z has a closed form (Riemann 1860). A mixture of one pressure is no such law: a little
 * air makes water soft at 1 bar and not at 10. There K_l of each material is linear, its volume falls as K_l to the
 * power -1/gamma_l, and U is summed over five points (Gauss) between the pressures, in the logarithm of the softest
 * K_l. Where a gas of the mixture would have nothing left (liquid with a trace of air under tension) the mixture is
 * taken for one law. */
#ifndef BOUND_WAVE_H
#define BOUND_WAVE_H

#include "case/scene.h"

struct bound_wave {
    double Z, K, gamma; /* of the mixture [Pa s/m, Pa, 1]: K grows by gamma dp */
    unsigned n;         /* of the materials below; 0: the mixture is like one of them */
    double rho, rest;   /* of the mixture [kg/m3]; what elasticity adds to its K [Pa] */
    double share[SCENE_MATERIALS], part_K[SCENE_MATERIALS],
        part_gamma[SCENE_MATERIALS]; /* volume fractions; as above */
};

/* U over a step of pressure [m/s], and the step [Pa] over which U is du: u + U and u - U stay in waves to either side.
 * NAN: beyond vacuum. */
double bound_wave_reach(const struct bound_wave *wave, double dp);
double bound_wave_push(const struct bound_wave *wave, double du);

/* The ratio of densities over a step x = dp/K in which K becomes K (1 + y). */
double bound_wave_ratio(double x, double y);

#endif
