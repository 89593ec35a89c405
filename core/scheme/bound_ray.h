/* bound_ray.h - what leaves through a non-reflecting boundary from a point, its origin: round waves, under any angle.
 *
 * A wave from a centre is p' = f(t - r/c)/r^q with q = 1 in space (exact for sound), 1/2 in the plane (far from the
 * centre), along the unit vector e = (x - x_0)/r. Momentum gives it the velocity u' = e (p' + q c/r^(q + 1) int f
 * dt)/Z, Z = rho c, primes: less the far field. So p' - Z u'e is not 0 as in plane waves: what the cell inside has of
 * it is the memory of f, and goes on to the layer at r + d by p' - Z u'e = ((p' - Z u'e)_i r + q d p'_i) r^q/(r + d)^(q
 * + 1). Its rate is -q (c/r) p': a pressure that is not the far field's falls off within 2 r/(q c). p' + Z u'e goes on
 * as it comes along the normal, with the lesser of two slopes. Velocities across e stay. (Bayliss & Turkel 1980 have
 * the same condition for the wave equation, of first order in 1/r, exact for one centre.) */
#ifndef BOUND_RAY_H
#define BOUND_RAY_H

#include "phys/model.h"

enum { BOUND_RAY_DEPTHS = 3 }; /* cells inside that slopes are made from */

/* Faces that lie side by side, [n] points; velocities along the axes of the scene. */
struct bound_ray_row {
    const struct scene_beam *from; /* the origin, and q */
    int axis, dim;
    unsigned n_velocity;
    double outward, h, layer; /* 1 or -1; of cells across the face [m]; that is filled, from 0 */
    size_t n;
    const double *x[SCENE_AXES];                 /* centres of the faces [m] */
    const double *Z, *far_p, *far_u[SCENE_AXES]; /* [Pa s/m]; far field */
    const double *p[BOUND_RAY_DEPTHS];           /* inside, from the outermost cell */
    const double *u[BOUND_RAY_DEPTHS][SCENE_AXES];
    const double *c_s;               /* of the outermost cells: where the flow is faster, they stay */
    double *to_p, *to_u[SCENE_AXES]; /* behind; may be those of the outermost cells */
};

/* Pressure and velocity behind the faces. */
void bound_ray_leave(const struct bound_ray_row *row);

/* Velocity alone, as a flow out of the origin goes on that neither pressure nor viscosity changes: along e as 1/r^(2
 * q), from the two cells inside. For viscous stress. A stress that is wrong by d at the face is taken for a wave in
 * every cell that it crosses on its way: what lies inside drifts by some d r/h. */
void bound_ray_flow(const struct bound_ray_row *row);

#endif
