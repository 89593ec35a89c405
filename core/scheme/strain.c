/* strain.c - see strain.h. */
#include "scheme/strain.h"

#include "phys/elastic.h"
#include "phys/row.h"
#include "scheme/convection.h"
#include "scheme/exchange.h"
#include "scheme/response.h"
#include "scheme/shelter.h"
#include "scheme/terms.h"

enum { STRAIN_BATCH = 512 };

static bool strain_wanted(const struct model *path)
{
    return path->n_stretch > 0;
}

static unsigned strain_rows(const struct model *path)
{
    unsigned dim = (unsigned)path->dim;
    return path->n_velocity * dim + (path->n_alpha ? path->n_solid * dim : 0);
}

static const double *strain_row(const double *base, unsigned k)
{
    return base ? base + k * FACE_ROOM : NULL;
}

void strain_carry(struct terms *terms, int axis, unsigned k, const double *stretch)
{
    const struct model *model = terms->model;
    for (unsigned q = model_stretch(model, k); q < model_stretch(model, k) + model->n_stretch; q++) {
        const double *row = strain_row(stretch, q - model->i_V);
        terms_flux(terms, axis, (struct term_flux){.below = row, .above = row, .rate = q}, model->field_names[q], "");
    }
}

/* The stretches that come in, and the velocity gradient along the axis: plain differences in all geometries. Tangential
 * velocities are those that the cell itself sees, as the right neighbour of its lower face and the left one of its
 * upper. */
static void strain_list(struct terms *terms, int axis, unsigned first, const struct face_work *faces)
{
    static const struct face_work none;
    static const char *const tangents[] = {"1", "2"};
    const struct model *model = terms->model;
    unsigned dim = (unsigned)model->dim, along = (unsigned)axis;
    if (!faces) faces = &none;
    for (unsigned k = 0; k < model->n_solid; k++) strain_carry(terms, axis, k, faces->stretch);
    for (unsigned d = 0; d < model->n_velocity; d++)
        terms_flux(terms, axis,
                   (struct term_flux){.below = d ? strain_row(faces->slide_right, d - 1) : faces->u,
                                      .above = d ? strain_row(faces->slide_left, d - 1) : faces->u,
                                      .rate = first + axis_component(axis, d) * dim + along,
                                      .kind = TERM_DIFFERENCE,
                                      .sides = d > 0},
                   d ? "slide" : "", d ? tangents[d - 1] : "");
    for (unsigned s = 0; model->n_alpha && s < model->n_solid; s++)
        terms_flux(terms, axis,
                   (struct term_flux){.below = strain_row(faces->solid, s),
                                      .above = strain_row(faces->solid, s),
                                      .rate = first + (model->n_velocity + s) * dim + along,
                                      .kind = TERM_DIFFERENCE},
                   "", "");
}

/* -(K_s/alpha_s) div u of the one that carries a stretch; 0 where there is none. */
static BULLA_KERNEL void strain_squeeze(size_t n, const double *restrict K, const double *restrict alpha,
                                        const double *restrict div, double *restrict squeeze)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], share = K[i] / a;
        squeeze[i] = a > 0.0 ? share * div[i] : 0.0;
    }
}

/* Volume that is moved besides: what the solid gains is a strain across the interface. */
static BULLA_KERNEL void strain_moved(size_t n, double per_dt, const double *restrict volume,
                                      const double *restrict alpha, double *restrict squeeze)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], rate = per_dt * volume[i] / a, s = squeeze[i];
        squeeze[i] = s - (a > 0.0 ? rate : 0.0);
    }
}

static BULLA_KERNEL void strain_missed(size_t n, const double *restrict missing, const double *restrict alpha,
                                       const double *restrict whole, double *restrict squeeze, double *restrict div)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double m = missing[i], s = squeeze[i];
        squeeze[i] = s + (alpha[i] > 0.0 ? m : 0.0);
        div[i] = whole[i] - m;
    }
}

/* Solids that do not come to the faces of their cells: what does not strain them there does so across the interface.
 * The hoop is that of the faces. */
static void strain_shelter(const struct term_tile *tile, size_t from, size_t n, const double *solid,
                           struct elastic_rates *rates, double *squeeze, double *div)
{
    const double *seen = shelter_gradient(tile);
    double missing[STRAIN_BATCH];
    if (!seen) return;
    shelter_missing(tile, n, rates->gradient, seen + from, missing);
    strain_missed(n, missing, solid, rates->div, squeeze, div);
    rates->gradient = seen + from;
    rates->div = div;
}

/* Stretch k in n cells from `from`. */
static void strain_batch(const struct term_tile *tile, unsigned k, size_t from, size_t n, double relaxes,
                         const double *V_old, double *u_new)
{
    const struct model *model = tile->model;
    size_t n_cell = tile->n_cell, first = model_stretch(model, k) * n_cell + from;
    size_t fraction = model->i_alpha * n_cell + from, mass = model->i_m * n_cell + from;
    const double *div = tile->rates + terms_first(tile->terms, &convection_term) * n_cell + from;
    const double *gradient = tile->rates + terms_first(tile->terms, &strain_term) * n_cell + from;
    double room[STRAIN_BATCH], squeeze[STRAIN_BATCH], beyond[STRAIN_BATCH], before[STRAIN_BATCH], after[STRAIN_BATCH];
    double *V = u_new + first;
    struct elastic_rates rates = {.carried = tile->rates + first,
                                  .m_old = elastic_carrier(model, k, n, n_cell, tile->u + mass, before),
                                  .m_new = elastic_carrier(model, k, n, n_cell, u_new + mass, after),
                                  .div = div,
                                  .gradient = gradient,
                                  .relaxes = relaxes};
    if (model->kapila) {
        const double *solid = elastic_carrier(model, k, n, n_cell, tile->w + fraction, room);
        strain_squeeze(n, elastic_carrier(model, k, n, n_cell, tile->K + from, room), solid, div, squeeze);
        if (response_own(tile))
            strain_moved(n, 1.0 / tile->dt, elastic_carrier(model, k, n, n_cell, exchange_volume(tile) + from, room),
                         solid, squeeze);
        strain_shelter(tile, from, n, solid, &rates, squeeze, beyond);
        rates.squeeze = squeeze;
        rates.slope = gradient + (model->n_velocity + model_bearer(model, k)) * (unsigned)model->dim * n_cell;
    }
    elastic_advance(model, n, n_cell, tile->dt, V_old + from, &rates, V);
    if (model->n_alpha) elastic_fade(model, n, n_cell, elastic_carrier(model, k, n, n_cell, u_new + fraction, room), V);
}

void strain_move(const struct term_tile *tile, unsigned k, double relaxes, const double *V_old, double *u_new)
{
    for (size_t from = 0; from < tile->n_cell; from += STRAIN_BATCH) {
        size_t rest = tile->n_cell - from;
        strain_batch(tile, k, from, rest < STRAIN_BATCH ? rest : STRAIN_BATCH, relaxes, V_old, u_new);
    }
    elastic_unimodular(tile->model, tile->n_cell, tile->n_cell, u_new + model_stretch(tile->model, k) * tile->n_cell);
}

/* The stretches of a tile. What nothing bears, as in a Maxwell fluid, would grow without end: it stays 1. */
static size_t strain_apply(const struct term_tile *tile, double *u_new)
{
    const struct model *model = tile->model;
    for (unsigned s = 0; s < model->n_solid; s++) {
        size_t first = model->solids[s].stretch * tile->n_cell;
        if (model_carries(model, s, s)) strain_move(tile, s, 0.0, tile->u + first, u_new);
        else elastic_identity(model, tile->n_cell, tile->n_cell, u_new + first);
    }
    return 0;
}

const struct term strain_term = {
    .name = "stretch",
    .owner = "core/scheme/strain.c",
    .equation = "dV/dt = -u.grad V + (L V)_sym-part, L = grad u of the solid; det V = 1",
    .wanted = strain_wanted,
    .rows = strain_rows,
    .list = strain_list,
    .apply = strain_apply,
};
