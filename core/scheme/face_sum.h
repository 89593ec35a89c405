/* face_sum.h - what the materials at the edges of a row have together: density, energy, speed of sound. */
#ifndef FACE_SUM_H
#define FACE_SUM_H

#include <stdbool.h>
#include <stddef.h>

/* Sums of n edges. */
struct face_sum {
    size_t n;
    double *rho;    /* [kg/m3] */
    double *energy; /* rho e, in the end rho E [J/m3] */
    double *c;      /* frozen rho c^2 [Pa], in the end c [m/s] */
};

/* A material of a mixture: its fraction, density, rho e and rho c^2 of its own volume. */
struct face_sum_share {
    const double *alpha, *rho, *energy, *rho_c2;
};

/* Adds a material; the first one starts the sums. m: alpha rho. */
void face_sum_material(const struct face_sum *sum, bool first, const struct face_sum_share *share, double *m);

/* Kinetic energy, and c from rho c^2. rho: the sum, or the density of the only material; u: all three components. */
void face_sum_finish(const struct face_sum *sum, const double *rho, const double *const u[3]);

#endif
