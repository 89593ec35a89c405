/* response.h - how the solids of a mixed cell take part in its strain, where the traction is common (phys/traction.h).
 *
 * Kapila's closure gives each material of a cell a compression of its own, so that all keep one pressure. A solid
 * resists a strain along the normal of the interface with M_l = rho_l c_l^2 + stiff_l, not with rho_l c_l^2, and one
 * along the interface pulls at the normal traction as well (phys/traction_rate.h). With S = sum alpha_l/M_l d
 * alpha_l/dt = K_l div u - alpha_l own_l,   K_l = alpha_l (1/(M_l S) - 1), own_l = (pull_l - sum alpha_k pull_k/M_k /
 * S)/M_l,   sum alpha_l own_l = 0. */
#ifndef RESPONSE_H
#define RESPONSE_H

#include "scheme/term.h"

/* Owns 2 n_material rows: M_l, own_l. */
extern const struct term response_term;

/* After its `cells`: M_l in place of rho_l c_l^2; tile->rho_c2 where no tractions are common. */
const double *response_stiffness(const struct term_tile *tile);

/* After its `cells`: own_l [1/s]; NULL where no tractions are common. */
const double *response_own(const struct term_tile *tile);

#endif
