/* viscous_mix.c - see viscous_mix.h. All sums are exact where one material is alone: a model of one material on the
 * same numbers has the same bits. */
#include "scheme/viscous_mix.h"

#include "base/mem.h"
#include "phys/elastic.h"

#include <string.h>

/* Sums over the materials, where there is an interface. */
struct viscous_mix_sums {
    double fluidity[STRAIN_POINTS]; /* sum alpha_l/mu_l */
    double longwise[STRAIN_POINTS]; /* sum alpha_l/(4/3 mu_l + zeta_l) */
    double squares[STRAIN_POINTS];  /* sum alpha_l^2: 1 where one is alone */
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

static BULLA_KERNEL void viscous_mix_series(size_t n, const struct viscous_mix_material *restrict material,
                                            struct viscous_mix_sums *restrict sums)
{
    const double *restrict mu_l = material->rows.mu, *restrict zeta_l = material->rows.zeta;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = material->alpha[i], mu = mu_l[i], fluid = viscous_mix_fluid(mu);
        double along = viscous_mix_fluid(4.0 / 3.0 * mu + zeta_l[i]);
        double squares = sums->squares[i], f = sums->fluidity[i], g = sums->longwise[i];
        sums->squares[i] = squares + a * a;
        sums->fluidity[i] = f + a * fluid;
        sums->longwise[i] = g + a * along;
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
    ret->wanted = false;
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
    viscous_mix_weigh(state->sides, viscous_mix_row(state, strain->path->i_alpha + l), material, ret);
    if (strain->interface) viscous_mix_series(strain->n, material, sums);
}

/* zeta - 2/3 mu */
static BULLA_KERNEL void viscous_mix_plain(size_t n, const double *restrict mu, const double *restrict zeta,
                                           double *restrict iso)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) iso[i] = zeta[i] - 2.0 / 3.0 * mu[i];
}

/* At an interface what acts across layers in series, zeta with mu. */
static BULLA_KERNEL void viscous_mix_across(size_t n, const struct viscous_mix_sums *restrict sums,
                                            const double *restrict sharp, struct viscous_mix *restrict ret)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double mu = ret->mu[i], zeta = ret->zeta[i], w = sums->squares[i] < 1.0 ? sharp[i] : 0.0;
        double across = 1.0 / sums->fluidity[i], bulk = 1.0 / sums->longwise[i] - 4.0 / 3.0 * across;
        ret->film[i] = w * (mu - across);
        ret->mu[i] = mu + w * (across - mu);
        ret->zeta[i] = zeta + w * (bulk - zeta);
    }
}

static void viscous_mix_all(const struct viscous_mix_state *state, struct viscous_mix_sums *sums,
                            struct viscous_mix *ret)
{
    const struct model *path = state->strain->path;
    size_t n = state->strain->n, bytes = n * sizeof *ret->mu;
    double *rows[] = {ret->mu, ret->zeta, sums->squares, sums->fluidity, sums->longwise};
    struct viscous_mix_material material; /* large: filled as far as it is used */
    for (size_t i = 0; i < (state->strain->interface ? sizeof rows / sizeof *rows : 2); i++) memset(rows[i], 0, bytes);
    for (unsigned l = 0; l < path->n_material; l++) {
        viscous_mix_material(state, ret, l, &material);
        viscous_mix_add(state, l, &material, sums, ret);
    }
    if (state->strain->interface) viscous_mix_across(n, sums, state->strain->sharp, ret);
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
    viscous_mix_plain(strain->n, ret->mu, ret->zeta, ret->iso);
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

void viscous_mix_stress(const struct viscous_strain *strain, const struct viscous_mix *mix, unsigned i, unsigned axis,
                        double *tau)
{
    const double *D = strain->D[elastic_component(i, axis)];
    size_t n = strain->n;
    if (i == axis) viscous_mix_press(n, mix->mu, D, mix->iso, strain->div, tau);
    else viscous_mix_twice(n, mix->mu, D, tau);
}

static BULLA_KERNEL void viscous_mix_film_of(size_t n, const double *restrict mu,
                                             const struct viscous_strain *restrict strain, unsigned i, unsigned j,
                                             double *restrict tau)
{
    const double *restrict D = strain->D[elastic_component(i, j)], *restrict m_i = strain->colour[i],
                           *restrict m_j = strain->colour[j], *restrict q_i = strain->along[i],
                           *restrict q_j = strain->along[j], *restrict div = strain->div,
                           *restrict normal = strain->normal;
    const double one = i == j ? 1.0 : 0.0;
#pragma omp simd
    for (size_t k = 0; k < n; k++) {
        double both = m_i[k] * m_j[k], across = normal[k], turned = D[k] - (m_i[k] * q_j[k] + q_i[k] * m_j[k]);
        tau[k] = 2.0 * mu[k] * ((turned + across * both) + (div[k] - across) * (one - both));
    }
}

void viscous_mix_film(const struct viscous_strain *strain, const double *mu, unsigned i, unsigned j, double *tau)
{
    viscous_mix_film_of(strain->n, mu, strain, i, j, tau);
}

static BULLA_KERNEL void viscous_mix_film_ring(size_t n, const double *restrict mu,
                                               const struct viscous_strain *restrict strain, double *restrict tau)
{
    const double *restrict hoop = strain->hoop, *restrict div = strain->div, *restrict normal = strain->normal;
#pragma omp simd
    for (size_t k = 0; k < n; k++) tau[k] = 2.0 * mu[k] * (hoop[k] + (div[k] - normal[k]));
}

void viscous_mix_film_hoop(const struct viscous_strain *strain, const double *mu, double *tau)
{
    viscous_mix_film_ring(strain->n, mu, strain, tau);
}

void viscous_mix_hoop(const struct viscous_strain *strain, const struct viscous_mix *mix, double *tau)
{
    viscous_mix_press(strain->n, mix->mu, strain->hoop, mix->iso, strain->div, tau);
}
