/* hoop.c - see hoop.h. */
#include "scheme/hoop.h"

#include "base/mem.h"
#include "phys/mix.h"

#include <string.h>

static bool hoop_wanted(const struct model *path)
{
    return path->beta > 0;
}

/* A row, for scenes with a solid or with matter that turns. */
static void *hoop_open(const struct term_room *room)
{
    bool own = room->model->elastic || model_turns(room->model);
    return own ? mem_new(room->mesh->n_cell, sizeof(double)) : NULL;
}

static BULLA_KERNEL void hoop_whirl(size_t n, const double *restrict alpha, const double *restrict rho,
                                    const double *restrict u, double *restrict hoop)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double q = hoop[i], v = u[i];
        hoop[i] = q + alpha[i] * rho[i] * (v * v);
    }
}

static BULLA_KERNEL void hoop_whirl_alone(size_t n, const double *restrict rho, const double *restrict u,
                                          double *restrict hoop)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double q = hoop[i], v = u[i];
        hoop[i] = q + rho[i] * (v * v);
    }
}

/* p + rho u_th^2 */
static void hoop_turn(struct term_tile *tile)
{
    const struct model *model = tile->model;
    size_t n = tile->n_cell;
    const double *w = tile->w, *u = w + (model->i_u + 2) * n;
    double *hoop = tile->own;
    memcpy(hoop, w + model->i_E * n, n * sizeof *hoop);
    if (!model->n_alpha) hoop_whirl_alone(n, w + model->i_m * n, u, hoop);
    for (unsigned l = 0; l < model->n_alpha; l++)
        hoop_whirl(n, w + (model->i_alpha + l) * n, w + (model->i_m + l) * n, u, hoop);
    tile->hoop = hoop;
}

/* The cell of a line of the frame that layer i is, or mirrors behind an end of the domain (*ret_sign: -1), and its
 * radius. */
static int hoop_inside(const struct term_tile *tile, int i, double *ret_r, double *ret_sign)
{
    double h = tile->level->h[0], lower = tile->mesh->lower[0];
    int first = tile->tile->at[0] * tile->mesh->n[0], all = tile->level->extent[0] * tile->mesh->n[0], cell = first + i;
    int inside = cell < 0 ? -1 - cell : cell >= all ? 2 * all - 1 - cell : cell;
    *ret_r = metric_centroid(1, lower + inside * h, lower + (inside + 1) * h);
    *ret_sign = inside == cell ? 1.0 : -1.0;
    return inside - first;
}

/* What turns is held by a pressure that rises with rho u_th^2/r: half a cell of it (face_work.rise). */
static void hoop_frame(const struct term_piece *piece)
{
    const struct model *model = piece->model;
    const struct frame *frame = piece->frame;
    const double *w = piece->faces->frame, *u = w + (model->i_u + 2) * FACE_ROOM;
    double half[FACE_ROOM], r, sign;
    if (!model_turns(model) || frame->axis != 0) return;
    for (size_t o = 0; o < frame->outer; o++)
        for (int i = -(int)frame->ghosts; i < (int)(frame->n + frame->ghosts); i++) {
            size_t at = frame_at(frame, o, hoop_inside(piece->tile, i, &r, &sign));
            double rho = model->n_alpha ? 0.0 : w[model->i_m * FACE_ROOM + at];
            for (unsigned l = 0; l < model->n_alpha; l++)
                rho += w[(model->i_alpha + l) * FACE_ROOM + at] * w[(model->i_m + l) * FACE_ROOM + at];
            half[frame_at(frame, o, i)] = sign * (0.5 * (rho * (u[at] * u[at]) / r * piece->tile->level->h[0]));
        }
    face_rise(piece->faces, frame, half, half);
}

static void hoop_begin(struct term_tile *tile)
{
    const struct model *model = tile->model;
    tile->hoop = tile->w + model->i_E * tile->n_cell;
    if (model_turns(model)) hoop_turn(tile);
    if (!model->n_stretch) return;
    mix_hoop(model, tile->n_cell, tile->n_cell, tile->w, tile->own);
    tile->hoop = tile->own;
}

const struct term hoop_term = {
    .name = "hoop",
    .owner = "core/scheme/hoop.c",
    .equation = "d(rho u_r)/dt += (rho u_th^2 - beta s_thth) / r, inside the divergence: what rests stays at rest",
    .wanted = hoop_wanted,
    .open = hoop_open,
    .close = mem_free,
    .begin = hoop_begin,
    .frame = hoop_frame,
};
