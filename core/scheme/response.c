/* response.c - see response.h. */
#include "scheme/response.h"

#include "phys/row.h"
#include "phys/settle.h"
#include "phys/traction_rate.h"
#include "scheme/convection.h"
#include "scheme/exchange.h"
#include "scheme/strain.h"
#include "scheme/terms.h"

#include <string.h>

enum { RESPONSE_BATCH = 256 };

/* On a line all solids; across surfaces that lie as they like those that flow, which settle afterwards. */
static bool response_wanted(const struct model *path)
{
    return path->split && (!path->n_normal || path->plastic) && path->n_alpha && path->kapila;
}

static unsigned response_rows(const struct model *path)
{
    return 2 * path->n_material;
}

static double *response_row(const struct term_tile *tile, unsigned k)
{
    return tile->rates + (terms_first(tile->terms, &response_term) + k * tile->model->n_material) * tile->n_cell;
}

/* One material's part of S and of sum alpha pull/M. What has no stiffness takes no part (phys/mix.c has the same for
 * K). */
static BULLA_KERNEL void response_add(size_t n, const double *restrict alpha, const double *restrict stiff,
                                      const double *restrict pull, double *restrict give, double *restrict pulled)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double s = stiff[i], part = alpha[i] / s, g = give[i], q = pulled[i];
        part = s > 0.0 ? part : 0.0;
        give[i] = g + part;
        pulled[i] = q + part * pull[i];
    }
}

static BULLA_KERNEL void response_own_of(size_t n, const double *restrict alpha, const double *restrict stiff,
                                         const double *restrict give, const double *restrict pulled,
                                         double *restrict pull)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double s = stiff[i], own = (pull[i] - pulled[i] / give[i]) / s, a = alpha[i];
        own = s > 0.0 ? own : 0.0;
        pull[i] = a < 1.0 && a > 0.0 ? own : 0.0;
    }
}

/* The solid of a cell in which fluids are traces, or 0: its stiffness is theirs. */
static BULLA_KERNEL void response_trace(size_t n, double least, const double *restrict solid,
                                        const double *restrict stiff, const double *restrict alpha,
                                        double *restrict own)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], s = solid[i], k = stiff[i], o = own[i];
        double trace = a < least && s > 1.0 - least && k > o ? 1.0 : 0.0;
        own[i] = trace > 0.0 ? k : o;
    }
}

static void response_traces(const struct term_tile *tile, double *stiff)
{
    const struct model *model = tile->model;
    size_t n_cell = tile->n_cell;
    const double *alpha = tile->w + model->i_alpha * n_cell;
    for (unsigned s = 0; s < model->n_solid; s++)
        for (unsigned l = 0; l < model->n_alpha; l++) {
            size_t solid = model->solids[s].material * n_cell;
            if (l == model->solids[s].material) continue;
            response_trace(n_cell, settle_trace(model), alpha + solid, stiff + solid, alpha + l * n_cell,
                           stiff + l * n_cell);
        }
}

static void response_cells(struct term_tile *tile)
{
    const struct model *model = tile->model;
    size_t n_cell = tile->n_cell;
    const struct traction_strain strain = {.div = tile->rates + terms_first(tile->terms, &convection_term) * n_cell,
                                           .gradient = tile->rates + terms_first(tile->terms, &strain_term) * n_cell};
    double *stiff = response_row(tile, 0), *own = response_row(tile, 1);
    traction_rate(model, n_cell, n_cell, tile->w, &strain, n_cell, stiff, own);
    row_add(model->n_material * n_cell, tile->rho_c2, stiff);
    if (model->plastic) response_traces(tile, stiff);
    for (size_t from = 0; from < n_cell; from += RESPONSE_BATCH) {
        size_t n = n_cell - from < RESPONSE_BATCH ? n_cell - from : RESPONSE_BATCH;
        double give[RESPONSE_BATCH], pulled[RESPONSE_BATCH];
        memset(give, 0, n * sizeof *give);
        memset(pulled, 0, n * sizeof *pulled);
        for (unsigned l = 0; l < model->n_alpha; l++) {
            size_t at = l * n_cell + from;
            response_add(n, tile->w + model->i_alpha * n_cell + at, stiff + at, own + at, give, pulled);
        }
        for (unsigned l = 0; l < model->n_alpha; l++) {
            size_t at = l * n_cell + from;
            response_own_of(n, tile->w + model->i_alpha * n_cell + at, stiff + at, give, pulled, own + at);
        }
    }
}

/* Volume that a step moves. */
static BULLA_KERNEL void response_move(size_t n, double dt, const double *restrict alpha, const double *restrict own,
                                       double *restrict volume)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double v = volume[i];
        volume[i] = v - dt * (alpha[i] * own[i]);
    }
}

static size_t response_apply(const struct term_tile *tile, double *u_new)
{
    const struct model *model = tile->model;
    size_t rows = model->n_alpha * tile->n_cell;
    double *volume = tile->rates + terms_first(tile->terms, &exchange_term) * tile->n_cell;
    (void)u_new;
    response_move(rows, tile->dt, tile->w + model->i_alpha * tile->n_cell, response_row(tile, 1), volume);
    return 0;
}

const double *response_stiffness(const struct term_tile *tile)
{
    return response_wanted(tile->model) ? response_row(tile, 0) : tile->rho_c2;
}

const double *response_own(const struct term_tile *tile)
{
    return response_wanted(tile->model) ? response_row(tile, 1) : NULL;
}

const struct term response_term = {
    .name = "response",
    .owner = "core/scheme/response.c",
    .equation = "d alpha_l/dt -= alpha_l own_l: solids share the strain of a cell by their stiffness along n",
    .wanted = response_wanted,
    .rows = response_rows,
    .cells = response_cells,
    .apply = response_apply,
};
