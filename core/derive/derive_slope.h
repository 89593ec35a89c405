/* derive_slope.h - derived fields that are made of gradients: vorticity, schlieren, energy of surfaces. */
#ifndef DERIVE_SLOPE_H
#define DERIVE_SLOPE_H

#include "derive/derive_view.h"
#include "scheme/frame.h"

/* Primitives of a piece of the tile and of the layers of neighbours, as the sweeps see them; boundaries that refer to
 * the start copy. */
void derive_slope_gather(const struct derive_view *tile, const struct frame *frame, size_t pitch, double *w);

/* d/dx along an axis of n rows [n_cell], each of a primitive or of the density of the mixture: central differences. */
enum { DERIVE_SLOPE_RHO = -1 };
void derive_slope_rows(const struct derive_view *tile, int axis, unsigned n, const int *q, double *const *grad);

/* curl u [1/s], three components; in axisymmetric scenes the axes are (r, z) and the only component points along
 * theta, which is minus the third direction of the right-handed (r, z, -theta). */
void derive_slope_vorticity(const struct derive_view *tile, double *out);

/* Energy of the surfaces in a cell per volume, sum sigma |alpha_b grad alpha_a - alpha_a grad alpha_b| over the pairs
 * with surface tension [J/m3]: its integral is sigma times their area. */
void derive_slope_surface(const struct derive_view *tile, double *out);

/* exp(-k |grad rho| / max |grad rho|), k = 200 (model.md 9); the largest gradient is field->scale. */
void derive_slope_schlieren(const struct derive_view *tile, double *out);

/* Raises *scale to the largest density gradient in the leaves of a tile; `gradient` is work space [n]. */
void derive_slope_steepest(const struct derive_view *tile, double *gradient, double *scale);

/* Brings the neighbours' layers of level `base` and finer ones up to date: after a step they still hold the midpoint.
 * What lies behind the edges of level `base` itself is left as it is: in the middle of a coarser step it belongs to the
 * solver. Collective. */
void derive_slope_exchange(const struct model *model, const struct mesh *mesh, int base, double t);

#endif
