/* nan.c - laws in good order that give NaN when they are used, for program/hostile.sh. Built once per kind with
 * -DNAN_CONSTITUTIVE, -DNAN_EOS, -DNAN_LIMITER, -DNAN_RECONSTRUCTION or -DNAN_RIEMANN. The gas is an ideal one up to 3
 * bar, the solid neo-Hookean up to I1 = 18. */
#include "bulla/constitutive.h"
#include "bulla/eos.h"
#include "bulla/limiter.h"
#include "bulla/reconstruction.h"
#include "bulla/riemann.h"

#include <math.h>
#include <string.h>

#if defined(NAN_EOS)
#define NAN_KIND "eos"
enum { NAN_GOOD = 300000 }; /* Pa */

static double nan_above(double p)
{
    return p > NAN_GOOD ? (double)NAN : 1.0;
}

static void nan_state(const void *self, size_t n, const double *BULLA_RESTRICT rho, const double *BULLA_RESTRICT p,
                      double *BULLA_RESTRICT rho_e, double *BULLA_RESTRICT rho_c2)
{
    (void)self, (void)rho;
    for (size_t i = 0; i < n; i++) {
        rho_e[i] = 2.5 * p[i] * nan_above(p[i]);
        rho_c2[i] = 1.4 * p[i] * nan_above(p[i]);
    }
}

static void nan_derivatives(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                            const double *BULLA_RESTRICT p, double *BULLA_RESTRICT de_dp,
                            double *BULLA_RESTRICT de_drho)
{
    (void)self, (void)rho;
    for (size_t i = 0; i < n; i++) {
        de_dp[i] = 2.5 * nan_above(p[i]);
        de_drho[i] = 0.0;
    }
}

static void nan_ratio(const void *self, size_t n, const double *BULLA_RESTRICT a, const double *BULLA_RESTRICT b,
                      double *BULLA_RESTRICT out)
{
    (void)self;
    for (size_t i = 0; i < n; i++) out[i] = a[i] / b[i];
}

static void nan_zero(const void *self, size_t n, const double *BULLA_RESTRICT rho, double *BULLA_RESTRICT p)
{
    (void)self, (void)rho;
    memset(p, 0, n * sizeof *p);
}

static void nan_range(const void *self, struct bulla_eos_range *ret_range)
{
    (void)self;
    *ret_range = (struct bulla_eos_range){0.0, 1e9, 0.0, 1e9, 0.0, 1e9};
}

static const struct bulla_eos nan_table = {.size = sizeof nan_table,
                                           .state = nan_state,
                                           .derivatives = nan_derivatives,
                                           .temperature = nan_ratio,
                                           .entropy = nan_ratio,
                                           .density = nan_ratio,
                                           .p_min = nan_zero,
                                           .range = nan_range};
#elif defined(NAN_CONSTITUTIVE)
#define NAN_KIND "constitutive"

static void nan_energy(const void *self, size_t n, const double *BULLA_RESTRICT I1, const double *BULLA_RESTRICT I2,
                       double *BULLA_RESTRICT e, double *BULLA_RESTRICT e_1, double *BULLA_RESTRICT e_2)
{
    (void)self, (void)I2;
    for (size_t i = 0; i < n; i++) {
        e[i] = 100.0 * (I1[i] - 3.0);
        e_1[i] = I1[i] > 18.0 ? (double)NAN : 100.0;
        e_2[i] = 0.0;
    }
}

static void nan_range(const void *self, struct bulla_constitutive_range *ret_range)
{
    (void)self;
    *ret_range = (struct bulla_constitutive_range){(double)INFINITY, (double)INFINITY};
}

static const struct bulla_constitutive nan_table = {.size = sizeof nan_table,
                                                    .energy = nan_energy,
                                                    .range = nan_range,
                                                    .first_only = 1};
#elif defined(NAN_LIMITER)
#define NAN_KIND "limiter"

static void nan_slope(const void *self, size_t n, const double *BULLA_RESTRICT d_minus,
                      const double *BULLA_RESTRICT d_plus, double *BULLA_RESTRICT slope)
{
    (void)self, (void)d_minus, (void)d_plus;
    for (size_t i = 0; i < n; i++) slope[i] = (double)NAN;
}

static const struct bulla_limiter nan_table = {.size = sizeof nan_table, .slope = nan_slope};
#elif defined(NAN_RECONSTRUCTION)
#define NAN_KIND "reconstruction"

static void nan_edges(const void *self, const struct bulla_limited *limited, size_t n, size_t step, const double *w,
                      double *BULLA_RESTRICT lower, double *BULLA_RESTRICT upper)
{
    (void)self, (void)limited, (void)step, (void)w;
    for (size_t i = 0; i < n; i++) lower[i] = upper[i] = (double)NAN;
}

static const struct bulla_reconstruction nan_table = {.size = sizeof nan_table, .layers = 2, .edges = nan_edges};
#else
#define NAN_KIND "riemann"

static void nan_fill(double *const *rows, unsigned count, size_t n)
{
    for (unsigned row = 0; row < count; row++)
        for (size_t i = 0; i < n; i++) rows[row][i] = (double)NAN;
}

static void nan_solve(const void *self, const struct bulla_faces *faces)
{
    (void)self;
    nan_fill(faces->flux.m, faces->n_material, faces->n);
    nan_fill(faces->flux.momentum, faces->n_velocity, faces->n);
    nan_fill(faces->flux.alpha, faces->n_alpha, faces->n);
    nan_fill((double *[]){faces->flux.rho_E, faces->flux.u}, 2, faces->n);
}

static const struct bulla_riemann nan_table = {.size = sizeof nan_table, .solve = nan_solve};
#endif

BULLA_EXPORT const struct bulla_module bulla_module = {.magic = BULLA_MAGIC,
                                                       .abi = BULLA_ABI,
                                                       .size = sizeof bulla_module,
                                                       .kind = NAN_KIND,
                                                       .name = "nan",
                                                       .version = "1.0",
                                                       .doc = "Gives NaN, for tests.",
                                                       .cite = "nobody",
                                                       .table = &nan_table};
