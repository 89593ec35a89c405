/* mix_pressure.h - the one pressure of a mixture: sum_l alpha_l rho_l e_l(rho_l, p) = rho e.
 *
 * Where all materials of a point are linear in p that is one division; else Newton's method within a bracket (eos.h:
 * energies grow with p, so there is at most one root). Each point chooses by what it holds itself, and its iterates
 * depend on its own values alone: tiles, ranks, narrowed paths (model.h) and rows do not matter. A pressure that
 * already fulfils the equation to what round-off allows stays as it is, to the bit: closing twice changes nothing. */
#ifndef MIX_PRESSURE_H
#define MIX_PRESSURE_H

#include "phys/model.h"

#include <stddef.h>

enum { MIX_PRESSURE_BATCH = 512, MIX_PRESSURE_ROUNDS = 50 };

/* A material with less than this of a point has no say in which pressures are too low: guard judges the others. */
#define MIX_PRESSURE_FELT 1e-6

/* What iterated closures took. */
struct mix_effort {
    long long solved; /* points whose pressure was iterated */
    long long steps;  /* Newton steps of all of them; a pressure that fits from the start takes none */
    long long failed; /* points without a pressure above the least one of their materials */
    long long most;   /* most steps of one point */
};

void mix_pressure_sum(struct mix_effort *sum, struct mix_effort more);

/* Pressures of n <= MIX_PRESSURE_BATCH points into row i_E of w, which holds those to start from; fractions (at sum 1)
 * and densities stand in w as in mix.h; rho_e: energy per volume of all materials together, without the kinetic and
 * elastic one [J/m3]. Where there is no pressure, one below what a material bears stands in, for guard to find. */
struct mix_effort mix_pressure_close(const struct model *model, size_t n, size_t stride, const double *rho_e,
                                     double *w);

/* What stands in: below the least pressure that the materials of a point bear, so that the law of the one that sets it
 * says so [Pa]. */
double mix_pressure_none(double floor);

#endif
