/* beam.h - the way of an incoming wave: along the normal of its face, under an angle, or from a transducer to its
 * focus.
 *
 * A plane wave along the unit vector e is f(t - e (x - x0)/c); x0 is met first. A wave to a focus at the distance r is
 * (F/r)^n f(t - (F - r)/c), F the radius of the transducer, where its amplitude is that of the pulse; n = 1 in space
 * (exact for sound), 1/2 in the plane (far from the focus). Only the part of it within the aperture comes in. At a face
 * it brings p' and, with Z = rho c, the velocity u' = e p'/Z, to a focus u' = e (p' - (c/r) int p' dt)/Z, so that the
 * entering invariant of the boundary is p' + Z u' cos, cos between e and the inward normal. */
#ifndef BEAM_H
#define BEAM_H

#include "case/scene.h"

struct beam_ray {
    double later;  /* [s] than at x0, or at the transducer */
    double factor; /* of the pressure */
    double way[3]; /* unit vector of motion */
    double near;   /* [1/s] c/r beside a focus, else 0 */
};

/* At a point of a face. Along the normal only the factor, 1, is set. */
struct beam_ray beam_at(const struct scene_beam *beam, const double x[3]);

#endif
