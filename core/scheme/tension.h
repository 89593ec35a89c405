/* tension.h - surface tension between pairs of materials.
 *
 * With g = alpha_b grad alpha_a - alpha_a grad alpha_b of a pair (grad alpha_a of two materials) and kappa =
 * -div(g/|g|): d(rho u)/dt += sigma kappa g, d(rho E)/dt -= sigma kappa (alpha_b d alpha_a/dt - alpha_a d alpha_b/dt),
 *     p_l = p + sum_m alpha_m sigma_lm kappa_lm                                        (phys/traction.h)
 * In one dimension kappa is +-beta/r, exact at faces, and (A+ - A-)/V in cells; the sign says which of the two is
 * inside. In two and three dimensions cells have it from a pass over the level before the stage (solve/curve.h,
 * curvature.h), a face the mean of both cells with (alpha_a alpha_b)^2.
 * - Force: p grows by F = sigma kappa_f (alpha_R - alpha_L) across a face where it balances; slopes know it
 * (face_work.rise), and the cells on both sides get a half each: at rest all cancels.
 * - At a face the materials have the pressures p + lag_l with the fractions between the two cells, whatever limiters
 * make of those at the edges; what passes through it carries these, so that an interface that moves keeps them.
 * - Energy: E + sigma area is the conserved sum, since d(sigma area)/dt = int sigma kappa d alpha_a.
 * - Capillary waves bound the step (in one dimension there are none).
 * After Brackbill, Kothe & Zemach, J. Comput. Phys. 100 (1992) 335-354; docs/decisions/tension.md. */
#ifndef TENSION_H
#define TENSION_H

#include "scheme/term.h"

extern const struct term tension_term;

#endif
