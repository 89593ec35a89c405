/* update.c - see update.h. */
#include "scheme/update.h"

#include "phys/elastic.h"
#include "phys/traction.h"

enum { UPDATE_BATCH = 512 };

#include <float.h>
#include <math.h>
#include <string.h>

/* rate -= a (upper - lower) */
static BULLA_KERNEL void update_row(size_t n, double a, const double *restrict lower, const double *restrict upper,
                                    double *restrict rate)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double low = lower[i], up = upper[i], old = rate[i];
        rate[i] = old - a * (up - low);
    }
}

/* A row of cells of one tile along axis 0 in curved coordinates: rate -= (A+ (F+ - q) - A- (F- - q)) / V;
 * q is the cell's pressure for the radial momentum, else a row of zeros. */
static BULLA_KERNEL void update_curved(size_t n, const double *restrict area, const double *restrict volume,
                                       const double *restrict flux, const double *restrict q, double *restrict rate)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double low = flux[i], up = flux[i + 1], inside = q[i], old = rate[i];
        rate[i] = old - (area[i + 1] * (up - inside) - area[i] * (low - inside)) / volume[i];
    }
}

/* For components that no cell value is taken off. */
static const double update_zero[METRIC_CELLS];

/* One row of consecutive cells: where its faces start and where its cells lie in the tile. */
struct update_span {
    size_t face, cell, n, step;
};

struct update_target {
    const struct model *model;
    const struct metric *metric;
    const struct face_work *work;
    const double *hoop;
    double *rates;
    size_t n_cell;
    double a;    /* 1/h of the axis */
    bool curved; /* axis 0 of a curved geometry */
    int axis;
};

static void update_component(const struct update_target *target, const struct update_span *span, const double *flux,
                             unsigned q, const double *balance)
{
    double *rate = target->rates + q * target->n_cell + span->cell;
    const struct metric *metric = target->metric;
    if (target->curved)
        update_curved(span->n, metric->area, metric->volume, flux + span->face,
                      balance ? balance + span->cell : update_zero, rate);
    else update_row(span->n, target->a, flux + span->face, flux + span->face + span->step, rate);
}

/* The stretch that comes in, and the velocity gradient along the axis: plain differences in all geometries. Tangential
 * velocities are those that the cell itself sees, as the right neighbour of its lower face and the left one of its upper. */
static void update_strain(const struct update_target *target, const struct update_span *span)
{
    const struct model *model = target->model;
    const struct face_work *work = target->work;
    size_t lower = span->face, upper = span->face + span->step;
    for (unsigned c = 0; c < model->n_stretch; c++)
        update_component(target, span, work->stretch + c * FACE_ROOM, model->i_V + c, NULL);
    for (unsigned d = 0; d < model->n_velocity; d++) {
        unsigned i = axis_component(target->axis, d);
        size_t q = update_gradient(model) + i * (unsigned)model->dim + (unsigned)target->axis;
        const double *below = d ? work->slide_right + (d - 1) * FACE_ROOM : work->u;
        const double *above = d ? work->slide_left + (d - 1) * FACE_ROOM : work->u;
        update_row(span->n, target->a, below + lower, above + upper, target->rates + q * target->n_cell + span->cell);
    }
    if (!model->n_alpha) return;
    size_t q = update_gradient(model) + model->n_velocity * (unsigned)model->dim + (unsigned)target->axis;
    update_row(span->n, target->a, work->solid + lower, work->solid + upper,
               target->rates + q * target->n_cell + span->cell);
}

static void update_span_add(const struct update_target *target, const struct update_span *span)
{
    const struct model *model = target->model;
    const struct face_work *work = target->work;
    for (unsigned l = 0; l < model->n_alpha; l++) {
        update_component(target, span, work->alpha + l * FACE_ROOM, model->i_alpha + l, NULL);
        if (!model->kapila) continue;
        update_component(target, span, work->carried + l * FACE_ROOM, model->n_field + 1 + l, NULL);
        update_component(target, span, work->strained + l * FACE_ROOM, model->n_field + 1 + model->n_alpha + l, NULL);
    }
    for (unsigned l = 0; l < model->n_material; l++)
        update_component(target, span, work->m + l * FACE_ROOM, model->i_m + l, NULL);
    for (unsigned d = 0; d < model->n_velocity; d++)
        update_component(target, span, work->momentum + d * FACE_ROOM, model->i_u + axis_component(target->axis, d),
                         d == 0 ? target->hoop : NULL);
    update_component(target, span, work->energy, model->i_E, NULL);
    if (model->n_alpha | model->n_stretch) update_component(target, span, work->u, model->n_field, NULL);
    if (model->n_stretch) update_strain(target, span);
}

void update_add(const struct model *model, const struct level *level, const struct metric *metric,
                const struct frame *frame, const struct face_work *work, size_t n_cell, const double *hoop,
                double *rates)
{
    struct update_target target = {.model = model,
                                   .metric = metric,
                                   .work = work,
                                   .hoop = hoop,
                                   .rates = rates,
                                   .n_cell = n_cell,
                                   .a = 1.0 / level->h[frame->axis],
                                   .curved = model->beta > 0 && frame->axis == 0,
                                   .axis = frame->axis};
    bool whole = frame->inner == frame->tile_inner; /* then the rows of an outer slice follow each other */
    size_t rows = whole ? 1 : frame->n, length = whole ? frame->n * frame->inner : frame->inner;
    for (size_t o = 0; o < frame->outer; o++)
        for (size_t row = 0; row < rows; row++) {
            struct update_span span = {.face = face_at(frame, o, row),
                                       .cell = frame_tile_at(frame, o, row),
                                       .n = length,
                                       .step = frame->inner};
            update_span_add(&target, &span);
        }
}

static BULLA_KERNEL void update_step(size_t n, double dt, const double *restrict old, const double *restrict rate,
                                     double *restrict now)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) now[i] = old[i] + dt * rate[i];
}

/* alpha after transport, bounded by 0 and 1. Rates hold -div(alpha u) and, in `div`, -div u. */
static BULLA_KERNEL void update_transport(size_t n, double dt, const double *restrict old, const double *restrict alpha,
                                          const double *restrict rate, const double *restrict div, double *restrict now)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double moved = old[i] + dt * (rate[i] - alpha[i] * div[i]);
        moved = moved > 0.0 ? moved : 0.0;
        now[i] = moved < 1.0 ? moved : 1.0;
    }
}

/* Arrays of one batch in update_relax: what transport left behind. */
struct update_misfit {
    double own[SCENE_MATERIALS]
              [UPDATE_BATCH]; /* volume that a material would give or take: alpha (p_l - p)/(rho_l c_l^2) */
    double sum[UPDATE_BATCH], compliance[UPDATE_BATCH]; /* over materials: of the above, of alpha/(rho_l c_l^2) */
    double rho[UPDATE_BATCH], stiffness[UPDATE_BATCH];  /* of the mixture: sum alpha rho_l, sum alpha rho_l c_l^2 */
    double speed2[UPDATE_BATCH], share[UPDATE_BATCH];   /* |u|^2; how much of the exchange is made */
    double push[UPDATE_BATCH], strain[UPDATE_BATCH];    /* what all volume brought: pressure excess, strain [1/s] */
    double stiffest[UPDATE_BATCH];                      /* largest rho_l c_l^2 */
};

/* One material's misfit: from the pressure and from the strain that its volume carried. */
static BULLA_KERNEL void update_own_misfit(size_t n, double dt, const double *restrict carried,
                                           const double *restrict strained, const double *restrict rate,
                                           const double *restrict p, const double *restrict rho_c2,
                                           double *restrict own, double *restrict sum)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double s = rho_c2[i], q = dt * (carried[i] - p[i] * rate[i]), strain = dt * strained[i], m = sum[i];
        double volume = s > 0.0 ? q / s + strain : 0.0;
        own[i] = volume;
        sum[i] = m + volume;
    }
}

/* One material's part of the mixture's density and stiffnesses. */
static BULLA_KERNEL void update_mixture(size_t n, const double *restrict alpha, const double *restrict rho_l,
                                        const double *restrict rho_c2, double *restrict rho, double *restrict stiffness,
                                        double *restrict compliance)
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

static BULLA_KERNEL void update_speed2(size_t n, const double *restrict u, double *restrict speed2)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) speed2[i] += u[i] * u[i];
}

/* r^2/(r^2 + k^2) with r = |u| c_f/c_w^2, c_f^2 = sum alpha rho_l c_l^2/rho, 1/(rho c_w^2) = sum alpha/(rho_l c_l^2). */
static BULLA_KERNEL void update_share(size_t n, const double *restrict speed2, const double *restrict rho,
                                      const double *restrict stiffness, const double *restrict compliance,
                                      double *restrict share)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double c = compliance[i], r2 = speed2[i] * rho[i] * stiffness[i] * (c * c);
        r2 = r2 > 0.0 ? r2 : 0.0;
        share[i] = r2 / (r2 + UPDATE_FAST * UPDATE_FAST);
    }
}

/* One material's part of the pressure and the strain that volume brings to a cell. */
static BULLA_KERNEL void update_bring(size_t n, const double *restrict carried, const double *restrict strained,
                                      const double *restrict rate, const double *restrict p,
                                      const double *restrict rho_c2, double *restrict push, double *restrict strain,
                                      double *restrict stiffest)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double q = carried[i] - p[i] * rate[i], e = strained[i], s = rho_c2[i];
        double all = push[i], stretched = strain[i], most = stiffest[i];
        push[i] = all + q;
        strain[i] = stretched + e;
        stiffest[i] = s > most ? s : most;
    }
}

/* The share where all of the exchange is wanted: 1 up to X = UPDATE_STEEP, X what a cell of size h sees of p/K and of
 * strain from end to end, |u| X/h = |push|/K + |strain|; beyond, what speed alone asks for. */
static BULLA_KERNEL void update_share_all(size_t n, double h, const double *restrict speed2,
                                          const double *restrict push, const double *restrict strain,
                                          const double *restrict stiffest, double *restrict share)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double fast = share[i], flow = speed2[i] * speed2[i], all = push[i], stretched = strain[i], K = stiffest[i];
        double part = fabs(all) / K, rate = (K > 0.0 ? part : DBL_MAX) + fabs(stretched);
        double x = rate * h / UPDATE_STEEP, steep = x * x;
        double gentle = flow / (flow + steep * steep + DBL_MIN);
        share[i] = fast + (1.0 - fast) * gentle;
    }
}

/* The share, less where a material would lose more than UPDATE_MOST of its volume, or gain more than that and UPDATE_TRACE
 * of the cell: gas near vacuum makes linear relaxation say anything. All materials of a cell exchange with the same
 * share, so that the sum stays. */
static BULLA_KERNEL void update_temper(size_t n, const double *restrict rho_c2, const struct update_misfit *misfit,
                                       const double *restrict own, const double *restrict alpha, double *restrict share)
{
    const double *restrict sum = misfit->sum, *restrict compliance = misfit->compliance;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], s = rho_c2[i], c = compliance[i], all = sum[i], old = share[i];
        double part = a / (s * c), move = own[i] - (s > 0.0 ? part : 0.0) * all, size = old * fabs(move);
        double most = UPDATE_MOST * a + (move > 0.0 ? UPDATE_TRACE : 0.0), less = old * (most / size);
        share[i] = size > most ? less : old;
    }
}

/* alpha after the closure: K div u, and the exchange of volume that brings the materials back to one
 * pressure. A step below the least value, or below what transport left if that is less, is cut. */
static BULLA_KERNEL void update_close(size_t n, double dt, const double *restrict K, const double *restrict div,
                                      const double *restrict rho_c2, const struct update_misfit *misfit,
                                      const double *restrict own, double *restrict alpha, double *restrict cut)
{
    const double *restrict sum = misfit->sum, *restrict compliance = misfit->compliance,
                           *restrict share = misfit->share;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], s = rho_c2[i], c = compliance[i], count = cut[i], push = -dt * (K[i] * div[i]);
        double part = a / (s * c), all = sum[i], exchange = share[i] * (own[i] - (s > 0.0 ? part : 0.0) * all);
        double most = UPDATE_SHRINK * a, kept = most > UPDATE_LEAST ? most : UPDATE_LEAST, least = a < kept ? a : kept;
        double wanted = a + (push + exchange), next = wanted > least ? wanted : least;
        next = next < 1.0 ? next : 1.0;
        double acted = next != wanted ? 1.0 : 0.0;
        alpha[i] = next;
        cut[i] = count + acted;
    }
}

static BULLA_KERNEL void update_sum(size_t n, const double *restrict alpha, double *restrict sum)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) sum[i] += alpha[i];
}

static BULLA_KERNEL void update_normalise(size_t n, const double *restrict sum, double *restrict alpha)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) alpha[i] /= sum[i];
}

/* How much of the exchange is made in n cells, from `from` on. */
static void update_shares(const struct model *model, size_t n_cell, size_t from, size_t n,
                          const struct update_input *in, const double *p, struct update_misfit *misfit)
{
    const double *carried = in->rates + (model->n_field + 1) * n_cell + from,
                 *strained = carried + model->n_alpha * n_cell;
    update_share(n, misfit->speed2, misfit->rho, misfit->stiffness, misfit->compliance, misfit->share);
    if (!model->thermal) return;
    double *sums[] = {misfit->push, misfit->strain, misfit->stiffest};
    for (size_t i = 0; i < sizeof sums / sizeof *sums; i++) memset(sums[i], 0, n * sizeof **sums);
    for (unsigned l = 0; l < model->n_alpha; l++)
        update_bring(n, carried + l * n_cell, strained + l * n_cell, in->rates + (model->i_alpha + l) * n_cell + from,
                     p, in->rho_c2 + l * n_cell + from, misfit->push, misfit->strain, misfit->stiffest);
    update_share_all(n, in->h, misfit->speed2, misfit->push, misfit->strain, misfit->stiffest, misfit->share);
}

static BULLA_KERNEL void update_take(size_t n, const double *restrict mean, double *restrict p)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) p[i] -= mean[i];
}

/* The closure's part of the fractions of n cells from `from`; returns in how many a bound acted. */
static size_t update_relax(const struct model *model, size_t n_cell, size_t from, size_t n, double dt,
                           const struct update_input *in, double *u_new)
{
    struct update_misfit misfit;
    double cut[UPDATE_BATCH],
        *sums[] = {misfit.sum, misfit.compliance, misfit.rho, misfit.stiffness, misfit.speed2, cut};
    const double *w = in->w + from, *rho_c2 = in->rho_c2 + from, *rates = in->rates + from;
    const double *carried = rates + (model->n_field + 1) * n_cell, *strained = carried + model->n_alpha * n_cell;
    const double *moved = rates + model->i_alpha * n_cell;
    size_t clipped = 0;
    double p[UPDATE_BATCH], mean[UPDATE_BATCH];
    memcpy(p, w + model->i_E * n_cell, n * sizeof *p);
    if (model->split) traction_mean(model, n, n_cell, w, mean), update_take(n, mean, p);
    for (size_t i = 0; i < sizeof sums / sizeof *sums; i++) memset(sums[i], 0, n * sizeof *cut);
    u_new += from;
    double *alpha = u_new + model->i_alpha * n_cell;
    for (unsigned d = 0; d < model->n_velocity; d++) update_speed2(n, w + (model->i_u + d) * n_cell, misfit.speed2);
    for (unsigned l = 0; l < model->n_alpha; l++) {
        update_own_misfit(n, dt, carried + l * n_cell, strained + l * n_cell, moved + l * n_cell, p,
                          rho_c2 + l * n_cell, misfit.own[l], misfit.sum);
        update_mixture(n, alpha + l * n_cell, w + (model->i_m + l) * n_cell, rho_c2 + l * n_cell, misfit.rho,
                       misfit.stiffness, misfit.compliance);
    }
    update_shares(model, n_cell, from, n, in, p, &misfit);
    for (unsigned l = 0; l < model->n_alpha; l++)
        update_temper(n, rho_c2 + l * n_cell, &misfit, misfit.own[l], alpha + l * n_cell, misfit.share);
    for (unsigned l = 0; l < model->n_alpha; l++)
        update_close(n, dt, in->K + l * n_cell + from, rates + model->n_field * n_cell, rho_c2 + l * n_cell, &misfit,
                     misfit.own[l], alpha + l * n_cell, cut);
    for (size_t i = 0; i < n; i++) clipped += cut[i] > 0.0;
    return clipped;
}

/* -(K_s/alpha_s) div u of all solids together; 0 where there is none. */
static BULLA_KERNEL void update_squeeze(size_t n, const double *restrict K, const double *restrict alpha,
                                        const double *restrict div, double *restrict squeeze)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], share = K[i] / a;
        squeeze[i] = a > 0.0 ? share * div[i] : 0.0;
    }
}

/* The stretch of a tile: moved, faded where its solids are not, unimodular. */
static void update_stretch(const struct model *model, size_t n_cell, double dt, const struct update_input *in,
                           double *u_new)
{
    size_t first = model->i_V * n_cell, fraction = model->i_alpha * n_cell, mass = model->i_m * n_cell;
    for (size_t from = 0; from < n_cell; from += UPDATE_BATCH) {
        size_t n = n_cell - from < UPDATE_BATCH ? n_cell - from : UPDATE_BATCH;
        double solid[UPDATE_BATCH], K[UPDATE_BATCH], squeeze[UPDATE_BATCH], m_old[UPDATE_BATCH], m_new[UPDATE_BATCH];
        double *V = u_new + first + from;
        struct elastic_rates rates = {.carried = in->rates + first + from,
                                      .m_old = m_old,
                                      .m_new = m_new,
                                      .div = in->rates + model->n_field * n_cell + from,
                                      .gradient = in->rates + update_gradient(model) * n_cell + from};
        elastic_sum(model, n, n_cell, in->u_old + mass + from, m_old);
        elastic_sum(model, n, n_cell, u_new + mass + from, m_new);
        if (model->kapila) {
            elastic_sum(model, n, n_cell, in->K + from, K);
            elastic_sum(model, n, n_cell, in->w + fraction + from, solid);
            update_squeeze(n, K, solid, rates.div, squeeze);
            rates.squeeze = squeeze;
            rates.slope = rates.gradient + model->n_velocity * (unsigned)model->dim * n_cell;
        }
        elastic_advance(model, n, n_cell, dt, in->u_old + first + from, &rates, V);
        if (model->n_alpha) elastic_sum(model, n, n_cell, u_new + fraction + from, solid);
        if (model->n_alpha) elastic_fade(model, n, n_cell, solid, V);
    }
    elastic_unimodular(model, n_cell, n_cell, u_new + first);
}

double update_length(const struct level *level, int dim)
{
    double longest = level->h[0];
    for (int d = 1; d < dim; d++) longest = level->h[d] > longest ? level->h[d] : longest;
    return longest;
}

size_t update_apply(const struct model *model, size_t n_cell, double dt, const struct update_input *in, double *u_new)
{
    size_t clipped = 0;
    for (unsigned i = model->n_alpha; i < model->n_active - model->n_stretch; i++) {
        size_t at = model->active[i] * n_cell;
        update_step(n_cell, dt, in->u_old + at, in->rates + at, u_new + at);
    }
    for (size_t from = 0; model->n_alpha && from < n_cell; from += UPDATE_BATCH) {
        size_t n = n_cell - from < UPDATE_BATCH ? n_cell - from : UPDATE_BATCH, first = model->i_alpha * n_cell + from;
        double sum[UPDATE_BATCH], *alpha = u_new + first;
        const double *div = in->rates + model->n_field * n_cell + from;
        for (size_t l = 0; l < model->n_alpha; l++)
            update_transport(n, dt, in->u_old + first + l * n_cell, in->w + first + l * n_cell,
                             in->rates + first + l * n_cell, div, alpha + l * n_cell);
        memset(sum, 0, n * sizeof *sum);
        if (model->kapila) clipped += update_relax(model, n_cell, from, n, dt, in, u_new);
        for (size_t l = 0; l < model->n_alpha; l++) update_sum(n, alpha + l * n_cell, sum);
        for (size_t l = 0; l < model->n_alpha; l++) update_normalise(n, sum, alpha + l * n_cell);
    }
    if (model->n_stretch) update_stretch(model, n_cell, dt, in, u_new);
    return clipped;
}
