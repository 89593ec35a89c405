/* derive_curvature.h - curvature of the surface of a material, as surface tension will need it. */
#ifndef DERIVE_CURVATURE_H
#define DERIVE_CURVATURE_H

#include "derive/derive_view.h"

/* kappa [1/m] as scheme/curvature.h makes it, with the averaged fraction a of the material and 1 - a of all others.
 * Positive for a drop or bubble of the material: 1/R in a plane, 2/R for a sphere. 0 where this a is below 0.01 or
 * above 0.99, and where psi is flat. */
void derive_curvature(const struct derive_view *tile, double *out);

/* Brings what lies around the tiles up to date, for derive_curvature. Collective. */
void derive_curvature_exchange(const struct model *model, const struct mesh *mesh);

#endif
