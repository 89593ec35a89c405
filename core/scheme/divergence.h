/* divergence.h - from the fluxes of a piece to the rates of its cells.
 *
 * Geometry enters here alone (model.md 4): exact areas and volumes of metric.h; the radial momentum sees p relative to
 * the cell's own pressure, so that the hoop term beta p / r is balanced and a state at rest stays at rest to
 * round-off. Momentum around the axis has areas and volumes with its lever, so that -rho u_r u_th / r needs no source.
 */
#ifndef DIVERGENCE_H
#define DIVERGENCE_H

#include "scheme/term.h"

/* Adds what the fluxes of tile->terms across the piece's axis change per second. */
void divergence_add(const struct term_tile *tile, const struct frame *frame);

#endif
