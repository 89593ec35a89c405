/* viscous_pull.c - see viscous_pull.h. */
#include "scheme/viscous_pull.h"

#include "base/mem.h"
#include "phys/row.h"
#include "scheme/terms.h"

#include <string.h>

/* No weight worth a quotient. */
#define PULL_NONE 1e-300

/* What the pulls add to the lags of the faces of a frame. */
struct viscous_pull {
    double lag[SCENE_MATERIALS][FACE_ROOM];
};

static bool viscous_pull_wanted(const struct model *path)
{
    return path->n_pull > 0;
}

static unsigned viscous_pull_rows(const struct model *path)
{
    return path->n_pull;
}

static void *viscous_pull_open(const struct term_room *room)
{
    (void)room;
    return mem_new(1, sizeof(struct viscous_pull));
}

static void viscous_pull_close(void *own)
{
    mem_free(own);
}

/* A pull at the faces above n cells: the mean of both with the square of alpha (1 - alpha), largest in the middle of a
 * front. mean: of the fractions; rise: what p grows by. */
static BULLA_KERNEL void viscous_pull_between(size_t n, size_t step, const double *restrict tau,
                                              const double *restrict a, double *restrict pull, double *restrict mean,
                                              double *restrict rise)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double low = a[i], high = a[i + step], below = low * (1.0 - low), above = high * (1.0 - high), r = rise[i];
        double v = below * below, w = above * above, sum = v + w;
        double face = (v * tau[i] + w * tau[i + step]) / (sum > PULL_NONE ? sum : 1.0);
        pull[i] = face;
        mean[i] = 0.5 * (low + high);
        rise[i] = r + face * (high - low);
    }
}

static BULLA_KERNEL void viscous_pull_halve(size_t n, double *restrict a)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) a[i] *= 0.5;
}

static void viscous_pull_frame(const struct term_piece *piece)
{
    const struct model *path = piece->model;
    const struct frame *frame = piece->frame;
    struct face_work *faces = piece->faces;
    struct viscous_pull *own = piece->own;
    double pull[FACE_ROOM], mean[FACE_ROOM], all[FACE_ROOM],
        rise[FACE_ROOM]; /* large: filled as far as they are used */
    size_t n = frame->count - frame->inner, bytes = n * sizeof *all;
    memset(all, 0, bytes);
    memset(rise, 0, bytes);
    for (unsigned l = 0; l < path->n_material; l++) memset(own->lag[l], 0, bytes);
    for (unsigned k = 0; k < path->n_pull; k++) {
        unsigned l = path->pulls[k].material;
        viscous_pull_between(n, frame->inner, faces->frame + path->pulls[k].field * FACE_ROOM,
                             faces->frame + (path->i_alpha + l) * FACE_ROOM, pull, mean, rise);
        row_add(n, pull, own->lag[l]);
        row_add_product(n, mean, pull, all);
    }
    for (unsigned l = 0; l < path->n_material; l++) {
        row_take(n, all, own->lag[l]);
        row_add(n, own->lag[l], faces->lag + l * FACE_ROOM);
    }
    viscous_pull_halve(n, rise);
    row_add(n, rise, faces->rise[1]);
    row_add(n, rise, faces->rise[0] + frame->inner);
}

/* Their work goes with the viscous stress. */
static void viscous_pull_faces(const struct term_piece *piece)
{
    const struct viscous_pull *own = piece->own;
    struct face_work *faces = piece->faces;
    size_t n = faces->faces.n, reach = frame_reach(piece->frame);
    double work[FACE_ROOM];
    memset(work, 0, n * sizeof *work);
    for (unsigned l = 0; l < piece->model->n_material; l++)
        row_add_product(n, faces->alpha + l * FACE_ROOM, own->lag[l] + reach, work);
    row_take(n, work, faces->energy);
}

static double *viscous_pull_row(const struct term_tile *tile, unsigned k, size_t from)
{
    return tile->rates + (terms_first(tile->terms, &viscous_pull_term) + k) * tile->n_cell + from;
}

/* -2 mu beta u/r, where there is an interface */
static BULLA_KERNEL void viscous_pull_of(size_t n, double beta, const struct viscous_strain *restrict strain,
                                         const double *restrict mu, double *restrict tau)
{
    const double *restrict hoop = strain->hoop, *restrict sharp = strain->sharp;
#pragma omp simd
    for (size_t i = 0; i < n; i++) tau[i] = -2.0 * beta * mu[i] * (sharp[i] * hoop[i]);
}

void viscous_pull_make(const struct term_tile *tile, const struct viscous_strain *strain, unsigned l, size_t from,
                       const double *mu)
{
    const struct model *path = tile->model;
    for (unsigned k = 0; k < path->n_pull && strain->interface; k++)
        if (path->pulls[k].material == l)
            viscous_pull_of(strain->n, path->beta, strain, mu, viscous_pull_row(tile, k, from));
}

/* The least part of the pulls that puts a material as low as it may be. pull: its own, or 0. */
static BULLA_KERNEL void viscous_pull_least(size_t n, const double *restrict alpha, const double *restrict rho_c2,
                                            const double *restrict pull, const double *restrict all,
                                            double *restrict part)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double K = rho_c2[i], below = all[i] - pull[i], old = part[i], most = PULL_MOST * K, less = most / below;
        int over = (alpha[i] > 0.0) & (K > 0.0) & (below > most);
        part[i] = (over ? less : 1.0) < old ? less : old;
    }
}

static BULLA_KERNEL void viscous_pull_scale(size_t n, const double *restrict part, double *restrict pull)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) pull[i] *= part[i];
}

void viscous_pull_bound(const struct term_tile *tile, size_t from, size_t n)
{
    const struct model *path = tile->model;
    double all[STRAIN_POINTS], part[STRAIN_POINTS];
    static const double none[STRAIN_POINTS];
    const double *alpha = tile->w + path->i_alpha * tile->n_cell + from, *own[SCENE_MATERIALS];
    for (unsigned l = 0; l < path->n_material; l++) own[l] = none;
    for (size_t i = 0; i < n; i++) all[i] = 0.0, part[i] = 1.0;
    for (unsigned k = 0; k < path->n_pull; k++) {
        unsigned l = path->pulls[k].material;
        own[l] = viscous_pull_row(tile, k, from);
        row_add_product(n, alpha + l * tile->n_cell, own[l], all);
    }
    for (unsigned l = 0; l < path->n_material; l++)
        viscous_pull_least(n, alpha + l * tile->n_cell, tile->rho_c2 + l * tile->n_cell + from, own[l], all, part);
    for (unsigned k = 0; k < path->n_pull; k++) viscous_pull_scale(n, part, viscous_pull_row(tile, k, from));
}

static size_t viscous_pull_apply(const struct term_tile *tile, double *u_new)
{
    const struct model *path = tile->model;
    for (unsigned k = 0; k < path->n_pull; k++)
        memcpy(u_new + path->pulls[k].field * tile->n_cell, viscous_pull_row(tile, k, 0), tile->n_cell * sizeof *u_new);
    return 0;
}

const struct term viscous_pull_term = {
    .name = "pull",
    .owner = "core/scheme/viscous_pull.c",
    .equation = "p_l - p = tau_l - sum alpha_m tau_m, tau_l = -2 mu_l beta u/r: what viscosity does at a surface",
    .wanted = viscous_pull_wanted,
    .rows = viscous_pull_rows,
    .open = viscous_pull_open,
    .close = viscous_pull_close,
    .frame = viscous_pull_frame,
    .faces = viscous_pull_faces,
    .apply = viscous_pull_apply,
};
