/* stage.c - see stage.h.
 *
 * Tiles are independent within a stage: each gathers what it needs from the primitives of all and
 * writes its own u_new. Tiles that touch another rank come last, so that the exchange hides
 * behind the others; the order of tiles never changes a value. */
#include "solve/stage.h"

#include "base/mem.h"
#include "base/status.h"
#include "mesh/halo.h"
#include "phys/mix.h"
#include "scheme/update.h"

#include <math.h>
#include <string.h>

struct stage_work *stage_work_new(const struct model *model, const struct mesh *mesh)
{
    struct stage_work *work = mem_new(1, sizeof *work);
    work->faces = face_new(model);
    if (model->mixed) work->faces_pure = face_new(model->pure[model->elastic ? model->solids[0].material : 0]);
    if (model->fluids) work->faces_fluids = face_new(model->fluids);
    if (model->elastic && model->beta) work->hoop = mem_new(mesh->n_cell, sizeof(double));
    work->prolong = prolong_new(model, mesh);
    work->source = source_new(model, mesh);
    work->rates = mem_new(update_rates(model) * mesh->n_cell, sizeof(double));
    work->K = mem_new(model->n_material * mesh->n_cell, sizeof(double));
    work->rho_c2 = mem_new(model->n_material * mesh->n_cell, sizeof(double));
    work->c2 = mem_new(mesh->n_cell, sizeof(double));
    work->u_star = mem_new(model->n_field * mesh->n_cell, sizeof(double));
    return work;
}

void stage_work_free(struct stage_work *work)
{
    if (!work) return;
    face_free(work->faces);
    face_free(work->faces_pure);
    face_free(work->faces_fluids);
    mem_free(work->hoop);
    prolong_free(work->prolong);
    source_free(work->source);
    mem_free(work->rates);
    mem_free(work->K);
    mem_free(work->rho_c2);
    mem_free(work->c2);
    mem_free(work->u_star);
    mem_free(work);
}

struct stage *stage_new(const struct model *model, struct mesh *mesh, int l, struct stage_work *work)
{
    struct stage *stage = mem_new(1, sizeof *stage);
    *stage = (struct stage){.model = model, .mesh = mesh, .l = l, .level = &mesh->levels[l], .work = work, .blind = -1};
    stage->census = (struct census){.model = model, .mesh = mesh, .level = stage->level};
    return stage;
}

void stage_free(struct stage *stage)
{
    if (!stage) return;
    guard_free(stage->guard);
    blame_free(stage->blame);
    bound_free(stage->bound);
    reflux_free(stage->reflux);
    mem_free(stage->census.tiles);
    mem_free(stage->census.behind);
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
    cost_lap(&stage->work->cost, COST_EXCHANGE);
}

static void stage_finish_exchange(struct stage *stage)
{
    halo_finish(stage->level->halo);
    if (stage->guard->masked) halo_finish(stage->guard->halo);
    cost_lap(&stage->work->cost, COST_EXCHANGE);
}

void stage_ghosts(struct stage *stage)
{
    if (stage->l + 1 >= stage->mesh->n_level) return;
    halo_finish(stage->level->halo);
    cost_lap(&stage->work->cost, COST_EXCHANGE);
    stage->bound->t = stage->t;
    prolong_strips(stage->work->prolong, stage->mesh, stage->l, stage->bound, 0);
    cost_lap(&stage->work->cost, COST_LEVELS);
}

/* Has a tile nothing to compute in this stage? Repeated steps, tiles whose fluxes another level asks for and scenes with
 * sources are not skipped. */
static bool stage_skips(const struct stage *stage, unsigned local)
{
    if (stage->work->source || !stage->census.tiles[local].still || stage->guard->masked) return false;
    return !reflux_concerns(stage->reflux, local) && census_rests(&stage->census, local);
}

/* Is a tile only an average of the finer level, which nobody reads before the next one? */
static bool stage_is_hidden(const struct stage *stage, unsigned local)
{
    return stage->level->tiles[stage->level->first + local].hidden;
}

/* Carries a tile on: the whole block as it is. */
static void stage_carry(struct stage *stage, unsigned local, const double *from, double *to)
{
    struct census_tile *tile = &stage->census.tiles[local];
    memcpy(to, from, stage->model->n_field * stage->mesh->n_cell * sizeof *to);
    tile->present_next = tile->present;
    tile->still_next = tile->still;
    if (stage_is_hidden(stage, local)) return;
    stage->cells += (long long)stage->mesh->n_cell;
    stage->carried += (long long)stage->mesh->n_cell;
}

/* Copies the components that a narrowed path leaves alone. Its fractions and stretch are the same constants in all
 * three arrays, so that after three stages they need no copying; densities are not. */
static void stage_keep(struct stage *stage, unsigned local, const double *from, double *to)
{
    struct census_tile *tile = &stage->census.tiles[local];
    size_t n_cell = stage->mesh->n_cell;
    const struct model *model = stage->model, *path = tile->path;
    if (path != tile->kept) tile->streak = 0;
    tile->kept = path;
    if (path == model) return;
    for (unsigned q = 0, active = 0; q < model->n_field; q++) {
        bool density = q >= model->i_m && q < model->i_u;
        bool evolved = active < path->n_active && path->active[active] == q;
        active += evolved;
        if (!evolved && (density || tile->streak < 3)) memcpy(to + q * n_cell, from + q * n_cell, n_cell * sizeof *to);
    }
    if (tile->streak < 3) tile->streak++;
}

static struct face_work *stage_faces(const struct stage *stage, const struct model *path)
{
    if (path == stage->model) return stage->work->faces;
    return path == stage->model->fluids ? stage->work->faces_fluids : stage->work->faces_pure;
}

/* What the radial momentum of a tile is taken relative to: p, or -s_thth with a solid. */
static const double *stage_hoop(struct stage *stage, const struct model *model, const double *w)
{
    size_t n_cell = stage->mesh->n_cell;
    const double *p = w + model->i_E * n_cell;
    if (!model->beta || !model->n_stretch) return p;
    mix_hoop(model, n_cell, n_cell, w, stage->work->hoop);
    return stage->work->hoop;
}

/* One axis of one tile: gather, reconstruct, solve, add the divergence. */
static void stage_sweep(struct stage *stage, const struct model *model, unsigned local, int axis,
                        const struct metric *metric, const double *hoop)
{
    const struct mesh *mesh = stage->mesh;
    const struct level *level = stage->level;
    const struct guard *guard = stage->guard;
    struct face_work *faces = stage_faces(stage, model);
    struct cost *cost = &stage->work->cost;
    bool concerned = stage->fluxes && reflux_concerns(stage->reflux, local);
    const struct frame_source fields = {.mesh = mesh,
                                        .level = level,
                                        .arrays = level->w,
                                        .halo = level->halo,
                                        .link = level->link,
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
        cost_lap(cost, COST_GATHER);
        if (stage->bound->status && stage->blind < 0) stage->blind = 3 * (int)local + axis;
        face_solve(faces, &frame, guard->masked);
        cost_lap(cost, COST_FACES);
        if (blame_concerns(stage->blame, local)) blame_piece(stage->blame, model, &frame, faces);
        if (concerned) reflux_collect(stage->reflux, model, local, &frame, faces);
        update_add(model, level, metric, &frame, faces, mesh->n_cell, hoop, stage->work->rates);
        cost_lap(cost, COST_UPDATE);
    }
    if (concerned) reflux_average(stage->reflux, local, axis);
}

static void stage_clear_rates(struct stage *stage, const struct model *model)
{
    size_t n_cell = stage->mesh->n_cell, more = update_rates(model) - model->n_field;
    for (unsigned i = 0; i < model->n_active; i++)
        memset(stage->work->rates + model->active[i] * n_cell, 0, n_cell * sizeof(double));
    if (model->n_alpha | model->n_stretch)
        memset(stage->work->rates + model->n_field * n_cell, 0, more * n_cell * sizeof(double));
}

/* u = u_old + dt L(w) of one tile; of a pure tile the active components only. */
static void stage_advance_tile(struct stage *stage, unsigned local, double dt, double *u)
{
    const struct model *model = stage->census.tiles[local].path = census_choose(&stage->census, local);
    const struct mesh *mesh = stage->mesh;
    struct level *level = stage->level;
    struct stage_work *work = stage->work;
    size_t n_cell = mesh->n_cell;
    struct metric metric;
    if (mesh->beta) metric_of_tile(mesh, level, &level->tiles[level->first + local], &metric);
    stage_clear_rates(stage, model);
    const double *hoop = stage_hoop(stage, model, level->w[local]);
    for (int axis = 0; axis < mesh->dim; axis++) stage_sweep(stage, model, local, axis, &metric, hoop);
    if (model->kapila) {
        mix_stiffness_everywhere(model, n_cell, n_cell, level->w[local], work->rho_c2);
        mix_closure(model, n_cell, n_cell, level->w[local], work->rho_c2, work->K);
    }
    if (stage->fluxes) reflux_keep(stage->reflux, model, local, level->w[local], model->kapila ? work->K : NULL);
    source_add(work->source, model, level, &level->tiles[level->first + local], stage->bound->t, level->w[local],
               work->rates);
    struct update_input input = {.u_old = level->u_old[local],
                                 .w = level->w[local],
                                 .K = work->K,
                                 .rho_c2 = work->rho_c2,
                                 .rates = work->rates,
                                 .h = update_length(level, mesh->dim)};
    stage->clipped += (long long)update_apply(model, n_cell, dt, &input, u);
    stage->cells += (long long)n_cell;
    if (blame_concerns(stage->blame, local)) blame_rates(stage->blame, stage->model, &input);
    cost_lap(&work->cost, COST_UPDATE);
}

/* Primitives of u, into w, and the guard's judgement; `before`: an earlier admissible state. */
static void stage_judge(struct stage *stage, unsigned local, int judged, const double *before, double *u, double *w)
{
    struct stage_work *work = stage->work;
    const struct model *model = stage->census.tiles[local].path;
    size_t n_cell = stage->mesh->n_cell;
    mix_pressure_sum(&stage->effort, mix_primitives(model, n_cell, n_cell, u, w));
    mix_stiffness(model, n_cell, n_cell, w, work->rho_c2);
    mix_speed2(model, n_cell, n_cell, w, work->rho_c2, work->c2);
    if (blame_concerns(stage->blame, local)) blame_result(stage->blame, model, u, w);
    struct guard_tile tile = {.model = model,
                              .local = local,
                              .stage = judged,
                              .u_old = before,
                              .u = u,
                              .w = w,
                              .rho_c2 = work->rho_c2,
                              .c2 = work->c2};
    guard_check(stage->guard, &tile);
    census_note(&stage->census, local, u, w);
    cost_lap(&work->cost, COST_PRIMITIVES);
}

static void stage_half_tile(struct stage *stage, unsigned local)
{
    const struct level *level = stage->level;
    size_t n_cell = stage->mesh->n_cell, p = stage->model->i_E * n_cell;
    double *w = level->w[local], *w_star = level->u_new[local];
    if (stage_is_hidden(stage, local) || stage_skips(stage, local)) {
        stage_carry(stage, local, w, w_star);
        return;
    }
    stage_advance_tile(stage, local, 0.5 * stage->dt, stage->work->u_star);
    stage_keep(stage, local, w, w_star);
    memcpy(w_star + p, w + p, n_cell * sizeof *w); /* where an iteration starts */
    stage_judge(stage, local, 0, level->u_old[local], stage->work->u_star, w_star);
}

static void stage_full_tile(struct stage *stage, unsigned local)
{
    const struct level *level = stage->level;
    struct census_tile *tile = &stage->census.tiles[local];
    tile->skipped = stage_is_hidden(stage, local) || stage_skips(stage, local);
    if (tile->skipped) {
        stage_carry(stage, local, level->u_old[local], level->u_new[local]);
        return;
    }
    stage_advance_tile(stage, local, stage->dt, level->u_new[local]);
    stage_keep(stage, local, level->u_old[local], level->u_new[local]);
}

/* All tiles, those without remote neighbours while the exchange is under way. `at`: how far the stage is into the
 * step, 0 or 1/2. */
static void stage_tiles(struct stage *stage, double at, void (*work)(struct stage *stage, unsigned local))
{
    const struct level *level = stage->level;
    stage->bound->t = stage->t + at * stage->dt;
    if (stage->blame) stage->blame->turn = at > 0.0;
    if (level->link) level->link->theta = stage->from + at * stage->part;
    for (unsigned tile = 0; tile < level->n_local; tile++)
        if (!halo_is_remote(level, tile)) work(stage, tile);
    stage_finish_exchange(stage);
    for (unsigned tile = 0; tile < level->n_local; tile++)
        if (halo_is_remote(level, tile)) work(stage, tile);
    stage->bound->model = stage->model; /* strips and births need all fields, whatever the last tile held */
}

void stage_half(struct stage *stage)
{
    struct level *level = stage->level;
    stage_tiles(stage, 0.0, stage_half_tile);
    double **w_star = level->u_new;
    level->u_new = level->w;
    level->w = w_star;
    for (unsigned tile = 0; tile < level->n_local; tile++) census_turn(&stage->census.tiles[tile]);
}

void stage_full(struct stage *stage)
{
    stage->fluxes = stage->reflux->down || stage->reflux->up;
    stage_tiles(stage, 0.5, stage_full_tile);
    stage->fluxes = false;
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

/* Signal of the tile that was judged last: its speeds are in the work space. */
static void stage_measure(struct stage *stage, unsigned local, const double *w)
{
    const struct model *model = stage->model;
    const struct mesh *mesh = stage->mesh;
    const double *u[3];
    double per_h[3], most = 0.0, *signal = stage->work->rates; /* rates are free between stages */
    for (int d = 0; d < 3; d++) {                              /* unused axes: any field, with weight zero */
        bool used = d < mesh->dim;
        u[d] = w + (model->i_u + (used ? (unsigned)d : 0)) * mesh->n_cell;
        per_h[d] = used ? 1.0 / stage->level->h[d] : 0.0;
    }
    stage_signal(mesh->n_cell, stage->work->c2, u, per_h, signal);
    for (size_t i = 0; i < mesh->n_cell; i++)
        if (signal[i] > most) most = signal[i];
    stage->census.tiles[local].signal = most;
}

void stage_survey(struct stage *stage)
{
    stage->signal = 0.0;
    for (unsigned tile = 0; tile < stage->level->n_local; tile++)
        if (stage->census.tiles[tile].signal > stage->signal) stage->signal = stage->census.tiles[tile].signal;
}

void stage_close(struct stage *stage)
{
    const struct level *level = stage->level;
    for (unsigned tile = 0; tile < level->n_local; tile++) {
        if (!stage->census.tiles[tile].skipped) {
            stage_judge(stage, tile, 1, level->u_old[tile], level->u_new[tile], level->w[tile]);
            stage_measure(stage, tile, level->w[tile]);
        }
        census_turn(&stage->census.tiles[tile]);
    }
    stage_survey(stage);
}

void stage_reset(struct stage *stage)
{
    const struct level *level = stage->level;
    size_t n_cell = stage->mesh->n_cell;
    for (unsigned tile = 0; tile < level->n_local; tile++) {
        mix_primitives(stage->model, n_cell, n_cell, level->u_old[tile], level->w[tile]);
        census_forget(&stage->census, tile);
    }
}

int stage_start(struct stage *stage)
{
    const struct level *level = stage->level;
    size_t bytes = stage->model->n_field * stage->mesh->n_cell * sizeof(double);
    bool repair = stage->guard->repair;
    stage_reset(stage);
    guard_attempt(stage->guard);
    stage->guard->repair = false;
    for (unsigned tile = 0; tile < level->n_local; tile++) {
        memcpy(level->u_new[tile], level->u_old[tile], bytes); /* an earlier state, for stage_touch */
        stage_judge(stage, tile, 1, level->u_new[tile], level->u_old[tile], level->w[tile]);
        stage_measure(stage, tile, level->w[tile]);
        census_turn(&stage->census.tiles[tile]);
    }
    stage_survey(stage);
    stage->guard->repair = repair;
    guard_clear(stage->guard);
    if (!stage->guard->cause[0]) return STATUS_OK;
    return status_fail(STATUS_CASE, "the initial state is not admissible: %s", stage->guard->cause);
}

void stage_touch(struct stage *stage, unsigned local)
{
    const struct level *level = stage->level;
    struct census_tile *tile = &stage->census.tiles[local];
    double *u = level->u_old[local], *w = level->w[local];
    unsigned present = census_materials(stage->model, stage->mesh->n_cell, u);
    if (tile->path != stage->model && present != tile->present) tile->path = stage->model;
    stage_judge(stage, local, 1, level->u_new[local], u, w);
    stage_measure(stage, local, w);
    census_turn(tile);
}

/* A tile whose primitives are there, from another rank or just made: census and signal. */
static void stage_welcome(struct stage *stage, unsigned local)
{
    const struct model *model = stage->model;
    struct stage_work *work = stage->work;
    const double *w = stage->level->w[local];
    size_t n_cell = stage->mesh->n_cell;
    census_forget(&stage->census, local);
    mix_stiffness(model, n_cell, n_cell, w, work->rho_c2);
    mix_speed2(model, n_cell, n_cell, w, work->rho_c2, work->c2);
    stage_measure(stage, local, w);
}

static void stage_admit(struct stage *stage, unsigned local, bool born)
{
    const struct level *level = stage->level;
    size_t n_cell = stage->mesh->n_cell;
    double *w = level->w[local];
    if (born) mix_primitives(stage->model, n_cell, n_cell, level->u_old[local], w);
    memcpy(level->u_new[local], level->u_old[local], stage->model->n_field * n_cell * sizeof *w); /* for stage_touch */
    stage_welcome(stage, local);
}

/* The tiles of the level are others: those that stayed keep what is known of them. */
static void stage_move(struct stage *stage, const int *from, const bool *born)
{
    const struct level *level = stage->level;
    struct census_tile *before = stage->census.tiles;
    stage->census.tiles = mem_new(level->n_local, sizeof *stage->census.tiles);
    for (unsigned tile = 0; tile < level->n_local; tile++) {
        if (from[tile] >= 0) stage->census.tiles[tile] = before[from[tile]];
        else stage_admit(stage, tile, born[level->first + tile]);
    }
    mem_free(before);
    stage->bound = bound_paint(stage->model, stage->mesh, level, stage->bound, from);
    guard_free(stage->guard);
    stage->guard = guard_new(stage->model, stage->mesh, stage->l);
    stage_survey(stage);
}

void stage_adopt(struct stage *stage, const int *from, const bool *born)
{
    const struct level *level = stage->level;
    if (from) stage_move(stage, from, born);
    reflux_free(stage->reflux);
    stage->reflux = reflux_new(stage->model, stage->mesh, stage->l);
    mem_free(stage->census.behind);
    stage->census.behind = mem_new(level->link ? level->link->n_face : 0, sizeof *stage->census.behind);
}
