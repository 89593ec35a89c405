/* conduction.h - heat, from cell to cell and from material to material.
 *
 * The materials of a mixed cell have temperatures of their own, from their equations of state. Through each face heat
 * goes in channels between them (conduction_channel.h); their sum is the flux q of the energy, their parts are the
 * powers Q_l that the materials of the two cells get: d(rho E)/dt = -div q,   sum_l Q_l = -div q, and Q_l moves volume
 * so that the materials keep one pressure (swell.h): without that half water, half air would gain two thousand times
 * too much pressure. Materials that lie in a cell side by side with nothing different in the next one exchange nothing:
 * there is no length in that.
 *
 * Time step: 1/dt = signal/CFL + (8/1.8) max_l k_l/(rho_l cv_l) sum_a 1/h_a^2 of the materials that are enough of the
 * cell (heed.h). What is less conducts at most what keeps it stable. Distances are those of the centroids of cells: a
 * radius counts with its weight. */
#ifndef CONDUCTION_H
#define CONDUCTION_H

#include "scheme/term.h"

/* Owns n_alpha rows: the power that each material gets [W/m3 of the cell]. */
extern const struct term conduction_term;

/* How material l of a model conducts at 25 C and 1 atm; zeros if it does not. */
struct conduction_facts {
    double k, cp, rho_cp, rho_cv; /* [W/(m K), J/(kg K), J/(m3 K), J/(m3 K)] */
};
struct conduction_facts conduction_facts(const struct model *model, unsigned l);

/* The time step that a diffusivity k/(rho cv) [m2/s] alone would ask for, on cells with this sum of 1/h^2 [s]. */
double conduction_step(double diffusivity, double sum);

#endif
