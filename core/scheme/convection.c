/* convection.c - see convection.h. */
#include "scheme/convection.h"

#include "mesh/metric.h"
#include "phys/row.h"
#include "scheme/terms.h"

#include <math.h>

/* Rows of faces: k rows behind a base, which a list for names does not have. */
static const double *convection_row(const double *base, unsigned k)
{
    return base ? base + k * FACE_ROOM : NULL;
}

/* Component of vectors at the faces of an axis that points along axis `e` of space. */
static unsigned convection_component(int axis, unsigned e)
{
    unsigned d = 0;
    while (axis_component(axis, d) != e) d++;
    return d;
}

static unsigned convection_rows(const struct model *path)
{
    return path->n_alpha || path->n_stretch ? 1 : 0;
}

static void convection_list(struct terms *terms, int axis, unsigned first, const struct face_work *faces)
{
    static const struct face_work none;
    static const char *const axes[] = {"x", "y", "z"};
    const struct model *model = terms->model;
    const struct scene_material *material = model->scene->material + model->first;
    if (!faces) faces = &none;
    for (unsigned l = 0; l < model->n_material; l++) {
        const double *row = convection_row(faces->m, l);
        terms_flux(terms, axis, (struct term_flux){.below = row, .above = row, .rate = model->i_m + l}, "mass",
                   material[l].name);
    }
    for (unsigned e = 0; e < model->n_velocity; e++) {
        unsigned d = convection_component(axis, e);
        const double *row = convection_row(faces->momentum, d);
        terms_flux(terms, axis,
                   (struct term_flux){.below = row,
                                      .above = row,
                                      .rate = model->i_u + e,
                                      .kind = d == 0 ? TERM_BALANCED : TERM_DIVERGENCE},
                   "momentum", axes[e]);
    }
    terms_flux(terms, axis, (struct term_flux){.below = faces->energy, .above = faces->energy, .rate = model->i_E},
               "energy", "");
    terms_flux(terms, axis,
               (struct term_flux){.below = faces->u,
                                  .above = faces->u,
                                  .rate = first,
                                  .kind = convection_rows(model) ? TERM_DIVERGENCE : TERM_TOLD},
               "velocity", "");
}

/* Fields that change by their rates alone: not fractions, not stretches, not curvatures. */
static size_t convection_apply(const struct term_tile *tile, double *u_new)
{
    const struct model *model = tile->model;
    for (unsigned i = model->n_alpha; i < model_drawn(model); i++) {
        size_t at = model->active[i] * tile->n_cell;
        row_step(tile->n_cell, tile->dt, tile->u + at, tile->rates + at, u_new + at);
    }
    return 0;
}

/* Sum over axes of (|u_a| + c) / h_a. */
static BULLA_KERNEL void convection_signal(size_t n, const double *restrict c2, const double *const *restrict u,
                                           const double *restrict per_h, double *restrict rate)
{
    const double *restrict u0 = u[0], *restrict u1 = u[1], *restrict u2 = u[2];
    double h0 = per_h[0], h1 = per_h[1], h2 = per_h[2], all = h0 + h1 + h2;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = fabs(u0[i]), b = fabs(u1[i]), d = fabs(u2[i]), s = c2[i], old = rate[i];
        rate[i] = old + (all * sqrt(s) + ((h0 * a + h1 * b) + h2 * d)); /* x and y may change places */
    }
}

/* Cells that begin at an axis or a centre have less volume for the area of their outer face than others: what flows out
 * of them faster than sound would take along more than there is. Their rate is at least that of what leaves. Nothing
 * changes where a cell has CONVECTION_ROOM of its width behind its outer face: with a Courant number up to that, and
 * any sound, it cannot lose all. */
#define CONVECTION_ROOM 0.8

/* What cells of column i along the first axis lose beyond the signal. */
static void convection_leave(const struct term_pace *pace, size_t column, double per_width, const double *const *u,
                             const double *per_h, double *rate)
{
    for (size_t i = column; i < pace->n_cell; i += (size_t)pace->mesh->n[0]) {
        double across = per_h[1] * fabs(u[1][i]) + per_h[2] * fabs(u[2][i]), c = sqrt(pace->c2[i]);
        double signal = per_h[0] * (fabs(u[0][i]) + c) + (across + (per_h[1] + per_h[2]) * c);
        double out = u[0][i] > 0.0 ? per_width * u[0][i] + across : 0.0;
        rate[i] += out > signal ? out - signal : 0.0;
    }
}

static void convection_narrow(const struct term_pace *pace, const double *const *u, const double *per_h, double *rate)
{
    struct metric metric;
    if (!pace->tile || pace->mesh->beta == 0) return;
    metric_of_tile(pace->mesh, pace->level, pace->tile, &metric);
    for (int i = 0; i < pace->mesh->n[0]; i++) {
        double per_width = metric.area[i + 1] / metric.volume[i];
        if (per_width * CONVECTION_ROOM > per_h[0]) convection_leave(pace, (size_t)i, per_width, u, per_h, rate);
    }
}

static void convection_pace(const struct term_pace *pace, double *rate)
{
    const struct model *model = pace->model;
    const double *u[3];
    double per_h[3];
    for (int d = 0; d < 3; d++) { /* unused axes: any field, with weight zero */
        bool used = d < model->dim;
        u[d] = pace->w + (model->i_u + (used ? (unsigned)d : 0)) * pace->n_cell;
        per_h[d] = used ? 1.0 / pace->level->h[d] : 0.0;
    }
    convection_signal(pace->n_cell, pace->c2, u, per_h, rate);
    convection_narrow(pace, u, per_h, rate);
}

const struct term convection_term = {
    .name = "convection",
    .owner = "core/scheme/convection.c",
    .equation = "d(m_l, rho u, rho E)/dt = -div F; F from the Riemann problems at the faces",
    .rows = convection_rows,
    .list = convection_list,
    .apply = convection_apply,
    .pace = convection_pace,
};
