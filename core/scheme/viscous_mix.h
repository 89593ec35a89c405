/* viscous_mix.h - what the viscosities of the materials of a mixture make of its strain. */
#ifndef VISCOUS_MIX_H
#define VISCOUS_MIX_H

#include "phys/coefficient.h"
#include "scheme/viscous_strain.h"

/* Where the materials of a batch are taken from: rows of n primitives, a row `row` further than the one before; means
 * of those at i and at i + step (0: those at i). Component q at w + q * pitch. */
struct viscous_sides {
    const double *w;
    size_t pitch, step, rows, n, row;
};

/* The viscosities of one material, where they are numbers. */
struct viscous_mix_number {
    double mu[STRAIN_POINTS], zeta[STRAIN_POINTS];
};

struct viscous_mix {
    struct viscous_mix_number *number; /* [n_material] of the scene */
    double mu[STRAIN_POINTS];          /* sum alpha_l mu_l [Pa s]; at an interface 1/(sum alpha_l/mu_l) */
    double zeta[STRAIN_POINTS];        /* sum alpha_l zeta_l; with mu layers in series, too */
    double iso[STRAIN_POINTS];         /* of the isotropic part: tau = 2 mu D + iso div u I */
    double film[STRAIN_POINTS];        /* at an interface: what sum alpha_l mu_l is more, along it (viscous_film.h) */
};

/* Fluidity of a material without viscosity [1/(Pa s)]. */
#define VISCOUS_MIX_FLUID 1e300

/* 1/x of a viscosity */
static inline double viscous_mix_fluid(double x)
{
    double fluid = 1.0 / x;
    return x > 1.0 / VISCOUS_MIX_FLUID ? fluid : VISCOUS_MIX_FLUID;
}

void viscous_mix_open(const struct model *model, struct viscous_mix *ret);
void viscous_mix_close(struct viscous_mix *mix);

/* Does some law look at the rate of shear? */
bool viscous_mix_sees_rate(const struct model *path);

/* mu and zeta [n] of material l of a path: rows of their own, or `room`. */
struct viscous_mix_rows {
    const double *mu, *zeta;
};
struct viscous_mix_rows viscous_mix_ask(const struct viscous_mix *mix, const struct model *path, unsigned l,
                                        const struct coefficient_points *points, struct viscous_mix_number *room);

/* Harmonic means are no more than twice what the lighter side of a face has: a time step that the cells' own
 * viscosities set is good for them. */
void viscous_mix_make(const struct viscous_strain *strain, const struct viscous_sides *sides, struct viscous_mix *ret);

/* Component (i, axis) of tau, from both. tau[n]. */
void viscous_mix_stress(const struct viscous_strain *strain, const struct viscous_mix *mix, unsigned i, unsigned axis,
                        double *tau);

/* Component (i, j) of a film, 2 mu (D - m q - q m + (m D m) m m + (div u - m D m) (I - m m)), after
 * viscous_strain_across. */
void viscous_mix_film(const struct viscous_strain *strain, const double *mu, unsigned i, unsigned j, double *tau);

/* Its theta theta. */
void viscous_mix_film_hoop(const struct viscous_strain *strain, const double *mu, double *tau);

/* Component theta theta in curved geometry. */
void viscous_mix_hoop(const struct viscous_strain *strain, const struct viscous_mix *mix, double *tau);

#endif
