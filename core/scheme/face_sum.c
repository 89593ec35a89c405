/* face_sum.c - see face_sum.h. */
#include "scheme/face_sum.h"

#include "bulla/module.h"

#include <math.h>

/* One material's share: m = alpha rho, and its parts of rho, rho e and rho c_f^2; the first
 * material starts the sums. */
static BULLA_KERNEL void face_sum_begin(size_t n, const double *restrict alpha, const double *restrict rho_l,
                                        const double *restrict e, const double *restrict rho_c2, double *restrict m,
                                        double *restrict rho, double *restrict energy, double *restrict sum_c2)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], mass = a * rho_l[i], share = a * e[i], stiff = a * rho_c2[i];
        m[i] = mass;
        rho[i] = mass;
        energy[i] = share;
        sum_c2[i] = stiff;
    }
}

static BULLA_KERNEL void face_sum_add(size_t n, const double *restrict alpha, const double *restrict rho_l,
                                      const double *restrict e, const double *restrict rho_c2, double *restrict m,
                                      double *restrict rho, double *restrict energy, double *restrict sum_c2)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], mass = a * rho_l[i], share = a * e[i], stiff = a * rho_c2[i];
        double r = rho[i], sum_e = energy[i], sum_c = sum_c2[i];
        m[i] = mass;
        rho[i] = r + mass;
        energy[i] = sum_e + share;
        sum_c2[i] = sum_c + stiff;
    }
}

/* Kinetic energy, and c from rho c^2. */
static BULLA_KERNEL void face_sum_move(size_t n, const double *restrict rho, const double *restrict u,
                                       const double *restrict v, const double *restrict w, double *restrict energy,
                                       double *restrict c)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double r = rho[i], a = u[i], b = v[i], d = w[i], e = energy[i], s = c[i];
        energy[i] = e + 0.5 * r * (a * a + b * b + d * d);
        c[i] = sqrt(s / r);
    }
}

void face_sum_material(const struct face_sum *sum, bool first, const struct face_sum_share *share, double *m)
{
    if (first)
        face_sum_begin(sum->n, share->alpha, share->rho, share->energy, share->rho_c2, m, sum->rho, sum->energy,
                       sum->c);
    else face_sum_add(sum->n, share->alpha, share->rho, share->energy, share->rho_c2, m, sum->rho, sum->energy, sum->c);
}

void face_sum_finish(const struct face_sum *sum, const double *rho, const double *const u[3])
{
    face_sum_move(sum->n, rho, u[0], u[1], u[2], sum->energy, sum->c);
}
