/* viscous.h - viscous stress, its work and its heat.
 *
 *     d(rho u)/dt += div tau,  d(rho E)/dt += div(tau u),
 *     tau = 2 mu dev D + zeta div u I + 2 w (mu_a - mu_h) (D_t + delta P),
 *     mu_a = sum alpha_l mu_l,  1/mu_h = sum alpha_l/mu_l,  mu = mu_a + w (mu_h - mu_a).
 * In a pure cell this is 2 mu dev D + zeta div u I. In a mixed one layers lie in series across the surface of its
 * materials (viscous_mix.h), and along it its liquid is a film (viscous_film.h): a bubble's wall moves because its gas
 * expands, while the water beside the gas in the same cell does not. w is 1 where the fractions change
 * (viscous_strain.h).
 *
 * A face has one tau for both sides: derivatives along its normal are differences of its two cells, those along it the
 * mean of central differences in both, which look across edges (tile->around). The velocity of its work is the mean of
 * both cells. In curved geometry differences are those of the middles of volumes, so that u = a r has no shear; the
 * hoop stress acts in the cells. What a material is heated by, 2 mu_l |dev D_l|^2 + zeta_l d_l^2 with its own strain
 * D_l = D - (div u - d_l) n n, d_l = (rho c_w^2/(rho_l c_l^2)) div u, moves volume (swell.h). */
#ifndef VISCOUS_H
#define VISCOUS_H

#include "scheme/term.h"

extern const struct term viscous_term;

/* For fields, of a tile of the whole model with tile->around and tile->rho_c2 (mix_stiffness_everywhere; NULL: no
 * mixtures), `own` from the term's `open`; n_cell numbers each. The gradients are those of the cells, which need no
 * edges and corners. Component (i, j) of tau [Pa]; third directions in curved geometry are those around the axis or the
 * centre. */
void viscous_stress_field(const struct term_tile *tile, void *own, unsigned i, unsigned j, double *tau);

/* sum alpha_l (2 mu_l |dev D_l|^2 + zeta_l d_l^2) [W/m3]: heat that the materials get. */
void viscous_dissipation_field(const struct term_tile *tile, void *own, double *heat);

#endif
