/* viscous_mix.c - see viscous_mix.h.
 *
 * A material's dilatation is d_l = r_l div u, r_l = 1/(rho_l c_l^2 S), S = sum s_l, s_l = alpha_l/(rho_l c_l^2). So
 * sum alpha_l mu_l r_l = sum s_l mu_l/S. All sums are exact where one material is alone: a model of one material
 * on the same numbers has the same bits. */
#include "scheme/viscous_mix.h"

#include "phys/coefficient.h"
#include "phys/elastic.h"
#include "phys/mix.h"
#include "phys/present.h"

#include <string.h>

/* Fluidity of a material without viscosity. */
#define VISCOUS_MIX_FLUID 1e300

/* Most times the kinematic viscosity of the more viscous side that mu_a may be for the lighter one. Harmonic means of equal
 * parts are at most twice the smaller of both viscosities. */
#define VISCOUS_MIX_MOST 2.0

/* Sums over the materials. */
struct viscous_mix_sums {
    double fluidity[STRAIN_POINTS];                     /* sum alpha_l/mu_l */
    double compliance[STRAIN_POINTS];                   /* S */
    double squares[STRAIN_POINTS];                      /* sum alpha_l^2: 1 where one is alone */
    double own[STRAIN_POINTS], own_zeta[STRAIN_POINTS]; /* sum s_l mu_l, sum s_l zeta_l */
    double rho[2][STRAIN_POINTS], mu[2][STRAIN_POINTS]; /* of the two sides */
};

/* One material at the points. */
struct viscous_mix_material {
    double alpha[STRAIN_POINTS], rho[STRAIN_POINTS], p[STRAIN_POINTS]; /* means of the sides, rho by mass */
    double mu[STRAIN_POINTS], zeta[STRAIN_POINTS];
};

static BULLA_KERNEL void viscous_mix_means(size_t n, const double *restrict a, const double *restrict b,
                                           double *restrict mean)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) mean[i] = 0.5 * (a[i] + b[i]);
}

/* Density of what both sides have of a material. */
static BULLA_KERNEL void viscous_mix_density(size_t n, const double *restrict alpha_a, const double *restrict alpha_b,
                                             const double *restrict rho_a, const double *restrict rho_b,
                                             double *restrict rho)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha_a[i], b = alpha_b[i], all = a + b, mean = 0.5 * (rho_a[i] + rho_b[i]);
        double both = (a * rho_a[i] + b * rho_b[i]) / all;
        rho[i] = all > 0.0 ? both : mean;
    }
}

static BULLA_KERNEL void viscous_mix_sum(size_t n, const struct viscous_mix_material *material, double *restrict mu,
                                         double *restrict zeta)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = material->alpha[i], m = mu[i], z = zeta[i];
        mu[i] = m + a * material->mu[i];
        zeta[i] = z + a * material->zeta[i];
    }
}

/* Density and viscosity of one side. */
static BULLA_KERNEL void viscous_mix_side(size_t n, const double *restrict alpha, const double *restrict rho_l,
                                          const double *restrict mu_l, double *restrict rho, double *restrict mu)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], r = rho[i], m = mu[i];
        rho[i] = r + a * rho_l[i];
        mu[i] = m + a * mu_l[i];
    }
}

static BULLA_KERNEL void viscous_mix_stiff(size_t n, const struct viscous_mix_material *material,
                                           const double *restrict rho_c2, struct viscous_mix_sums *sums)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = material->alpha[i], mu = material->mu[i], K = rho_c2[i], part = a / K, fluid = 1.0 / mu;
        double squares = sums->squares[i], s = sums->compliance[i], own = sums->own[i], zeta = sums->own_zeta[i],
               f = sums->fluidity[i];
        part = ((a > MIX_ABSENT) & (K > 0.0)) ? part : 0.0;
        fluid = mu > 1.0 / VISCOUS_MIX_FLUID ? fluid : VISCOUS_MIX_FLUID;
        sums->squares[i] = squares + a * a;
        sums->compliance[i] = s + part;
        sums->own[i] = own + part * mu;
        sums->own_zeta[i] = zeta + part * material->zeta[i];
        sums->fluidity[i] = f + a * fluid;
    }
}

static const double *viscous_mix_row(const struct viscous_sides *sides, unsigned q, size_t further)
{
    return sides->w + q * sides->pitch + further;
}

/* State and viscosities of material l. */
static void viscous_mix_material(const struct viscous_strain *strain, const struct viscous_sides *sides, unsigned l,
                                 const double *rate, struct viscous_mix_material *ret)
{
    const struct model *path = strain->path;
    unsigned i_alpha = path->i_alpha + l, i_rho = path->i_m + l;
    size_t n = strain->n, step = sides->step;
    const double *rho = viscous_mix_row(sides, i_rho, 0), *p = viscous_mix_row(sides, path->i_E, 0);
    bool state = coefficient_sees_state(&path->viscosity[l].mu) || (strain->interface && path->kapila);
    if (path->n_alpha) {
        const double *alpha = viscous_mix_row(sides, i_alpha, 0);
        viscous_mix_means(n, alpha, alpha + step, ret->alpha);
        if (state) viscous_mix_density(n, alpha, alpha + step, rho, rho + step, ret->rho);
    } else if (state) viscous_mix_means(n, rho, rho + step, ret->rho);
    if (state) viscous_mix_means(n, p, p + step, ret->p);
    const struct coefficient_points points = {n, rate, ret->p, ret->rho};
    coefficient_viscosities(&path->viscosity[l], &path->eos[l], &points, ret->mu, ret->zeta);
}

static void viscous_mix_add(const struct viscous_strain *strain, const struct viscous_sides *sides, unsigned l,
                            const struct viscous_mix_material *material, struct viscous_mix_sums *sums,
                            struct viscous_mix *ret)
{
    const struct model *path = strain->path;
    size_t n = strain->n;
    double e[STRAIN_POINTS], rho_c2[STRAIN_POINTS];
    viscous_mix_sum(n, material, ret->mu, ret->zeta);
    for (unsigned side = 0; side < 2 && sides->step; side++)
        viscous_mix_side(n, viscous_mix_row(sides, path->i_alpha + l, side * sides->step),
                         viscous_mix_row(sides, path->i_m + l, side * sides->step), material->mu, sums->rho[side],
                         sums->mu[side]);
    if (!strain->interface) return;
    const struct present present = {n, material->alpha, material->rho, material->p};
    if (path->kapila) present_state(&path->eos[l], &present, e, rho_c2);
    else
        for (size_t i = 0; i < n; i++) rho_c2[i] = 1.0;
    viscous_mix_stiff(n, material, rho_c2, sums);
}

/* mu_a no more than the lighter side can bear. */
static BULLA_KERNEL void viscous_mix_bound(size_t n, const struct viscous_mix_sums *sums, double *restrict mu)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double rho_a = sums->rho[0][i], rho_b = sums->rho[1][i], nu_a = sums->mu[0][i] / rho_a,
               nu_b = sums->mu[1][i] / rho_b, m = mu[i];
        double light = rho_a < rho_b ? rho_a : rho_b, nu = nu_a > nu_b ? nu_a : nu_b;
        double most = VISCOUS_MIX_MOST * (nu * light);
        mu[i] = m > most ? most : m;
    }
}

/* Without an interface all materials feel the same strain. */
static BULLA_KERNEL void viscous_mix_plain(size_t n, const double *restrict mu, const double *restrict zeta,
                                           double *restrict iso)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) iso[i] = zeta[i] - 2.0 / 3.0 * mu[i];
}

static BULLA_KERNEL void viscous_mix_split(size_t n, const struct viscous_mix_sums *sums, const double *restrict sharp,
                                           struct viscous_mix *restrict ret)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double mu = ret->mu[i], zeta = ret->zeta[i], w = sharp[i], S = sums->compliance[i];
        double own = sums->own[i] / S, own_zeta = sums->own_zeta[i] / S, series = 1.0 / sums->fluidity[i] - mu;
        int mixed = (S > 0.0) & (sums->squares[i] < 1.0);
        own = mixed ? own : mu;
        own_zeta = mixed ? own_zeta : zeta;
        ret->own[i] = own;
        ret->own_zeta[i] = own_zeta;
        ret->series[i] = mixed ? series : 0.0;
        ret->iso[i] = (zeta + w * (own_zeta - zeta)) - 2.0 / 3.0 * (mu + w * (own - mu));
    }
}

static bool viscous_mix_sees_rate(const struct model *path)
{
    bool sees = false;
    for (unsigned l = 0; l < path->n_material; l++) sees = sees || coefficient_sees_rate(&path->viscosity[l].mu);
    return sees;
}

/* The only material there is. */
static void viscous_mix_alone(const struct viscous_strain *strain, const struct viscous_sides *sides,
                              const double *rate, struct viscous_mix *ret)
{
    struct viscous_mix_material material;
    viscous_mix_material(strain, sides, 0, rate, &material);
    memcpy(ret->mu, material.mu, strain->n * sizeof *ret->mu);
    memcpy(ret->zeta, material.zeta, strain->n * sizeof *ret->zeta);
}

static void viscous_mix_all(const struct viscous_strain *strain, const struct viscous_sides *sides, const double *rate,
                            struct viscous_mix_sums *sums, struct viscous_mix *ret)
{
    struct viscous_mix_material material;
    memset(ret->mu, 0, strain->n * sizeof *ret->mu);
    memset(ret->zeta, 0, strain->n * sizeof *ret->zeta);
    memset(sums, 0, sizeof *sums);
    for (unsigned l = 0; l < strain->path->n_material; l++) {
        viscous_mix_material(strain, sides, l, rate, &material);
        viscous_mix_add(strain, sides, l, &material, sums, ret);
    }
    if (sides->step) viscous_mix_bound(strain->n, sums, ret->mu);
}

void viscous_mix_make(const struct viscous_strain *strain, const struct viscous_sides *sides, struct viscous_mix *ret)
{
    double rate[STRAIN_POINTS];
    struct viscous_mix_sums sums;
    bool rates = viscous_mix_sees_rate(strain->path);
    if (rates) viscous_strain_rate(strain, rate);
    if (!strain->path->n_alpha) viscous_mix_alone(strain, sides, rate, ret);
    else viscous_mix_all(strain, sides, rate, &sums, ret);
    if (strain->interface) viscous_mix_split(strain->n, &sums, strain->sharp, ret);
    else viscous_mix_plain(strain->n, ret->mu, ret->zeta, ret->iso);
}

static BULLA_KERNEL void viscous_mix_twice(size_t n, const double *restrict mu, const double *restrict D,
                                           double *restrict tau)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) tau[i] = 2.0 * mu[i] * D[i];
}

static BULLA_KERNEL void viscous_mix_dilate(size_t n, const double *restrict iso, const double *restrict div,
                                            double *restrict tau)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double t = tau[i];
        tau[i] = t + iso[i] * div[i];
    }
}

/* - 2 (mu_a - own) div u m_i m_a + 2 (mu_h - mu_a) (m_i q_a + q_i m_a - 2 (m D m) m_i m_a) */
static BULLA_KERNEL void viscous_mix_turn(size_t n, const struct viscous_strain *restrict strain,
                                          const struct viscous_mix *restrict mix, const double *restrict m_i,
                                          const double *restrict m_a, const double *restrict q_i,
                                          const double *restrict q_a, double *restrict tau)
{
    const double *restrict div = strain->div, *restrict normal = strain->normal, *restrict mu = mix->mu,
                           *restrict own = mix->own, *restrict series = mix->series;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = m_i[i], b = m_a[i], both = a * b, t = tau[i];
        double shear = (a * q_a[i] + q_i[i] * b) - 2.0 * normal[i] * both;
        tau[i] = t + 2.0 * (series[i] * shear - (mu[i] - own[i]) * div[i] * both);
    }
}

void viscous_mix_stress(const struct viscous_strain *strain, const struct viscous_mix *mix, unsigned i, unsigned axis,
                        double *tau)
{
    static const double none[STRAIN_POINTS];
    size_t n = strain->n;
    viscous_mix_twice(n, mix->mu, strain->D[elastic_component(i, axis)], tau);
    if (i == axis) viscous_mix_dilate(n, mix->iso, strain->div, tau);
    if (!strain->interface) return;
    const double *m_i = i < (unsigned)strain->path->dim ? strain->colour[i] : none;
    viscous_mix_turn(n, strain, mix, m_i, strain->colour[axis], strain->along[i], strain->along[axis], tau);
}

void viscous_mix_hoop(const struct viscous_strain *strain, const struct viscous_mix *mix, double *tau)
{
    viscous_mix_twice(strain->n, mix->mu, strain->hoop, tau);
    viscous_mix_dilate(strain->n, mix->iso, strain->div, tau);
}
