/* closure.h - Kapila's closure: compression moves the fractions so that the materials of a cell keep one pressure.
 *
 * d alpha_l/dt += K_l div u, K_l = alpha_l (rho c_w^2/(rho_l c_l^2) - 1) (model.md 2), explicit, and the volume that
 * exchange.h asks for. Neither may push a fraction below CLOSURE_LEAST or CLOSURE_SHRINK of what transport left, nor
 * a material whose law stiffens (phys/model.h) above CLOSURE_DENSE times the greatest density that the law states. */
#ifndef CLOSURE_H
#define CLOSURE_H

#include "scheme/term.h"

#define CLOSURE_LEAST 1e-9
#define CLOSURE_SHRINK 0.25
#define CLOSURE_DENSE 4.0
#define CLOSURE_TRACE 1e-6 /* volume that is cut off counts as clipped from here on */

/* Fills tile->K and tile->rho_c2. */
extern const struct term closure_term;

/* Has the path Kapila's closure? */
bool closure_wanted(const struct model *path);

#endif
