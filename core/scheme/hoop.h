/* hoop.h - what stands against p / r in curved geometry: the value that the radial momentum is taken relative to.
 *
 * In a cell of an axisymmetric or spherical mesh the walls along theta push outwards with beta -s_thth / r (model.md
 * 4). Taken with the face areas this is the divergence of the momentum flux relative to -s_thth of the cell: p in a
 * fluid, p - s'_zz with a solid. What turns around the axis with u_th needs rho u_th^2 / r inwards: p + rho u_th^2, and
 * slopes of the pressure that know it, as they know gravity (face_work.rise). */
#ifndef HOOP_H
#define HOOP_H

#include "scheme/term.h"

extern const struct term hoop_term;

#endif
