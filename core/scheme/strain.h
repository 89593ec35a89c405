/* strain.h - the stretch of solids: it travels with their mass and follows the velocity gradient (phys/elastic.h). */
#ifndef STRAIN_H
#define STRAIN_H

#include "scheme/term.h"

/* Owns n_velocity * dim rows, -d_k u*_i at i * dim + k, and in mixtures dim more: -d_k of the fraction of all solids. Acts when
 * masses and fractions of the new state stand. */
extern const struct term strain_term;

#endif
