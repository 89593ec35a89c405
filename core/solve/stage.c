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
    if (model->mixed) stage->faces_pure = face_new(model->pure[0]);
    stage->present = mem_new(level->n_local, sizeof *stage->present);
    stage->present_next = mem_new(level->n_local, sizeof *stage->present_next);
    stage->path = mem_new(level->n_local, sizeof *stage->path);
    stage->streak = mem_new(level->n_local, sizeof *stage->streak);
    stage->still = mem_new(level->n_local, sizeof *stage->still);
    stage->still_next = mem_new(level->n_local, sizeof *stage->still_next);
    stage->skipped = mem_new(level->n_local, sizeof *stage->skipped);
    stage->tile_signal = mem_new(level->n_local, sizeof *stage->tile_signal);
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
    face_free(stage->faces_pure);
    mem_free(stage->present);
    mem_free(stage->present_next);
    mem_free(stage->path);
    mem_free(stage->streak);
    mem_free(stage->still);
    mem_free(stage->still_next);
    mem_free(stage->skipped);
    mem_free(stage->tile_signal);
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

/* Bits of the materials that a tile's conserved block holds anything of. */
static unsigned stage_materials(const struct model *model, size_t n_cell, const double *u)
{
    unsigned present = 0;
    for (unsigned l = 0; l < model->n_alpha; l++) {
        const double *alpha = u + (model->i_alpha + l) * n_cell, *m = u + (model->i_m + l) * n_cell;
        for (size_t i = 0; i < n_cell; i++)
            if ((alpha[i] != 0.0) | (m[i] != 0.0)) {
                present |= 1u << l;
                break;
            }
    }
    return present;
}

/* Does what lies behind a face hold the same materials? Of other ranks that is not known here. */
static bool stage_alike(const struct stage *stage, unsigned local, int face)
{
    const struct neighbour *neighbour = &stage->level->neighbours[local][face];
    if (neighbour->kind == NEIGHBOUR_LOCAL) return stage->present[neighbour->index] == stage->present[local];
    return neighbour->kind == NEIGHBOUR_BOUNDARY &&
           stage->model->scene->boundary[face / 2][face % 2].type != SCENE_INFLOW;
}

/* The model that suffices for a tile. */
static const struct model *stage_choose(const struct stage *stage, unsigned local)
{
    const struct model *model = stage->model;
    unsigned present = stage->present[local], l = 0;
    if (!model->mixed || !present || (present & (present - 1))) return model;
    for (int face = 0; face < 2 * model->dim; face++)
        if (!stage_alike(stage, local, face)) return model;
    while (present >> (l + 1)) l++;
    return model->pure[l];
}

/* Is a tile of one material uniform and at rest, to the bit (+0, not -0)? */
static bool stage_rests(const struct model *model, size_t n_cell, const double *w)
{
    static const double zero = 0.0;
    if (model->n_alpha) return false;
    for (unsigned i = 0; i < model->n_active; i++) {
        unsigned q = model->active[i];
        const double *row = w + q * n_cell;
        bool velocity = q >= model->i_u && q < model->i_E;
        if (velocity && memcmp(row, &zero, sizeof zero)) return false;
        if (memcmp(row, row + 1, (n_cell - 1) * sizeof *row)) return false;
    }
    return true;
}

/* Does what lies behind a face of a resting tile rest in the same state? Boundaries that only mirror or copy do. */
static bool stage_rests_behind(const struct stage *stage, unsigned local, int face)
{
    const struct level *level = stage->level;
    const struct neighbour *neighbour = &level->neighbours[local][face];
    size_t n_cell = stage->mesh->n_cell;
    if (neighbour->kind == NEIGHBOUR_BOUNDARY)
        return stage->model->scene->boundary[face / 2][face % 2].type <= SCENE_OUTFLOW;
    if (neighbour->kind != NEIGHBOUR_LOCAL || !stage->still[neighbour->index] ||
        stage->present[neighbour->index] != stage->present[local])
        return false;
    for (unsigned q = 0; q < stage->model->n_field; q++)
        if (memcmp(level->w[local] + q * n_cell, level->w[neighbour->index] + q * n_cell, sizeof(double))) return false;
    return true;
}

/* Has a tile nothing to compute in this stage? Iterated closures and repeated steps are not skipped. */
static bool stage_skips(const struct stage *stage, unsigned local)
{
    if (!stage->still[local] || stage->guard->masked || !stage->model->linear) return false;
    for (int face = 0; face < 2 * stage->model->dim; face++)
        if (!stage_rests_behind(stage, local, face)) return false;
    return true;
}

/* Carries a resting tile on: the whole block as it is. */
static void stage_carry(struct stage *stage, unsigned local, const double *from, double *to)
{
    memcpy(to, from, stage->model->n_field * stage->mesh->n_cell * sizeof *to);
    stage->present_next[local] = stage->present[local];
    stage->still_next[local] = true;
    stage->cells += (long long)stage->mesh->n_cell;
    stage->carried += (long long)stage->mesh->n_cell;
}

/* Copies the components that a pure model leaves alone. The fractions are the same constants in all
 * three arrays, so that after three stages they need no copying. */
static void stage_keep(struct stage *stage, unsigned local, const double *from, double *to)
{
    const struct model *model = stage->path[local];
    size_t n_cell = stage->mesh->n_cell;
    if (model == stage->model) {
        stage->streak[local] = 0;
        return;
    }
    for (unsigned q = stage->streak[local] < 3 ? 0 : stage->model->i_m; q < stage->model->i_u; q++)
        if (q != model->i_m) memcpy(to + q * n_cell, from + q * n_cell, n_cell * sizeof *to);
    if (stage->streak[local] < 3) stage->streak[local]++;
}

/* One axis of one tile: gather, reconstruct, solve, add the divergence. */
static void stage_sweep(struct stage *stage, const struct model *model, unsigned local, int axis,
                        const struct metric *metric)
{
    const struct mesh *mesh = stage->mesh;
    const struct level *level = stage->level;
    const struct guard *guard = stage->guard;
    struct face_work *faces = model == stage->model ? stage->faces : stage->faces_pure;
    const struct frame_source fields = {.mesh = mesh,
                                        .level = level,
                                        .arrays = level->w,
                                        .halo = level->halo,
                                        .n_field = model->n_active,
                                        .fields = model->active,
                                        .boundary = bound_fill,
                                        .data = stage->bound};
    const struct frame_source marks = {
        .mesh = mesh, .level = level, .arrays = guard->mask, .halo = guard->halo, .n_field = 1, .boundary = bound_copy};
    faces->model = stage->bound->model = model;
    for (size_t piece = 0; piece < frame_pieces(mesh, axis); piece++) {
        struct frame frame = frame_piece(mesh, axis, piece);
        frame_gather(&fields, local, &frame, FACE_ROOM, faces->frame);
        if (guard->masked) frame_gather(&marks, local, &frame, FACE_ROOM, faces->mask);
        face_solve(faces, &frame, guard->masked);
        update_add(model, level, metric, &frame, faces, mesh->n_cell, level->w[local], stage->rates);
    }
}

static void stage_clear_rates(struct stage *stage, const struct model *model)
{
    size_t n_cell = stage->mesh->n_cell, more = update_rates(model) - model->n_field;
    for (unsigned i = 0; i < model->n_active; i++)
        memset(stage->rates + model->active[i] * n_cell, 0, n_cell * sizeof *stage->rates);
    if (model->n_alpha) memset(stage->rates + model->n_field * n_cell, 0, more * n_cell * sizeof *stage->rates);
}

/* u = u_old + dt L(w) of one tile; of a pure tile the active components only. */
static void stage_advance_tile(struct stage *stage, unsigned local, double dt, double *u)
{
    const struct model *model = stage->path[local] = stage_choose(stage, local);
    const struct mesh *mesh = stage->mesh;
    struct level *level = stage->level;
    size_t n_cell = mesh->n_cell;
    struct metric metric;
    if (mesh->beta) metric_of_tile(mesh, level, &level->tiles[level->first + local], &metric);
    stage_clear_rates(stage, model);
    for (int axis = 0; axis < mesh->dim; axis++) stage_sweep(stage, model, local, axis, &metric);
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
    const struct model *model = stage->path[local];
    size_t n_cell = stage->mesh->n_cell;
    mix_primitives(model, n_cell, n_cell, u, w);
    mix_stiffness(model, n_cell, n_cell, w, stage->rho_c2);
    mix_speed2(model, n_cell, n_cell, w, stage->rho_c2, stage->c2);
    struct guard_tile tile = {.model = model,
                              .local = local,
                              .stage = judged,
                              .u_old = stage->level->u_old[local],
                              .u = u,
                              .w = w,
                              .rho_c2 = stage->rho_c2,
                              .c2 = stage->c2};
    guard_check(stage->guard, &tile);
    stage->present_next[local] = model == stage->model ? stage_materials(model, n_cell, u) : stage->present[local];
    stage->still_next[local] = stage_rests(model, n_cell, w);
}

static void stage_half_tile(struct stage *stage, unsigned local)
{
    const struct level *level = stage->level;
    size_t n_cell = stage->mesh->n_cell, p = stage->model->i_E * n_cell;
    double *w = level->w[local], *w_star = level->u_new[local];
    if (stage_skips(stage, local)) {
        stage_carry(stage, local, w, w_star);
        return;
    }
    stage_advance_tile(stage, local, 0.5 * stage->dt, stage->u_star);
    stage_keep(stage, local, w, w_star);
    memcpy(w_star + p, w + p, n_cell * sizeof *w); /* where an iteration starts */
    stage_judge(stage, local, 0, stage->u_star, w_star);
}

static void stage_full_tile(struct stage *stage, unsigned local)
{
    const struct level *level = stage->level;
    stage->skipped[local] = stage_skips(stage, local);
    if (stage->skipped[local]) {
        stage_carry(stage, local, level->u_old[local], level->u_new[local]);
        return;
    }
    stage_advance_tile(stage, local, stage->dt, level->u_new[local]);
    stage_keep(stage, local, level->u_old[local], level->u_new[local]);
}

static void stage_swap_census(struct stage *stage)
{
    unsigned *keep = stage->present;
    stage->present = stage->present_next;
    stage->present_next = keep;
    bool *still = stage->still;
    stage->still = stage->still_next;
    stage->still_next = still;
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
    stage_swap_census(stage);
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
        signal[i] = all * sqrt(s) + ((h0 * a + h1 * b) + h2 * d); /* x and y may change places */
    }
}

static double stage_measure(struct stage *stage, const double *w)
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
    double *signal = stage->rates, most = 0.0; /* rates are free between stages */
    stage_signal(mesh->n_cell, stage->c2, u, per_h, signal);
    for (size_t i = 0; i < mesh->n_cell; i++)
        if (signal[i] > most) most = signal[i];
    return most;
}

void stage_close(struct stage *stage)
{
    const struct level *level = stage->level;
    stage->signal = 0.0;
    for (unsigned tile = 0; tile < level->n_local; tile++) {
        if (!stage->skipped[tile]) {
            stage_judge(stage, tile, 1, level->u_new[tile], level->w[tile]);
            stage->tile_signal[tile] = stage_measure(stage, level->w[tile]);
        }
        if (stage->tile_signal[tile] > stage->signal) stage->signal = stage->tile_signal[tile];
    }
    stage_swap_census(stage);
}

void stage_reset(struct stage *stage)
{
    const struct level *level = stage->level;
    size_t n_cell = stage->mesh->n_cell;
    for (unsigned tile = 0; tile < level->n_local; tile++) {
        mix_primitives(stage->model, n_cell, n_cell, level->u_old[tile], level->w[tile]);
        stage->present[tile] = stage_materials(stage->model, n_cell, level->u_old[tile]);
        stage->path[tile] = stage->model;
        stage->streak[tile] = 0;
        stage->still[tile] = stage->skipped[tile] = false;
    }
}
