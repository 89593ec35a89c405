/* lag.h - the pressures that materials have in an interface travel with their volume.
 *
 * Surface tension gives the materials of a mixed cell pressures p_l = p + lag_l (phys/traction.h). At a
 * face these are those with the fractions between its two cells (face_work.lag, which tension.c adds to), whatever
 * limiters make of fractions at the edges, and volume that goes through takes them along: sum_l alpha_l* u* (p* +
 * lag_l) in the flux of energy, alpha_l* u* (p + lag_l) in what the exchange compares with the pressures of the cell
 * (exchange.h). So an interface that moves in a uniform flow keeps the pressures of its materials. */
#ifndef LAG_H
#define LAG_H

#include "scheme/term.h"

extern const struct term lag_term;

#endif
