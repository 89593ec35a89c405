/* derive_curvature.h - curvature of the surface of a material, as surface tension will need it. */
#ifndef DERIVE_CURVATURE_H
#define DERIVE_CURVATURE_H

#include "derive/derive_view.h"

/* kappa = -div n [1/m], n = grad psi / |grad psi| at the corners of cells, psi = a^m / (a^m + (1 - a)^m), m = 0.1:
 * nearly straight across a front, so that differences see it well (Shukla 2014, J. Comput. Phys. 276, 508). a is the
 * material's fraction, averaged to corners and back to cells (1-2-1 along each axis), which fronts of one or two
 * cells need. Positive for a drop or bubble of the material: 1/R in a plane, 2/R for a sphere. 0 where this a is
 * below 0.01 or above 0.99, and where psi is flat. */
void derive_curvature(const struct derive_view *tile, double *out);

/* Brings what lies around the tiles up to date, for derive_curvature. Collective. */
void derive_curvature_exchange(const struct model *model, const struct mesh *mesh);

#endif
