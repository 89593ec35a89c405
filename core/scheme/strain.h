/* strain.h - the stretch of solids: it travels with their mass and follows the velocity gradient (phys/elastic.h). */
#ifndef STRAIN_H
#define STRAIN_H

#include "scheme/term.h"

/* Owns n_velocity * dim rows, -d_k u*_i at i * dim + k, and in mixtures dim more: -d_k of the fraction of all solids. Acts when
 * masses and fractions of the new state stand. */
extern const struct term strain_term;

/* Stretch k of a tile (model_stretches()) from V_old, [n_stretch][n_cell], into the new state: moved with the mass of the
 * solids that carry it, faded where there is little of them, unimodular. For terms behind this one in the list. */
void strain_move(const struct term_tile *tile, unsigned k, const double *V_old, double *u_new);

#endif
