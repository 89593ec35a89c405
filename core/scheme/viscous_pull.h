/* viscous_pull.h - what a viscous fluid pulls with at its surface: the pressures of the materials of a mixed cell
 * differ by it.
 *
 * Across the surface of a bubble -p + tau_rr is common, not p: p_gas = p_liquid - tau_rr, tau_rr = -4 mu U/R beside the
 * wall of a sphere. A smeared interface has a part of that step in each of its cells, and its materials lag behind the
 * mean p by p_l - p = tau_l - sum_m alpha_m tau_m,   tau_l = -2 mu_l beta u/r                       (phys/traction.h)
 * with beta u/r the rate at which the surface grows. tau_l is the part of a material's own stress that the motion of
 * the surface alone decides: its own strain along r is d_l - beta u/r, with d_l its dilatation. What d_l adds, (4/3
 * mu_l + zeta_l) d_l, is sound in the material. In one dimension around a centre or an axis, where the normal is the
 * radius; why not in two and three dimensions: docs/decisions/viscous-lags.md.
 *
 * - tau_l are fields, made in the cells from the velocity there, like the curvature in one dimension: each stage leaves
 * those of the state that it starts from.
 * - No material is put below the mean pressure by more than PULL_MOST rho_l c_l^2.
 * - Faces: means of both cells with (alpha_l (1 - alpha_l))^2. Across a face p grows by F = sum tau_l (alpha_l,R -
 * alpha_l,L) where it balances div tau, and slopes know it, as they know tension (face_work.rise).
 * - Energy needs no source. sum_l alpha_l (p_l - tau_l) u = (p - sum alpha_l tau_l) u goes through the faces already,
 * the second part with the viscous stress: what lag.h adds for it is taken off again. In the cells tau : D is the heat
 * of the materials and -sum tau_l D alpha_l/Dt, which is what they do on each other at pressures p_l. */
#ifndef VISCOUS_PULL_H
#define VISCOUS_PULL_H

#include "scheme/term.h"
#include "scheme/viscous_strain.h"

/* Most that a material is put below the mean pressure, over its rho c^2. */
#define PULL_MOST 0.5

extern const struct term viscous_pull_term;

/* Pull of material l of a path in a batch of cells from `from` on, with its viscosity mu[n]; nothing if it has no
 * field. */
void viscous_pull_make(const struct term_tile *tile, const struct viscous_strain *strain, unsigned l, size_t from,
                       const double *mu);

/* After all materials of the batch: bounds them. */
void viscous_pull_bound(const struct term_tile *tile, size_t from, size_t n);

#endif
