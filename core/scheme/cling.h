/* cling.h - solids that meet draw upon each other at once.
 *
 * A mixed cell has one velocity. Where the solids in it come to slide, waves run from the surface between them, and
 * their traction, Z du with an impedance Z and the jump du, acts at once; tractions of the cell (weld.h) need time to
 * grow, and overshoot when they have lagged. So faces between cells that hold two solids have besides
 *     tau = 2 eta (D - 1/3 div u),   eta = h rho sum over pairs of C (4 alpha_k alpha_l)^2 c,   C = 0.2,
 * c the slower of the shear speeds of both as long as they are not strained. It is what a jump over some cells draws,
 * and nothing where one solid is alone. Not in curved geometry. docs/decisions/unlike-solids.md. */
#ifndef CLING_H
#define CLING_H

#include "scheme/term.h"

/* Acts on paths with several solids. Owns no rows. */
extern const struct term cling_term;

#endif
