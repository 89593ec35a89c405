/* bound_ahead.h - what stands behind boundaries that bring states of their own, as rows of cells: for the time step,
 * which must know of a jet before it is in any cell. */
#ifndef BOUND_AHEAD_H
#define BOUND_AHEAD_H

#include "scheme/bound.h"

/* Has this face of a local tile (2 * axis + side) such a boundary? */
bool bound_ahead_is(const struct bound *bound, unsigned local, int face);

/* Primitives in the layer behind a side of a piece of a local tile, at bound->t: [n_field][outer * inner] into `row`,
 * one after the other. `w`: the tile's primitives; `space`: [n_field] components with this pitch. Where a script fails
 * there is NaN, and nothing is said: the stage that asks it again will do so. */
void bound_ahead_row(struct bound *bound, unsigned local, const struct frame *frame, int side, const double *w,
                     size_t pitch, double *space, double *row);

#endif
