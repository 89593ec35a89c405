/* spread_bear.h - how much of a change of all conserved fields one cell can bear.
 *
 * Masses and total energy above zero are not enough: in cold fast gas nearly all energy is that of motion, and half of
 * what there is, handed on as energy without the momentum that goes with it, leaves a negative pressure. A cell bears a
 * state as the guard means it (docs/numerics.md 8): speeds of sound squared are positive, those of the mixture and of
 * each material that is present. */
#ifndef SPREAD_BEAR_H
#define SPREAD_BEAR_H

#include "phys/model.h"

#include <stddef.h>

/* Part of `most` that the cell takes of change[n] (its first n fields): `most` if it bears that, else half of the
 * largest part that it bears. Field q of the cell is u[q * stride] + delta[q * stride]; what it is given is factor *
 * change. 0 where it bears nothing, not even what it has. */
double spread_bear(const struct model *model, size_t stride, const double *u, const double *delta, unsigned n,
                   double factor, const double *change, double most);

#endif
