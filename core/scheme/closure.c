/* closure.c - see closure.h. */
#include "scheme/closure.h"

#include "phys/mix.h"
#include "scheme/convection.h"
#include "scheme/exchange.h"
#include "scheme/response.h"
#include "scheme/terms.h"

#include <string.h>

enum { CLOSURE_BATCH = 512 };

bool closure_wanted(const struct model *path)
{
    return path->kapila;
}

/* Whoever moves volume asks for it. */
static void closure_begin(struct term_tile *tile)
{
    mix_stiffness_everywhere(tile->model, tile->n_cell, tile->n_cell, tile->w, tile->rho_c2);
}

static void closure_cells(struct term_tile *tile)
{
    mix_closure(tile->model, tile->n_cell, tile->n_cell, tile->w, response_stiffness(tile), tile->K);
}

/* alpha after K div u and the exchange. A step below the least value, or below what transport left if that is less, is
 * cut; counted is what lacks more than a trace. */
static BULLA_KERNEL void closure_bound(size_t n, double dt, const double *restrict K, const double *restrict div,
                                       const double *restrict exchange, double *restrict alpha, double *restrict cut)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], count = cut[i], push = -dt * (K[i] * div[i]), moved = exchange[i];
        double most = CLOSURE_SHRINK * a, kept = most > CLOSURE_LEAST ? most : CLOSURE_LEAST;
        double least = a < kept ? a : kept, wanted = a + (push + moved), next = wanted > least ? wanted : least;
        next = next < 1.0 ? next : 1.0;
        double over = wanted - next, under = next - wanted;
        double acted = over > CLOSURE_TRACE || under > CLOSURE_TRACE ? 1.0 : 0.0;
        alpha[i] = next;
        cut[i] = count + acted;
    }
}

/* A fraction holds its mass at no more than the density `per` is the reciprocal of. */
static BULLA_KERNEL void closure_hold(size_t n, double per, const double *restrict m, double *restrict alpha)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], least = m[i] * per, more = least > a ? least : a;
        alpha[i] = more < 1.0 ? more : a;
    }
}

static size_t closure_apply(const struct term_tile *tile, double *u_new)
{
    const struct model *model = tile->model;
    const double *div = tile->rates + terms_first(tile->terms, &convection_term) * tile->n_cell;
    const double *exchange = exchange_volume(tile);
    size_t clipped = 0;
    for (size_t from = 0; from < tile->n_cell; from += CLOSURE_BATCH) {
        size_t n = tile->n_cell - from < CLOSURE_BATCH ? tile->n_cell - from : CLOSURE_BATCH;
        double cut[CLOSURE_BATCH], *alpha = u_new + model->i_alpha * tile->n_cell + from;
        memset(cut, 0, n * sizeof *cut);
        for (unsigned l = 0; l < model->n_alpha; l++) {
            size_t row = l * tile->n_cell + from;
            closure_bound(n, tile->dt, tile->K + row, div + from, exchange + row, alpha + l * tile->n_cell, cut);
            if (!model->eos[l].stiffens) continue;
            closure_hold(n, 1.0 / (CLOSURE_DENSE * model->eos[l].rho_most),
                         u_new + (model->i_m + l) * tile->n_cell + from, alpha + l * tile->n_cell);
        }
        for (size_t i = 0; i < n; i++) clipped += cut[i] > 0.0;
    }
    return clipped;
}

const struct term closure_term = {
    .name = "closure",
    .owner = "core/scheme/closure.c",
    .equation = "d alpha_l/dt += K_l div u* + exchange; no step below a quarter of a fraction",
    .wanted = closure_wanted,
    .begin = closure_begin,
    .cells = closure_cells,
    .apply = closure_apply,
};
