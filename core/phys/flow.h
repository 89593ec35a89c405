/* flow.h - inelastic flow of solids on batches of points: from a trial stretch back to the strength of the law.
 *
 * With q = sqrt(3/2 s':s') the stretch flows by dV/dt = -Dp V, Dp = (3/2) r s'/q, until q = Y. The elastic law knows I1
 * alone: s' = A dev B with A = 2 m e_1, and the flow follows one curve from B0, whatever its rate:
 *     B(x) = [B0 + x (I2 1 - B0^-1) + x^2 1]/E^2,   E^3 = 1 + I1 x + I2 x^2 + x^3,   d eps = r dx/(3 E),   r = q/A.
 * x is the one unknown, found by secants in a bracket. Mass, momentum and total energy stay as they are.
 *
 * Each solid of a cell has a stretch and flows by itself. A damaged one has (1 - D)^2 of its stress and of its strength
 * (bearing.h): it flows as if it were whole. */
#ifndef FLOW_H
#define FLOW_H

#include "phys/model.h"

#include <stddef.h>

/* Does the strength of some solid of a path ask for pressure or temperature? Then flow_return wants w. */
bool flow_reads(const struct model *path);

/* Lets the stretches, and the plastic strains where they are fields, of n points flow for dt. u: conserved fields; w:
 * their primitives where flow_reads(). Points at which nothing yields keep their bits. grown: [n_solid] rows, what the
 * plastic strains grow by (points at which nothing yields keep what is there), or NULL. */
void flow_return(const struct model *model, size_t n, size_t stride, double dt, const double *w, double *u,
                 double *grown);

/* What the solids of n points can bear when they flow slowly: sum alpha_l Y_l of those with a strength, from primitives
 * w [Pa]. */
void flow_strength(const struct model *model, size_t n, size_t stride, const double *w, double *ret);

#endif
