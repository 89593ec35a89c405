/* weld.h - where two solids meet they share the shear traction, not the shear.
 *
 * Every solid has a stretch of its own. A mixed cell moves all of them with its one velocity gradient, as if they lay
 * beside each other; but along an interface they lie behind each other: the traction t is common, and the softer one is
 * sheared the more. So after each stage the solids of a cell slide past each other by a_l along the interface of normal
 * n, V_l <- polar((1 + a_l n^T) V_l),   t_l + k_l a_l = t for all,   sum alpha_l a_l = 0, t = sum (alpha_l t_l/k_l)/sum
 * (alpha_l/k_l) with t_l the shear traction of s'_l on n and k_l its stiffness against shear along n, per own volume
 * (neo-Hookean: G n.Bn, exact). The velocity gradient of the cell, their mean, stays. Elastic energy falls, as both lie
 * in one cell; it is heat.
 *
 * They do not get all the way at once: what one solid is sheared by reaches the other with shear waves, of speeds c_l
 * and impedances Z_l = rho_l c_l. In a time dt they go, of the way to one traction, the part
 *     x/(1 + x),   x = dt |grad alpha| sum (0.3 + 0.9 Z_l/sum Z)(c_l^2/alpha_l)/c,   c the slowest of c_l.
 * docs/decisions/unlike-solids.md. */
#ifndef WELD_H
#define WELD_H

#include "scheme/term.h"

/* Acts behind strain.h and viscoelastic.h, on paths with several solids. */
extern const struct term weld_term;

#endif
