/* fraction.h - volume fractions: they move with the flow, and they sum to 1.
 *
 * d alpha_l/dt = -div(alpha_l u) + alpha_l div u is transport (model.md 2); what compression does to fractions is the
 * closure's (closure.h). Transport keeps them in [0, 1]; limited and bounded fractions need not sum to 1, so the last
 * step of all is to divide by the sum. */
#ifndef FRACTION_H
#define FRACTION_H

#include "scheme/term.h"

extern const struct term fraction_term; /* transport */
extern const struct term fraction_sum;  /* sum to 1; acts after everything that changes fractions */

#endif
