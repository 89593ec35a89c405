/* fraction.c - see fraction.h. */
#include "scheme/fraction.h"

#include "phys/row.h"
#include "scheme/convection.h"
#include "scheme/terms.h"

#include <string.h>

enum { FRACTION_BATCH = 512 };

static bool fraction_wanted(const struct model *path)
{
    return path->n_alpha > 0;
}

static void fraction_list(struct terms *terms, int axis, unsigned first, const struct face_work *faces)
{
    const struct model *model = terms->model;
    (void)first;
    for (unsigned l = 0; l < model->n_alpha; l++) {
        const double *row = faces ? faces->alpha + l * FACE_ROOM : NULL;
        terms_flux(terms, axis, (struct term_flux){.below = row, .above = row, .rate = model->i_alpha + l}, "alpha",
                   model->scene->material[model->first + l].name);
    }
}

/* alpha after transport, bounded by 0 and 1. Rates hold -div(alpha u) and, in `div`, -div u. */
static BULLA_KERNEL void fraction_move(size_t n, double dt, const double *restrict old, const double *restrict alpha,
                                       const double *restrict rate, const double *restrict div, double *restrict now)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double moved = old[i] + dt * (rate[i] - alpha[i] * div[i]);
        moved = moved > 0.0 ? moved : 0.0;
        now[i] = moved < 1.0 ? moved : 1.0;
    }
}

static size_t fraction_apply(const struct term_tile *tile, double *u_new)
{
    const struct model *model = tile->model;
    const double *div = tile->rates + terms_first(tile->terms, &convection_term) * tile->n_cell;
    for (unsigned l = 0; l < model->n_alpha; l++) {
        size_t at = (model->i_alpha + l) * tile->n_cell;
        fraction_move(tile->n_cell, tile->dt, tile->u + at, tile->w + at, tile->rates + at, div, u_new + at);
    }
    return 0;
}

static size_t fraction_sum_apply(const struct term_tile *tile, double *u_new)
{
    const struct model *model = tile->model;
    for (size_t from = 0; from < tile->n_cell; from += FRACTION_BATCH) {
        size_t n = tile->n_cell - from < FRACTION_BATCH ? tile->n_cell - from : FRACTION_BATCH;
        double sum[FRACTION_BATCH], *alpha = u_new + model->i_alpha * tile->n_cell + from;
        memset(sum, 0, n * sizeof *sum);
        for (unsigned l = 0; l < model->n_alpha; l++) row_add(n, alpha + l * tile->n_cell, sum);
        for (unsigned l = 0; l < model->n_alpha; l++) row_divide(n, sum, alpha + l * tile->n_cell);
    }
    return 0;
}

const struct term fraction_term = {
    .name = "fractions",
    .owner = "core/scheme/fraction.c",
    .equation = "d alpha_l/dt = -div(alpha_l* u*) + alpha_l div u*",
    .wanted = fraction_wanted,
    .list = fraction_list,
    .apply = fraction_apply,
};

const struct term fraction_sum = {
    .name = "sum",
    .owner = "core/scheme/fraction.c",
    .equation = "sum alpha_l = 1",
    .wanted = fraction_wanted,
    .apply = fraction_sum_apply,
};
