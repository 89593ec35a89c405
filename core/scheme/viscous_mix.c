/* viscous_mix.c - see viscous_mix.h.
 *
 * A material's dilatation is d_l = r_l div u, r_l = 1/(rho_l c_l^2 S), S = sum s_l, s_l = alpha_l/(rho_l c_l^2). So
 * sum alpha_l mu_l r_l = sum s_l mu_l/S. All sums are exact where one material is alone: a model of one material
 * on the same numbers has the same bits. */
#include "scheme/viscous_mix.h"

#include "base/mem.h"
#include "phys/elastic.h"
#include "phys/mix.h"
#include "phys/present.h"

#include <string.h>

/* Fluidity of a material without viscosity. */
#define VISCOUS_MIX_FLUID 1e300

/* Most times the kinematic viscosity of the more viscous side that mu_a may be for the lighter one. Harmonic means of
 * equal parts are at most twice the smaller of both viscosities. */
#define VISCOUS_MIX_MOST 2.0

/* The same where a fluid pulls on its surface (viscous_pull.h): there the normal is the radius, mu_a acts on no
 * difference across the face, and the pressures on both sides of it are those of mu_a as it is. Not without a bound:
 * with one of 200 a bubble in 1 Pa s breaks up. */
#define VISCOUS_MIX_PULLED 60.0

/* Sums over the materials, where there is an interface. */
struct viscous_mix_sums {
    double rho[2][STRAIN_POINTS], mu[2][STRAIN_POINTS], zeta[2][STRAIN_POINTS]; /* of the two sides */
    double fluidity[STRAIN_POINTS];                                             /* sum alpha_l/mu_l */
    double compliance[STRAIN_POINTS];                                           /* S */
    double squares[STRAIN_POINTS];                      /* sum alpha_l^2: 1 where one is alone */
    double own[STRAIN_POINTS], own_zeta[STRAIN_POINTS]; /* sum s_l mu_l, sum s_l zeta_l */
};

/* One material at the points. */
struct viscous_mix_material {
    double alpha[STRAIN_POINTS], rho[STRAIN_POINTS]; /* means of the sides, rho by mass */
    struct viscous_mix_number room;
    struct viscous_mix_rows rows;
};

void viscous_mix_open(const struct model *model, struct viscous_mix *ret)
{
    ret->number = mem_new(model->n_material, sizeof *ret->number);
    for (unsigned l = 0; l < model->n_material; l++) {
        const struct coefficient_points points = {.n = STRAIN_POINTS};
        if (coefficient_is_number(&model->viscosity[l].mu))
            coefficient_viscosities(&model->viscosity[l], &model->eos[l], &points, ret->number[l].mu,
                                    ret->number[l].zeta);
    }
}

void viscous_mix_close(struct viscous_mix *mix)
{
    mem_free(mix->number);
}

struct viscous_mix_rows viscous_mix_ask(const struct viscous_mix *mix, const struct model *path, unsigned l,
                                        const struct coefficient_points *points, struct viscous_mix_number *room)
{
    const struct viscous_mix_number *number = &mix->number[path->first + l];
    if (coefficient_is_number(&path->viscosity[l].mu)) return (struct viscous_mix_rows){number->mu, number->zeta};
    coefficient_viscosities(&path->viscosity[l], &path->eos[l], points, room->mu, room->zeta);
    return (struct viscous_mix_rows){room->mu, room->zeta};
}

static BULLA_KERNEL void viscous_mix_means(const struct viscous_sides *sides, const double *restrict a,
                                           double *restrict mean)
{
    const double *restrict b = a + sides->step;
    for (size_t r = 0; r < sides->rows; r++, a += sides->row, b += sides->row, mean += sides->n)
#pragma omp simd
        for (size_t i = 0; i < sides->n; i++) mean[i] = 0.5 * (a[i] + b[i]);
}

/* Density of what both sides have of a material. */
static BULLA_KERNEL void viscous_mix_density(const struct viscous_sides *sides, const double *restrict alpha,
                                             const double *restrict rho_l, double *restrict rho)
{
    const size_t step = sides->step, row = sides->row;
    for (size_t r = 0; r < sides->rows; r++, alpha += row, rho_l += row, rho += sides->n)
#pragma omp simd
        for (size_t i = 0; i < sides->n; i++) {
            double a = alpha[i], b = alpha[i + step], all = a + b, mean = 0.5 * (rho_l[i] + rho_l[i + step]);
            double both = (a * rho_l[i] + b * rho_l[i + step]) / all;
            rho[i] = all > 0.0 ? both : mean;
        }
}

/* The mean of alpha, and what the material has of mu and zeta. */
static BULLA_KERNEL void viscous_mix_weigh(const struct viscous_sides *sides, const double *restrict alpha,
                                           struct viscous_mix_material *restrict material,
                                           struct viscous_mix *restrict ret)
{
    const double *restrict mu_l = material->rows.mu, *restrict zeta_l = material->rows.zeta;
    const size_t step = sides->step, n = sides->n;
    for (size_t r = 0, k = 0; r < sides->rows; r++, k += n, alpha += sides->row)
#pragma omp simd
        for (size_t i = 0; i < n; i++) {
            double mean = 0.5 * (alpha[i] + alpha[i + step]), mu = ret->mu[k + i], zeta = ret->zeta[k + i];
            material->alpha[k + i] = mean;
            ret->mu[k + i] = mu + mean * mu_l[k + i];
            ret->zeta[k + i] = zeta + mean * zeta_l[k + i];
        }
}

/* What it has of density and viscosities on each side. */
static BULLA_KERNEL void viscous_mix_side(const struct viscous_sides *sides, const double *restrict alpha,
                                          const double *restrict rho_l, const struct viscous_mix_rows *rows,
                                          double *restrict rho, double *restrict mu, double *restrict zeta)
{
    const double *restrict mu_l = rows->mu, *restrict zeta_l = rows->zeta;
    const size_t n = sides->n;
    for (size_t r = 0, k = 0; r < sides->rows; r++, k += n, alpha += sides->row, rho_l += sides->row)
#pragma omp simd
        for (size_t i = 0; i < n; i++) {
            double a = alpha[i], d = rho[k + i], m = mu[k + i], z = zeta[k + i];
            rho[k + i] = d + a * rho_l[i];
            mu[k + i] = m + a * mu_l[k + i];
            zeta[k + i] = z + a * zeta_l[k + i];
        }
}

static BULLA_KERNEL void viscous_mix_stiff(size_t n, const struct viscous_mix_material *restrict material,
                                           const double *restrict rho_c2, struct viscous_mix_sums *restrict sums)
{
    const double *restrict mu_l = material->rows.mu, *restrict zeta_l = material->rows.zeta;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = material->alpha[i], mu = mu_l[i], K = rho_c2[i], part = a / K, fluid = 1.0 / mu;
        double squares = sums->squares[i], s = sums->compliance[i], own = sums->own[i], zeta = sums->own_zeta[i],
               f = sums->fluidity[i];
        part = ((a > MIX_ABSENT) & (K > 0.0)) ? part : 0.0;
        fluid = mu > 1.0 / VISCOUS_MIX_FLUID ? fluid : VISCOUS_MIX_FLUID;
        sums->squares[i] = squares + a * a;
        sums->compliance[i] = s + part;
        sums->own[i] = own + part * mu;
        sums->own_zeta[i] = zeta + part * zeta_l[i];
        sums->fluidity[i] = f + a * fluid;
    }
}

bool viscous_mix_sees_rate(const struct model *path)
{
    bool sees = false;
    for (unsigned l = 0; l < path->n_material; l++) sees = sees || coefficient_sees_rate(&path->viscosity[l].mu);
    return sees;
}

/* What the laws of a batch are asked with. */
struct viscous_mix_state {
    const struct viscous_strain *strain;
    const struct viscous_sides *sides;
    double rate[STRAIN_POINTS], p[STRAIN_POINTS];
    bool wanted; /* some material wants p and its own density */
};

static const double *viscous_mix_row(const struct viscous_mix_state *state, unsigned q)
{
    return state->sides->w + q * state->sides->pitch;
}

static void viscous_mix_rate(const struct viscous_strain *strain, double *rate)
{
    double square[STRAIN_POINTS];
    viscous_strain_square(strain, square);
    viscous_strain_rate(strain, square, rate);
}

static void viscous_mix_begin(const struct viscous_strain *strain, const struct viscous_sides *sides,
                              struct viscous_mix_state *ret)
{
    const struct model *path = strain->path;
    ret->strain = strain;
    ret->sides = sides;
    ret->wanted = strain->interface && path->kapila;
    for (unsigned l = 0; l < path->n_material; l++)
        ret->wanted = ret->wanted || coefficient_sees_state(&path->viscosity[l].mu);
    if (viscous_mix_sees_rate(path)) viscous_mix_rate(strain, ret->rate);
    if (ret->wanted) viscous_mix_means(sides, viscous_mix_row(ret, path->i_E), ret->p);
}

/* State and viscosities of material l. */
static void viscous_mix_material(const struct viscous_mix_state *state, const struct viscous_mix *mix, unsigned l,
                                 struct viscous_mix_material *ret)
{
    const struct model *path = state->strain->path;
    const double *rho = viscous_mix_row(state, path->i_m + l);
    if (state->wanted && path->n_alpha)
        viscous_mix_density(state->sides, viscous_mix_row(state, path->i_alpha + l), rho, ret->rho);
    else if (state->wanted) viscous_mix_means(state->sides, rho, ret->rho);
    const struct coefficient_points points = {state->strain->n, state->rate, state->p, ret->rho};
    ret->rows = viscous_mix_ask(mix, path, l, &points, &ret->room);
}

static void viscous_mix_add(const struct viscous_mix_state *state, unsigned l, struct viscous_mix_material *material,
                            struct viscous_mix_sums *sums, struct viscous_mix *ret)
{
    const struct viscous_strain *strain = state->strain;
    const struct viscous_sides *sides = state->sides;
    const struct model *path = strain->path;
    const double *alpha = viscous_mix_row(state, path->i_alpha + l), *rho_l = viscous_mix_row(state, path->i_m + l);
    size_t n = strain->n;
    double e[STRAIN_POINTS], rho_c2[STRAIN_POINTS];
    viscous_mix_weigh(sides, alpha, material, ret);
    if (!strain->interface) return;
    for (unsigned side = 0; side < 2 && sides->step; side++)
        viscous_mix_side(sides, alpha + side * sides->step, rho_l + side * sides->step, &material->rows,
                         sums->rho[side], sums->mu[side], sums->zeta[side]);
    const struct present present = {n, material->alpha, material->rho, state->p};
    if (path->kapila) present_state(&path->eos[l], &present, e, rho_c2);
    else
        for (size_t i = 0; i < n; i++) rho_c2[i] = 1.0;
    viscous_mix_stiff(n, material, rho_c2, sums);
}

/* The most that a viscosity may be at the faces: `times` what the lighter side can bear. a, b: those of both sides. */
static BULLA_KERNEL void viscous_mix_bear(size_t n, double times, double rho[2][STRAIN_POINTS],
                                          const double *restrict a, const double *restrict b, double *restrict most)
{
    const double *restrict rho_a = rho[0], *restrict rho_b = rho[1];
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double light = rho_a[i] < rho_b[i] ? rho_a[i] : rho_b[i], heavy = rho_a[i] < rho_b[i] ? rho_b[i] : rho_a[i];
        double own = rho_a[i] < rho_b[i] ? a[i] : b[i], other = (rho_a[i] < rho_b[i] ? b[i] : a[i]) * (light / heavy);
        most[i] = times * (own > other ? own : other);
    }
}

static BULLA_KERNEL void viscous_mix_cut(size_t n, const double *restrict most, double *restrict x)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double value = x[i];
        x[i] = value > most[i] ? most[i] : value;
    }
}

/* No viscosity of a face between two materials is more than that; the harmonic mean is not anyway. */
static void viscous_mix_bound(const struct model *path, size_t n, struct viscous_mix_sums *sums,
                              struct viscous_mix *ret)
{
    double most[STRAIN_POINTS];
    viscous_mix_bear(n, path->n_pull ? VISCOUS_MIX_PULLED : VISCOUS_MIX_MOST, sums->rho, sums->mu[0], sums->mu[1],
                     most);
    viscous_mix_cut(n, most, ret->mu);
    viscous_mix_bear(n, VISCOUS_MIX_MOST, sums->rho, sums->mu[0], sums->mu[1], most);
    viscous_mix_cut(n, most, ret->own);
    viscous_mix_bear(n, VISCOUS_MIX_MOST, sums->rho, sums->zeta[0], sums->zeta[1], most);
    viscous_mix_cut(n, most, ret->zeta);
    viscous_mix_cut(n, most, sums->own_zeta);
}

/* Without an interface all materials feel the same strain. */
static BULLA_KERNEL void viscous_mix_plain(size_t n, const double *restrict mu, const double *restrict zeta,
                                           double *restrict iso)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) iso[i] = zeta[i] - 2.0 / 3.0 * mu[i];
}

/* Means with the weights of dilatation, of materials that are not alone. */
static BULLA_KERNEL void viscous_mix_split(size_t n, struct viscous_mix_sums *restrict sums,
                                           struct viscous_mix *restrict ret)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double S = sums->compliance[i], stiff = 1.0 / S, mu = ret->mu[i], zeta = ret->zeta[i];
        double own = sums->own[i] * stiff, own_zeta = sums->own_zeta[i] * stiff;
        int mixed = (S > 0.0) & (sums->squares[i] < 1.0);
        ret->own[i] = mixed ? own : mu;
        sums->own_zeta[i] = mixed ? own_zeta : zeta;
    }
}

static BULLA_KERNEL void viscous_mix_turned(size_t n, const struct viscous_mix_sums *restrict sums,
                                            const double *restrict sharp, struct viscous_mix *restrict ret)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double mu = ret->mu[i], zeta = ret->zeta[i], w = sharp[i], own = ret->own[i], own_zeta = sums->own_zeta[i];
        double series = 1.0 / sums->fluidity[i] - mu;
        int mixed = (sums->compliance[i] > 0.0) & (sums->squares[i] < 1.0);
        ret->series[i] = mixed ? series : 0.0;
        ret->iso[i] = (zeta + w * (own_zeta - zeta)) - 2.0 / 3.0 * (mu + w * (own - mu));
    }
}

static void viscous_mix_all(const struct viscous_mix_state *state, struct viscous_mix_sums *sums,
                            struct viscous_mix *ret)
{
    const struct model *path = state->strain->path;
    size_t n = state->strain->n, bytes = n * sizeof *ret->mu;
    double *rows[] = {ret->mu,       ret->zeta,     sums->rho[0],  sums->rho[1],   sums->mu[0],
                      sums->mu[1],   sums->zeta[0], sums->zeta[1], sums->fluidity, sums->compliance,
                      sums->squares, sums->own,     sums->own_zeta};
    struct viscous_mix_material material; /* large: filled as far as it is used */
    for (size_t i = 0; i < (state->strain->interface ? sizeof rows / sizeof *rows : 2); i++) memset(rows[i], 0, bytes);
    for (unsigned l = 0; l < path->n_material; l++) {
        viscous_mix_material(state, ret, l, &material);
        viscous_mix_add(state, l, &material, sums, ret);
    }
    if (!state->strain->interface) return;
    viscous_mix_split(n, sums, ret);
    if (state->sides->step) viscous_mix_bound(path, n, sums, ret);
    viscous_mix_turned(n, sums, state->strain->sharp, ret);
}

/* The only material there is. */
static void viscous_mix_alone(const struct viscous_mix_state *state, struct viscous_mix *ret)
{
    struct viscous_mix_material material; /* large: filled as far as it is used */
    viscous_mix_material(state, ret, 0, &material);
    memcpy(ret->mu, material.rows.mu, state->strain->n * sizeof *ret->mu);
    memcpy(ret->zeta, material.rows.zeta, state->strain->n * sizeof *ret->zeta);
}

void viscous_mix_make(const struct viscous_strain *strain, const struct viscous_sides *sides, struct viscous_mix *ret)
{
    struct viscous_mix_state state; /* large: filled as far as it is used */
    struct viscous_mix_sums sums;
    viscous_mix_begin(strain, sides, &state);
    if (!strain->path->n_alpha) viscous_mix_alone(&state, ret);
    else viscous_mix_all(&state, &sums, ret);
    if (!strain->interface) viscous_mix_plain(strain->n, ret->mu, ret->zeta, ret->iso);
}

/* 2 mu D */
static BULLA_KERNEL void viscous_mix_twice(size_t n, const double *restrict mu, const double *restrict D,
                                           double *restrict tau)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) tau[i] = 2.0 * mu[i] * D[i];
}

/* 2 mu D + iso div u */
static BULLA_KERNEL void viscous_mix_press(size_t n, const double *restrict mu, const double *restrict D,
                                           const double *restrict iso, const double *restrict div, double *restrict tau)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) tau[i] = 2.0 * mu[i] * D[i] + iso[i] * div[i];
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
    const double *D = strain->D[elastic_component(i, axis)];
    size_t n = strain->n;
    if (i == axis) viscous_mix_press(n, mix->mu, D, mix->iso, strain->div, tau);
    else viscous_mix_twice(n, mix->mu, D, tau);
    if (!strain->interface) return;
    viscous_mix_turn(n, strain, mix, strain->colour[i], strain->colour[axis], strain->along[i], strain->along[axis],
                     tau);
}

void viscous_mix_hoop(const struct viscous_strain *strain, const struct viscous_mix *mix, double *tau)
{
    viscous_mix_press(strain->n, mix->mu, strain->hoop, mix->iso, strain->div, tau);
}
