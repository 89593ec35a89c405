/* shelter.h - how far the solids of a cell come to its faces.
 *
 * u* of a face is the velocity of what lies at the face. Where a steep slope of fractions lets the solid of a mixed
 * cell end before the face, that is a gas; the solid is strained by it only as far as it comes there,
 *     u_seen = u_cell + beta (u* - u_cell),   beta = 1 - 2 (1 - alpha at the edge/alpha of the cell) within 0 and 1,
 * fractions those of all solids; so, too, along the face. The trace of what strains it stays that of u*, which the
 * closure counts with (K div u): the rest is a strain along the normal of the surface. Without shelter the stress of
 * the solid moves the gas beside it, which weighs a ten thousandth of it, and comes back a thousand times as large in
 * every step. docs/decisions/oblique-surfaces.md. */
#ifndef SHELTER_H
#define SHELTER_H

#include "scheme/term.h"

/* Owns n_velocity * dim rows where the scene says so: -d_k u_seen,i at i * dim + k. */
extern const struct term shelter_term;

/* Has a path solids that can be sheltered? */
bool shelter_wanted(const struct model *path);

/* Those rows; NULL: the solids see u*. */
const double *shelter_gradient(const struct term_tile *tile);

/* n cells of the rows of both gradients (pitch tile->n_cell): missing: what -tr(grad u_seen) lacks of -tr(grad u*)
 * [1/s]. */
void shelter_missing(const struct term_tile *tile, size_t n, const double *face, const double *seen, double *missing);

#endif
