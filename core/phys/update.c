/* update.c - see update.h. */
#include "phys/update.h"

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

/* The same for alpha* u*. */
static BULLA_KERNEL void update_row_product(size_t n, double a, const double *restrict lower,
                                            const double *restrict upper, const double *restrict u_lower,
                                            const double *restrict u_upper, double *restrict rate)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double low = lower[i] * u_lower[i], up = upper[i] * u_upper[i], old = rate[i];
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

/* alpha* u* of a row of faces, for which the curved row has no form of its own. */
static BULLA_KERNEL void update_product(size_t n, const double *restrict a, const double *restrict b,
                                        double *restrict product)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) product[i] = a[i] * b[i];
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
    const double *w;
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

static void update_fraction(const struct update_target *target, const struct update_span *span, unsigned l)
{
    const double *alpha = target->work->alpha + l * FACE_ROOM + span->face, *u = target->work->u + span->face;
    double *rate = target->rates + l * target->n_cell + span->cell;
    const struct metric *metric = target->metric;
    if (target->curved) {
        double product[METRIC_CELLS + 1];
        update_product(span->n + 1, alpha, u, product);
        update_curved(span->n, metric->area, metric->volume, product, update_zero, rate);
    } else update_row_product(span->n, target->a, alpha, alpha + span->step, u, u + span->step, rate);
}

static void update_span_add(const struct update_target *target, const struct update_span *span)
{
    const struct model *model = target->model;
    const struct face_work *work = target->work;
    const double *pressure = target->w + model->i_E * target->n_cell;
    for (unsigned l = 0; l < model->n_alpha; l++) update_fraction(target, span, l);
    for (unsigned l = 0; l < model->n_material; l++)
        update_component(target, span, work->m + l * FACE_ROOM, model->i_m + l, NULL);
    for (unsigned d = 0; d < (unsigned)model->dim; d++)
        update_component(target, span, work->momentum + d * FACE_ROOM, model->i_u + frame_component(target->axis, d),
                         d == 0 ? pressure : NULL);
    update_component(target, span, work->energy, model->i_E, NULL);
    if (model->n_alpha) update_component(target, span, work->u, model->n_field, NULL);
}

void update_add(const struct model *model, const struct level *level, const struct metric *metric,
                const struct frame *frame, const struct face_work *work, size_t n_cell, const double *w, double *rates)
{
    struct update_target target = {.model = model,
                                   .metric = metric,
                                   .work = work,
                                   .w = w,
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

/* alpha after transport (bounded by 0 and 1), then after K: a step below the least value, or
 * below what transport left if that is less, is cut. Adds to the sum over materials. */
static BULLA_KERNEL void update_alpha(size_t n, double dt, const double *restrict old, const double *restrict alpha,
                                      const double *restrict rate, const double *restrict div, const double *restrict K,
                                      double *restrict now, double *restrict sum, double *restrict cut)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        /* rates hold -div(alpha u) and, in `div`, -div u */
        double before = old[i], a = alpha[i], change = rate[i], spread = -div[i], k = K[i], total = sum[i],
               count = cut[i];
        double moved = before + dt * (change + a * spread);
        double bounded = moved > 0.0 ? moved : 0.0;
        bounded = bounded < 1.0 ? bounded : 1.0;
        double least = bounded < UPDATE_LEAST ? bounded : UPDATE_LEAST;
        double wanted = bounded + dt * (k * spread), next = wanted > least ? wanted : least;
        next = next < 1.0 ? next : 1.0;
        double acted = next != wanted ? 1.0 : 0.0;
        now[i] = next;
        sum[i] = total + next;
        cut[i] = count + acted;
    }
}

static BULLA_KERNEL void update_normalise(size_t n, const double *restrict sum, double *restrict alpha)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) alpha[i] /= sum[i];
}

size_t update_apply(const struct model *model, size_t n_cell, double dt, const struct update_input *in, double *u_new)
{
    enum { BATCH = 512 };
    size_t clipped = 0;
    for (unsigned q = model->n_alpha; q < model->n_field; q++)
        update_step(n_cell, dt, in->u_old + q * n_cell, in->rates + q * n_cell, u_new + q * n_cell);
    for (size_t from = 0; model->n_alpha && from < n_cell; from += BATCH) {
        size_t n = n_cell - from < BATCH ? n_cell - from : BATCH;
        double sum[BATCH] = {0}, cut[BATCH] = {0};
        const double *div = in->rates + model->n_field * n_cell + from;
        for (unsigned l = 0; l < model->n_alpha; l++)
            update_alpha(n, dt, in->u_old + l * n_cell + from, in->w + l * n_cell + from, in->rates + l * n_cell + from,
                         div, in->K + l * n_cell + from, u_new + l * n_cell + from, sum, cut);
        for (unsigned l = 0; l < model->n_alpha; l++) update_normalise(n, sum, u_new + l * n_cell + from);
        for (size_t i = 0; i < n; i++) clipped += cut[i] > 0.0;
    }
    return clipped;
}
