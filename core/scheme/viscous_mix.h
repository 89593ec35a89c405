/* viscous_mix.h - what the viscosities of the materials of a mixture make of its strain. */
#ifndef VISCOUS_MIX_H
#define VISCOUS_MIX_H

#include "scheme/viscous_strain.h"

/* Where the materials of a batch are taken from: the means of primitives at i and at i + step (0: those at i). Component q
 * at w + q * pitch. */
struct viscous_sides {
    const double *w;
    size_t pitch, step;
};

struct viscous_mix {
    double mu[STRAIN_POINTS];   /* mu_a = sum alpha_l mu_l [Pa s] */
    double zeta[STRAIN_POINTS]; /* sum alpha_l zeta_l */
    /* Where the batch has an interface (strain->interface), else the same as above or not made: */
    double own[STRAIN_POINTS];      /* sum alpha_l mu_l d_l/div u */
    double own_zeta[STRAIN_POINTS]; /* sum alpha_l zeta_l d_l/div u */
    double series[STRAIN_POINTS];   /* mu_h - mu_a */
    double iso[STRAIN_POINTS];      /* of the isotropic part: tau = 2 mu_a D + iso div u I + ... */
};

/* mu_a is bounded by what the lighter side can bear (numerics.md): a time step that the cells' own viscosities set is good for
 * it. */
void viscous_mix_make(const struct viscous_strain *strain, const struct viscous_sides *sides, struct viscous_mix *ret);

/* Component (i, axis) of tau, from both. tau[n]. */
void viscous_mix_stress(const struct viscous_strain *strain, const struct viscous_mix *mix, unsigned i, unsigned axis,
                        double *tau);

/* Component theta theta in curved geometry. */
void viscous_mix_hoop(const struct viscous_strain *strain, const struct viscous_mix *mix, double *tau);

#endif
