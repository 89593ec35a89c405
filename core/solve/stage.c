/* stage.c - see stage.h.
 *
 * Tiles are independent within a stage: each gathers what it needs from the primitives of all and
 * writes its own block. Tiles that touch another rank come last, so that the exchange hides
 * behind the others; the order of tiles never changes a value. */
#include "solve/stage.h"

#include "base/mem.h"
#include "phys/elastic.h"
#include "scheme/shore.h"
#include "solve/foresee.h"
#include "solve/keep.h"
#include "solve/operate.h"
#include "solve/rkl.h"
#include "solve/stage_exchange.h"
#include "solve/verdict.h"

#include <string.h>

struct stage *stage_new(const struct model *model, struct mesh *mesh, int l, struct work *work)
{
    struct stage *stage = mem_new(1, sizeof *stage);
    *stage = (struct stage){.model = model, .mesh = mesh, .l = l, .level = &mesh->levels[l], .work = work, .blind = -1};
    stage->tableau = tableau_of(model->scene);
    stage->census = (struct census){.model = model, .mesh = mesh, .level = stage->level};
    return stage;
}

void stage_free(struct stage *stage)
{
    if (!stage) return;
    guard_free(stage->guard);
    rkl_free(stage->rkl);
    blame_free(stage->blame);
    bound_free(stage->bound);
    reflux_free(stage->reflux);
    mem_free(stage->census.tiles);
    mem_free(stage->census.behind);
    mem_free(stage->previous);
    mem_free(stage->shore);
    mem_free(stage->evaporated);
    mem_free(stage);
}

/* One tile in one stage, for the callbacks of rate.h. */
struct stage_sweep {
    struct stage *stage;
    const struct terms *terms;
    unsigned local;
    bool concerned; /* a coarse-fine face wants its fluxes */
};

/* Gathers a piece, and the marks of troubled cells. */
static void stage_gather(void *data, const struct frame *frame, struct face_work *faces)
{
    const struct stage_sweep *sweep = data;
    struct stage *stage = sweep->stage;
    const struct model *path = sweep->terms->model;
    const struct level *level = stage->level;
    const struct guard *guard = stage->guard;
    const struct frame_source fields = {.mesh = stage->mesh,
                                        .level = level,
                                        .arrays = level->w,
                                        .halo = level->halo,
                                        .link = level->link,
                                        .n_field = path->n_active,
                                        .fields = path->active,
                                        .boundary = bound_fill,
                                        .data = stage->bound};
    const struct frame_source marks = {.mesh = stage->mesh,
                                       .level = level,
                                       .arrays = guard->mask,
                                       .halo = guard->halo,
                                       .n_field = 1,
                                       .boundary = bound_copy};
    cost_lap(&stage->work->cost, COST_UPDATE); /* of the piece before */
    frame_gather(&fields, sweep->local, frame, FACE_ROOM, faces->frame);
    if (guard->masked) frame_gather(&marks, sweep->local, frame, FACE_ROOM, faces->mask);
    if (stage->bound->status && stage->blind < 0) stage->blind = 3 * (int)sweep->local + frame->axis;
    if (blame_concerns(stage->blame, sweep->local)) blame_frame(stage->blame, path, frame, faces);
    foresee_gather(stage, &fields, frame, sweep->local + 1);
    cost_lap(&stage->work->cost, COST_GATHER);
}

/* The fluxes of a piece: what other levels and the blame keep of them. */
static void stage_seen(void *data, const struct frame *frame, struct face_work *faces)
{
    const struct stage_sweep *sweep = data;
    struct stage *stage = sweep->stage;
    (void)faces;
    cost_lap(&stage->work->cost, COST_FACES);
    if (blame_concerns(stage->blame, sweep->local)) blame_faces(stage->blame, sweep->terms, frame);
    if (sweep->concerned) reflux_collect(stage->reflux, sweep->terms, sweep->local, frame);
}

static void stage_swept(void *data, int axis)
{
    const struct stage_sweep *sweep = data;
    if (sweep->concerned) reflux_average(sweep->stage->reflux, sweep->local, axis);
}

/* One tile in the stage under way, before its rates are taken. */
static void stage_tile_open(struct stage *stage, unsigned local, enum term_part part, double dt,
                            struct stage_tile_work *ret)
{
    const struct model *path = stage->census.tiles[local].path;
    const struct tableau_stage *row = &stage->tableau->stage[stage->turn];
    struct work *work = stage->work;
    struct level *level = stage->level;
    ret->tile = (struct term_tile){.terms = work_terms(work, path),
                                   .model = path,
                                   .mesh = stage->mesh,
                                   .level = level,
                                   .tile = stage_tile(stage, local),
                                   .metric = &ret->metric,
                                   .n_cell = stage->mesh->n_cell,
                                   .t = stage->bound->t,
                                   .dt = dt,
                                   .begun = row->previous ? stage->bound->t : stage->t,
                                   .part = part,
                                   .u = row->previous ? keep_previous(stage, local) : level->u_old[local],
                                   .w = level->w[local],
                                   .rates = work->rates,
                                   .K = work->K,
                                   .rho_c2 = work->rho_c2};
    if (stage->mesh->beta) metric_of_tile(stage->mesh, level, ret->tile.tile, &ret->metric);
    ret->tile.around = model_looks_around(path) ? around_gather(work->around, stage->l, stage->bound, local) : NULL;
    stage->bound->model = path;
}

unsigned char *stage_shore(const struct stage *stage, unsigned local)
{
    return stage->shore ? stage->shore + local * shore_marks(stage->model, stage->mesh) : NULL;
}

void stage_rates(struct stage *stage, unsigned local, enum term_part part, double dt, bool counts,
                 struct stage_tile_work *ret)
{
    struct stage_sweep sweep = {stage, NULL, local, counts && reflux_concerns(stage->reflux, local)};
    const struct rate_watch watch = {&sweep, stage_gather, stage_seen, stage_swept};
    stage_tile_open(stage, local, part, dt, ret);
    sweep.terms = ret->tile.terms;
    rate_take(&ret->tile, stage->work->own, &watch, stage->guard->masked);
    const struct model *path = ret->tile.model;
    if (path->fronts && part != TERM_DIFFUSION)
        shore_look(path, stage->mesh, ret->tile.around, stage->work->shore, stage_shore(stage, local));
    if (sweep.concerned) reflux_keep(stage->reflux, path, local, ret->tile.w, path->kapila ? ret->tile.K : NULL);
}

/* The path of a tile in the stage under way. One that is recorded has no operators that wait: a replay asks none. */
static const struct model *stage_path(const struct stage *stage, unsigned local)
{
    const struct model *path = census_choose(&stage->census, local);
    bool waits = work_operators(stage->work, path)->n_waiting > 0;
    return waits && blame_concerns(stage->blame, local) ? stage->model : path;
}

/* u = the state of this stage of one tile; of a narrowed path the active components only. */
static void stage_advance_tile(struct stage *stage, unsigned local, double *u)
{
    const struct tableau_stage *row = &stage->tableau->stage[stage->turn];
    const double *u_old = stage->level->u_old[local];
    struct work *work = stage->work;
    struct stage_tile_work own;
    stage->census.tiles[local].path = stage_path(stage, local);
    foresee_block(stage, local, u_old);
    if (u != work->u_star) foresee_block(stage, local, u);
    stage_rates(stage, local, work->part, row->step * stage->dt, row->weight > 0.0, &own);
    stage->clipped += (long long)rate_apply(&own.tile, work->own, u);
    rate_mix(&own.tile, u_old, row->mix, u);
    stage->cells += (long long)stage->mesh->n_cell;
    if (blame_concerns(stage->blame, local)) blame_rates(stage->blame, stage->model, &own.tile, u_old);
    cost_lap(&work->cost, COST_UPDATE);
}

/* A tile in a stage of slopes: primitives alone. */
static void stage_slope_tile(struct stage *stage, unsigned local, double *w_next)
{
    struct work *work = stage->work;
    struct census_tile *tile = &stage->census.tiles[local];
    struct stage_tile_work own;
    struct stage_sweep sweep = {.stage = stage, .local = local};
    const struct rate_watch watch = {.data = &sweep, .gather = stage_gather};
    tile->path = census_choose(&stage->census, local);
    stage_tile_open(stage, local, work->part, stage->tableau->stage[stage->turn].step * stage->dt, &own);
    sweep.terms = own.tile.terms;
    hancock_take(work->hancock, &own.tile, work->own, &watch, w_next);
    stage->cells += (long long)stage->mesh->n_cell;
    census_note_primitives(&stage->census, local, w_next);
    cost_lap(&work->cost, COST_UPDATE);
}

/* Does the stage under way take slopes? */
static bool stage_slopes(const struct stage *stage)
{
    return stage->tableau->stage[stage->turn].slopes && !stage->guard->masked && stage->steps >= HANCOCK_AFTER;
}

/* A tile in a stage that is not the last: from w to the primitives of the next stage. */
static void stage_inner_tile(struct stage *stage, unsigned local)
{
    const struct level *level = stage->level;
    size_t n_cell = stage->mesh->n_cell, p = stage->model->i_E * n_cell;
    double *w = level->w[local], *w_next = level->u_new[local];
    if (keep_skips(stage, local)) {
        keep_tile(stage, local, w, w_next);
        keep_stage(stage, local, NULL);
        return;
    }
    if (stage_slopes(stage)) {
        stage_slope_tile(stage, local, w_next);
        keep_rows(stage, local, w, w_next);
        return;
    }
    stage_advance_tile(stage, local, stage->work->u_star);
    keep_rows(stage, local, w, w_next);
    memcpy(w_next + p, w + p, n_cell * sizeof *w); /* where an iteration starts */
    verdict_hold(stage, local, w_next);
    operate_tile(stage, local, stage->work->u_star, w_next);
    verdict_judge(stage, local, stage->turn, level->u_old[local], stage->work->u_star, w_next);
    keep_stage(stage, local, stage->work->u_star);
}

/* A tile in the last stage: from w to u_new. */
static void stage_last_tile(struct stage *stage, unsigned local)
{
    const struct level *level = stage->level;
    if (keep_skips(stage, local)) {
        keep_tile(stage, local, level->u_old[local], level->u_new[local]);
        return;
    }
    stage_advance_tile(stage, local, level->u_new[local]);
    keep_rows(stage, local, level->u_old[local], level->u_new[local]);
}

/* Those without remote neighbours while the exchange is under way. */
void stage_tiles(struct stage *stage, void (*work)(struct stage *stage, unsigned local))
{
    const struct level *level = stage->level;
    stage->bound->t = stage->t + stage->at * stage->dt;
    if (stage->blame) stage->blame->turn = stage->turn;
    if (level->link) level->link->theta = stage->from + stage->at * stage->part;
    for (unsigned tile = 0; tile < level->n_local; tile++)
        if (!stage_exchange_waits(stage, tile)) work(stage, tile);
    stage_exchange_finish(stage);
    for (unsigned tile = 0; tile < level->n_local; tile++)
        if (stage_exchange_waits(stage, tile)) work(stage, tile);
    stage->bound->model = stage->model; /* strips and births need all fields, whatever the last tile held */
}

void stage_take(struct stage *stage)
{
    struct level *level = stage->level;
    int turn = stage->turn;
    if (rkl_acts(stage)) {
        rkl_take(stage);
        return;
    }
    reflux_weigh(stage->reflux, stage->tableau->stage[turn].weight, tableau_is_first_weight(stage->tableau, turn));
    if (turn + 1 == stage->tableau->n) {
        stage_tiles(stage, stage_last_tile);
        return;
    }
    stage_tiles(stage, stage_inner_tile);
    double **w_next = level->u_new;
    level->u_new = level->w;
    level->w = w_next;
    for (unsigned tile = 0; tile < level->n_local; tile++) census_turn(&stage->census.tiles[tile]);
}

void stage_close(struct stage *stage)
{
    const struct level *level = stage->level;
    for (unsigned tile = 0; tile < level->n_local; tile++) {
        if (!stage->census.tiles[tile].skipped) {
            foresee_close(stage, tile + 1);
            verdict_hold(stage, tile, level->w[tile]);
            operate_tile(stage, tile, level->u_new[tile], level->w[tile]);
            verdict_judge(stage, tile, stage->turn, level->u_old[tile], level->u_new[tile], level->w[tile]);
            verdict_measure(stage, tile, level->w[tile]);
        }
        census_turn(&stage->census.tiles[tile]);
    }
    verdict_survey(stage);
}
