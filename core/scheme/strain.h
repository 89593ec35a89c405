/* strain.h - the stretches of solids: each travels with the mass of its own and follows the velocity gradient
 * (phys/elastic.h). */
#ifndef STRAIN_H
#define STRAIN_H

#include "scheme/term.h"

/* Owns n_velocity * dim rows, -d_k u*_i at i * dim + k, and in mixtures dim more for each solid: -d_k of its fraction.
 * Acts when masses and fractions of the new state stand. */
extern const struct term strain_term;

/* Stretch k of a tile (model_stretches()) from V_old, [n_stretch][n_cell], into the new state: moved with the mass of
 * the solid that carries it, faded where there is little of them, unimodular. For terms behind this one in the list. */
void strain_move(const struct term_tile *tile, unsigned k, double relaxes, const double *V_old, double *u_new);

/* Lists the fluxes of stretch k; stretch: of the faces (face.h), or NULL. Likewise for other terms. */
void strain_carry(struct terms *terms, int axis, unsigned k, const double *stretch);

#endif
