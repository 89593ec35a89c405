/* stage.c - see stage.h.
 *
 * Tiles are independent within a stage: each gathers what it needs from the primitives of all and
 * writes its own u_new. Tiles that touch another rank come last, so that the exchange hides
 * behind the others; the order of tiles never changes a value. */
#include "solve/stage.h"

#include "base/mem.h"
#include "mesh/halo.h"
#include "phys/mix.h"
#include "phys/update.h"

#include <math.h>
#include <string.h>

struct stage *stage_new(const struct model *model, struct mesh *mesh, struct level *level)
{
    struct stage *stage = mem_new(1, sizeof *stage);
    stage->model = model;
    stage->mesh = mesh;
    stage->level = level;
    stage->guard = guard_new(model, mesh, level);
    stage->faces = face_new(model);
    stage->rates = mem_new(update_rates(model) * mesh->n_cell, sizeof(double));
    stage->K = mem_new(model->n_material * mesh->n_cell, sizeof(double));
    stage->rho_c2 = mem_new(model->n_material * mesh->n_cell, sizeof(double));
    stage->c2 = mem_new(mesh->n_cell, sizeof(double));
    stage->u_star = mem_new(model->n_field * mesh->n_cell, sizeof(double));
    return stage;
}

void stage_free(struct stage *stage)
{
    if (!stage) return;
    guard_free(stage->guard);
    face_free(stage->faces);
    bound_free(stage->bound);
    mem_free(stage->rates);
    mem_free(stage->K);
    mem_free(stage->rho_c2);
    mem_free(stage->c2);
    mem_free(stage->u_star);
    mem_free(stage);
}

void stage_bind(struct stage *stage)
{
    bound_free(stage->bound);
    stage->bound = bound_new(stage->model, stage->mesh, stage->level);
}

void stage_exchange(struct stage *stage)
{
    halo_start(stage->level->halo, stage->level->w);
    if (stage->guard->masked) halo_start(stage->guard->halo, stage->guard->mask);
}

static void stage_finish_exchange(struct stage *stage)
{
    halo_finish(stage->level->halo);
    if (stage->guard->masked) halo_finish(stage->guard->halo);
}

/* One axis of one tile: gather, reconstruct, solve, add the divergence. */
static void stage_sweep(struct stage *stage, unsigned local, int axis, const struct metric *metric)
{
    const struct mesh *mesh = stage->mesh;
    const struct level *level = stage->level;
    const struct guard *guard = stage->guard;
    const struct frame_source fields = {.mesh = mesh,
                                        .level = level,
                                        .arrays = level->w,
                                        .halo = level->halo,
                                        .n_field = stage->model->n_field,
                                        .boundary = bound_fill,
                                        .data = stage->bound};
    const struct frame_source marks = {
        .mesh = mesh, .level = level, .arrays = guard->mask, .halo = guard->halo, .n_field = 1, .boundary = bound_copy};
    for (size_t piece = 0; piece < frame_pieces(mesh, axis); piece++) {
        struct frame frame = frame_piece(mesh, axis, piece);
        frame_gather(&fields, local, &frame, FACE_ROOM, stage->faces->frame);
        if (guard->masked) frame_gather(&marks, local, &frame, FACE_ROOM, stage->faces->mask);
        face_solve(stage->faces, &frame, guard->masked);
        update_add(stage->model, level, metric, &frame, stage->faces, mesh->n_cell, level->w[local], stage->rates);
    }
}

/* u = u_old + dt L(w) of one tile. */
static void stage_advance_tile(struct stage *stage, unsigned local, double dt, double *u)
{
    const struct model *model = stage->model;
    const struct mesh *mesh = stage->mesh;
    struct level *level = stage->level;
    size_t n_cell = mesh->n_cell;
    struct metric metric;
    metric_of_tile(mesh, level, &level->tiles[level->first + local], &metric);
    memset(stage->rates, 0, update_rates(model) * n_cell * sizeof *stage->rates);
    for (int axis = 0; axis < mesh->dim; axis++) stage_sweep(stage, local, axis, &metric);
    if (model->kapila) {
        mix_stiffness(model, n_cell, n_cell, level->w[local], stage->rho_c2);
        mix_closure(model, n_cell, n_cell, level->w[local], stage->rho_c2, stage->K);
    }
    struct update_input input = {.u_old = level->u_old[local],
                                 .w = level->w[local],
                                 .K = stage->K,
                                 .rho_c2 = stage->rho_c2,
                                 .rates = stage->rates};
    stage->clipped += (long long)update_apply(model, n_cell, dt, &input, u);
    stage->cells += (long long)n_cell;
}

/* Primitives of u, into w, and the guard's judgement. */
static void stage_judge(struct stage *stage, unsigned local, int judged, double *u, double *w)
{
    const struct model *model = stage->model;
    size_t n_cell = stage->mesh->n_cell;
    mix_primitives(model, n_cell, n_cell, u, w);
    mix_stiffness(model, n_cell, n_cell, w, stage->rho_c2);
    mix_speed2(model, n_cell, n_cell, w, stage->rho_c2, stage->c2);
    struct guard_tile tile = {.local = local,
                              .stage = judged,
                              .u_old = stage->level->u_old[local],
                              .u = u,
                              .w = w,
                              .rho_c2 = stage->rho_c2,
                              .c2 = stage->c2};
    guard_check(stage->guard, &tile);
}

static void stage_half_tile(struct stage *stage, unsigned local)
{
    const struct level *level = stage->level;
    size_t n_cell = stage->mesh->n_cell, p = stage->model->i_E * n_cell;
    stage_advance_tile(stage, local, 0.5 * stage->dt, stage->u_star);
    memcpy(level->u_new[local] + p, level->w[local] + p, n_cell * sizeof(double)); /* where an iteration starts */
    stage_judge(stage, local, 0, stage->u_star, level->u_new[local]);
}

static void stage_full_tile(struct stage *stage, unsigned local)
{
    stage_advance_tile(stage, local, stage->dt, stage->level->u_new[local]);
}

/* All tiles, those without remote neighbours while the exchange is under way. */
static void stage_tiles(struct stage *stage, double t, void (*work)(struct stage *stage, unsigned local))
{
    const struct level *level = stage->level;
    stage->bound->t = t;
    for (unsigned tile = 0; tile < level->n_local; tile++)
        if (!halo_is_remote(level, tile)) work(stage, tile);
    stage_finish_exchange(stage);
    for (unsigned tile = 0; tile < level->n_local; tile++)
        if (halo_is_remote(level, tile)) work(stage, tile);
}

void stage_half(struct stage *stage)
{
    struct level *level = stage->level;
    stage_tiles(stage, stage->t, stage_half_tile);
    double **w_star = level->u_new;
    level->u_new = level->w;
    level->w = w_star;
}

void stage_full(struct stage *stage)
{
    stage_tiles(stage, stage->t + 0.5 * stage->dt, stage_full_tile);
}

/* Sum over axes of (|u_a| + c) / h_a; the largest sets the time step. */
static BULLA_KERNEL void stage_signal(size_t n, const double *restrict c2, const double *const *restrict u,
                                      const double *restrict per_h, double *restrict signal)
{
    const double *restrict u0 = u[0], *restrict u1 = u[1], *restrict u2 = u[2];
    double h0 = per_h[0], h1 = per_h[1], h2 = per_h[2], all = h0 + h1 + h2;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = fabs(u0[i]), b = fabs(u1[i]), d = fabs(u2[i]), s = c2[i];
        signal[i] = all * sqrt(s) + h0 * a + h1 * b + h2 * d;
    }
}

static void stage_measure(struct stage *stage, const double *w)
{
    const struct model *model = stage->model;
    const struct mesh *mesh = stage->mesh;
    const double *u[3];
    double per_h[3];
    for (int d = 0; d < 3; d++) { /* unused axes: any field, with weight zero */
        bool used = d < mesh->dim;
        u[d] = w + (model->i_u + (used ? (unsigned)d : 0)) * mesh->n_cell;
        per_h[d] = used ? 1.0 / stage->level->h[d] : 0.0;
    }
    double *signal = stage->rates; /* free between stages */
    stage_signal(mesh->n_cell, stage->c2, u, per_h, signal);
    for (size_t i = 0; i < mesh->n_cell; i++)
        if (signal[i] > stage->signal) stage->signal = signal[i];
}

void stage_close(struct stage *stage)
{
    const struct level *level = stage->level;
    stage->signal = 0.0;
    for (unsigned tile = 0; tile < level->n_local; tile++) {
        stage_judge(stage, tile, 1, level->u_new[tile], level->w[tile]);
        stage_measure(stage, level->w[tile]);
    }
}

void stage_reset(struct stage *stage)
{
    const struct level *level = stage->level;
    size_t n_cell = stage->mesh->n_cell;
    for (unsigned tile = 0; tile < level->n_local; tile++)
        mix_primitives(stage->model, n_cell, n_cell, level->u_old[tile], level->w[tile]);
}
