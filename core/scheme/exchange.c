/* exchange.c - see exchange.h. */
#include "scheme/exchange.h"

#include "phys/row.h"
#include "phys/traction.h"
#include "scheme/response.h"
#include "scheme/terms.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { EXCHANGE_BATCH = 512 };

static unsigned exchange_rows(const struct model *path)
{
    return 2 * path->n_alpha;
}

static void exchange_list(struct terms *terms, int axis, unsigned first, const struct face_work *faces)
{
    const struct model *model = terms->model;
    static const char *const names[] = {"carried", "strained"};
    for (unsigned k = 0; k < 2; k++)
        for (unsigned l = 0; l < model->n_alpha; l++) {
            const double *base = !faces ? NULL : k ? faces->strained : faces->carried;
            const double *row = base ? base + l * FACE_ROOM : NULL;
            struct term_flux flux = {.below = row, .above = row, .rate = first + k * model->n_alpha + l};
            terms_flux(terms, axis, flux, names[k], model->scene->material[model->first + l].name);
        }
}

/* Arrays of one batch: what transport left behind. */
struct exchange_misfit {
    double own[SCENE_MATERIALS]
              [EXCHANGE_BATCH]; /* volume that a material would give or take: alpha (p_l - p)/(rho_l c_l^2) */
    double sum[EXCHANGE_BATCH], compliance[EXCHANGE_BATCH]; /* over materials: of the above, of alpha/(rho_l c_l^2) */
    double rho[EXCHANGE_BATCH], stiffness[EXCHANGE_BATCH];  /* of the mixture: sum alpha rho_l, sum alpha rho_l c_l^2 */
    double speed2[EXCHANGE_BATCH], share[EXCHANGE_BATCH];   /* |u|^2; how much of the exchange is made */
    double push[EXCHANGE_BATCH], strain[EXCHANGE_BATCH];    /* what all volume brought: pressure excess, strain [1/s] */
    double stiffest[EXCHANGE_BATCH];                        /* largest rho_l c_l^2 */
    double p[EXCHANGE_BATCH];                               /* p, or the traction -s_nn where that is common */
};

/* A batch of a tile: rows begin at its first cell. */
struct exchange_batch {
    const struct model *model;
    size_t n, stride;
    double dt, h;                              /* h: size of a cell, the longest side [m] */
    const double *w, *rho_c2, *own_c2, *moved; /* moved: rates of the fractions by transport */
    double *carried, *strained;
    const double *alpha; /* after transport */
};

/* One material's misfit: from the pressure and from the strain that its volume carried. */
static BULLA_KERNEL void exchange_own(size_t n, double dt, const double *restrict carried,
                                      const double *restrict strained, const double *restrict rate,
                                      const double *restrict p, const double *restrict rho_c2,
                                      const double *restrict stiff, double *restrict own, double *restrict sum)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double s = stiff[i], q = dt * (carried[i] - p[i] * rate[i]), strain = dt * strained[i] * (rho_c2[i] / s),
               m = sum[i];
        double volume = s > 0.0 ? q / s + strain : 0.0;
        own[i] = volume;
        sum[i] = m + volume;
    }
}

/* One material's part of the mixture's density and stiffnesses. */
static BULLA_KERNEL void exchange_mixture(size_t n, const double *restrict alpha, const double *restrict rho_l,
                                          const double *restrict rho_c2, double *restrict rho,
                                          double *restrict stiffness, double *restrict compliance)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], s = rho_c2[i], r = rho[i], stiff = stiffness[i], soft = compliance[i], d = rho_l[i];
        double part = a / s;
        rho[i] = r + a * d;
        stiffness[i] = stiff + a * s;
        compliance[i] = soft + (s > 0.0 ? part : 0.0);
    }
}

static BULLA_KERNEL void exchange_speed2(size_t n, const double *restrict u, double *restrict speed2)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) speed2[i] += u[i] * u[i];
}

/* r^2/(r^2 + k^2) with r = |u| c_f/c_w^2, c_f^2 = sum alpha rho_l c_l^2/rho, 1/(rho c_w^2) = sum alpha/(rho_l
 * c_l^2). */
static BULLA_KERNEL void exchange_fast(size_t n, const double *restrict speed2, const double *restrict rho,
                                       const double *restrict stiffness, const double *restrict compliance,
                                       double *restrict share)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double c = compliance[i], r2 = speed2[i] * rho[i] * stiffness[i] * (c * c);
        r2 = r2 > 0.0 ? r2 : 0.0;
        share[i] = r2 / (r2 + EXCHANGE_FAST * EXCHANGE_FAST);
    }
}

/* One material's part of the pressure and the strain that volume brings to a cell; one that is not there is not
 * stiff. */
static BULLA_KERNEL void exchange_bring(size_t n, const double *restrict carried, const double *restrict strained,
                                        const double *restrict rate, const double *restrict p,
                                        const double *restrict rho_c2, const double *restrict alpha,
                                        double *restrict push, double *restrict strain, double *restrict stiffest)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double q = carried[i] - p[i] * rate[i], e = strained[i], s = alpha[i] > 0.0 ? rho_c2[i] : 0.0;
        double all = push[i], stretched = strain[i], most = stiffest[i];
        push[i] = all + q;
        strain[i] = stretched + e;
        stiffest[i] = s > most ? s : most;
    }
}

/* The share where all of the exchange is wanted: 1 up to X = EXCHANGE_STEEP, X what a cell of size h sees of p/K and of
 * strain from end to end, |u| X/h = |push|/K + |strain|; beyond, what speed alone asks for. */
static BULLA_KERNEL void exchange_gentle(size_t n, double h, const double *restrict speed2, const double *restrict push,
                                         const double *restrict strain, const double *restrict stiffest,
                                         double *restrict share)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double fast = share[i], flow = speed2[i] * speed2[i], all = push[i], stretched = strain[i], K = stiffest[i];
        double part = fabs(all) / K, rate = (K > 0.0 ? part : DBL_MAX) + fabs(stretched);
        double x = rate * h / EXCHANGE_STEEP, steep = x * x;
        double gentle = flow / (flow + steep * steep + DBL_MIN);
        share[i] = fast + (1.0 - fast) * gentle;
    }
}

/* The share, less where a material would lose more than EXCHANGE_MOST of its volume, or gain more than that and
 * EXCHANGE_TRACE of the cell: gas near vacuum makes linear relaxation say anything. All materials of a cell exchange
 * with the same share, so that the sum stays. */
static BULLA_KERNEL void exchange_temper(size_t n, const double *restrict rho_c2, const struct exchange_misfit *misfit,
                                         const double *restrict own, const double *restrict alpha,
                                         double *restrict share)
{
    const double *restrict sum = misfit->sum, *restrict compliance = misfit->compliance;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], s = rho_c2[i], c = compliance[i], all = sum[i], old = share[i];
        double part = a / (s * c), move = own[i] - (s > 0.0 ? part : 0.0) * all, size = old * fabs(move);
        double most = EXCHANGE_MOST * a + (move > 0.0 ? EXCHANGE_TRACE : 0.0), less = old * (most / size);
        share[i] = size > most ? less : old;
    }
}

/* d alpha of one material; of one that is alone 0, exactly (phys/mix.c has the same for K). */
static BULLA_KERNEL void exchange_make(size_t n, const double *restrict rho_c2, const struct exchange_misfit *misfit,
                                       const double *restrict own, const double *restrict alpha,
                                       double *restrict volume)
{
    const double *restrict sum = misfit->sum, *restrict compliance = misfit->compliance,
                           *restrict share = misfit->share;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], s = rho_c2[i], c = compliance[i], part = a / (s * c), all = sum[i];
        double given = share[i] * (own[i] - (s > 0.0 ? part : 0.0) * all);
        volume[i] = a < 1.0 ? given : 0.0;
    }
}

/* How much of the exchange is made. */
static void exchange_shares(const struct exchange_batch *in, struct exchange_misfit *misfit)
{
    const struct model *model = in->model;
    size_t n = in->n, stride = in->stride;
    exchange_fast(n, misfit->speed2, misfit->rho, misfit->stiffness, misfit->compliance, misfit->share);
    if (!model->thermal) return;
    double *sums[] = {misfit->push, misfit->strain, misfit->stiffest};
    for (size_t i = 0; i < sizeof sums / sizeof *sums; i++) memset(sums[i], 0, n * sizeof **sums);
    for (unsigned l = 0; l < model->n_alpha; l++)
        exchange_bring(n, in->carried + l * stride, in->strained + l * stride, in->moved + l * stride, misfit->p,
                       in->rho_c2 + l * stride, in->alpha + l * stride, misfit->push, misfit->strain, misfit->stiffest);
    exchange_gentle(n, in->h, misfit->speed2, misfit->push, misfit->strain, misfit->stiffest, misfit->share);
}

/* What each material would exchange, and the sums that this is judged by. */
static void exchange_judge(const struct exchange_batch *in, struct exchange_misfit *misfit)
{
    const struct model *model = in->model;
    size_t n = in->n, stride = in->stride;
    double mean[EXCHANGE_BATCH],
        *sums[] = {misfit->sum, misfit->compliance, misfit->rho, misfit->stiffness, misfit->speed2};
    memcpy(misfit->p, in->w + model->i_E * stride, n * sizeof *misfit->p);
    if (model->split) traction_mean(model, n, stride, in->w, mean), row_take(n, mean, misfit->p);
    for (size_t i = 0; i < sizeof sums / sizeof *sums; i++) memset(sums[i], 0, n * sizeof **sums);
    for (unsigned d = 0; d < model->n_velocity; d++)
        exchange_speed2(n, in->w + (model->i_u + d) * stride, misfit->speed2);
    for (unsigned l = 0; l < model->n_alpha; l++) {
        const double *rho_c2 = in->rho_c2 + l * stride;
        exchange_own(n, in->dt, in->carried + l * stride, in->strained + l * stride, in->moved + l * stride, misfit->p,
                     in->own_c2 + l * stride, rho_c2, misfit->own[l], misfit->sum);
        exchange_mixture(n, in->alpha + l * stride, in->w + (model->i_m + l) * stride, rho_c2, misfit->rho,
                         misfit->stiffness, misfit->compliance);
    }
}

static double exchange_length(const struct level *level, int dim)
{
    double longest = level->h[0];
    for (int d = 1; d < dim; d++) longest = level->h[d] > longest ? level->h[d] : longest;
    return longest;
}

/* Leaves the volumes where the pressures were. */
static size_t exchange_apply(const struct term_tile *tile, double *u_new)
{
    const struct model *model = tile->model;
    double *carried = tile->rates + terms_first(tile->terms, &exchange_term) * tile->n_cell;
    for (size_t from = 0; from < tile->n_cell; from += EXCHANGE_BATCH) {
        struct exchange_misfit misfit; /* large: filled as far as it is used */
        const struct exchange_batch in = {.model = model,
                                          .n = tile->n_cell - from < EXCHANGE_BATCH ? tile->n_cell - from
                                                                                    : EXCHANGE_BATCH,
                                          .stride = tile->n_cell,
                                          .dt = tile->dt,
                                          .h = exchange_length(tile->level, model->dim),
                                          .w = tile->w + from,
                                          .rho_c2 = response_stiffness(tile) + from,
                                          .own_c2 = tile->rho_c2 + from,
                                          .moved = tile->rates + model->i_alpha * tile->n_cell + from,
                                          .carried = carried + from,
                                          .strained = carried + model->n_alpha * tile->n_cell + from,
                                          .alpha = u_new + model->i_alpha * tile->n_cell + from};
        exchange_judge(&in, &misfit);
        exchange_shares(&in, &misfit);
        for (unsigned l = 0; l < model->n_alpha; l++)
            exchange_temper(in.n, in.rho_c2 + l * in.stride, &misfit, misfit.own[l], in.alpha + l * in.stride,
                            misfit.share);
        for (unsigned l = 0; l < model->n_alpha; l++)
            exchange_make(in.n, in.rho_c2 + l * in.stride, &misfit, misfit.own[l], in.alpha + l * in.stride,
                          in.carried + l * in.stride);
    }
    return 0;
}

const double *exchange_volume(const struct term_tile *tile)
{
    return tile->rates + terms_first(tile->terms, &exchange_term) * tile->n_cell;
}

static bool exchange_wanted(const struct model *path)
{
    return path->kapila;
}

const struct term exchange_term = {
    .name = "exchange",
    .owner = "core/scheme/exchange.c",
    .equation = "d alpha_l = e_l - s_l/S sum e_k: what came in at another pressure gives it back",
    .wanted = exchange_wanted,
    .rows = exchange_rows,
    .list = exchange_list,
    .apply = exchange_apply,
};
