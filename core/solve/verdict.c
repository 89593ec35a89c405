/* verdict.c - see verdict.h. */
#include "solve/verdict.h"

#include "base/status.h"
#include "phys/mix.h"
#include "phys/row.h"
#include "scheme/bound_ahead.h"
#include "solve/guard_name.h"
#include "solve/rkl.h"
#include "solve/soften.h"

#include <string.h>

static const double VERDICT_START = 1e5; /* [Pa] */

static int verdict_last(const struct stage *stage)
{
    return stage->tableau->n - 1;
}

void verdict_hold(struct stage *stage, unsigned local, const double *w)
{
    size_t n_cell = stage->mesh->n_cell;
    bool read = work_operators(stage->work, stage->census.tiles[local].path)->reads;
    if (!read && !soften_applies(stage->model)) return;
    memcpy(stage->work->rates, w + stage->model->i_E * n_cell, n_cell * sizeof *w);
}

void verdict_forget(struct stage *stage, unsigned local)
{
    size_t n_cell = stage->mesh->n_cell;
    double *p = stage->level->w[local] + stage->model->i_E * n_cell;
    for (size_t i = 0; i < n_cell; i++) p[i] = VERDICT_START;
}

void verdict_judge(struct stage *stage, unsigned local, int judged, const double *before, double *u, double *w)
{
    struct work *work = stage->work;
    const struct model *model = stage->census.tiles[local].path;
    size_t n_cell = stage->mesh->n_cell;
    bool softens = model->n_alpha > 1 && soften_applies(stage->model);
    mix_pressure_sum(&stage->effort, mix_primitives(model, n_cell, n_cell, u, w));
    mix_stiffness(model, n_cell, n_cell, w, work->rho_c2);
    mix_speed2(model, n_cell, n_cell, w, work->rho_c2, work->c2);
    if (blame_concerns(stage->blame, local)) blame_result(stage->blame, model, u, w);
    struct guard_tile tile = {.model = model,
                              .local = local,
                              .stage = judged,
                              .u_old = before,
                              .p_before = softens ? work->rates : NULL, /* of verdict_hold */
                              .u = u,
                              .w = w,
                              .rho_c2 = work->rho_c2,
                              .c2 = work->c2};
    guard_check(stage->guard, &tile);
    census_note(&stage->census, local, u, w);
    cost_lap(&work->cost, COST_PRIMITIVES);
}

/* The fastest cell; with super steps what diffuses only counts beyond the most stages. Rates are free between
 * stages. */
static double verdict_pace(const struct stage *stage, struct term_pace pace)
{
    const struct terms *terms = stage->work->terms[0];
    double *rates = stage->work->rates, slow, diffusion;
    bool super = stage->model->scene->scheme.diffusion == SCENE_DIFFUSION_RKL2;
    pace.part = super ? TERM_SLOW : TERM_WHOLE;
    terms_pace(terms, &pace, rates);
    slow = row_most(pace.n_cell, rates);
    if (!super) return slow;
    pace.part = TERM_DIFFUSION;
    terms_pace(terms, &pace, rates);
    diffusion = rkl_relief() * row_most(pace.n_cell, rates);
    return slow > diffusion ? slow : diffusion;
}

void verdict_measure(struct stage *stage, unsigned local, const double *w)
{
    size_t n_cell = stage->mesh->n_cell;
    const struct model *path = stage->census.tiles[local].path; /* what a tile lacks cannot hold up its steps */
    const struct term_pace pace = {.model = path,
                                   .mesh = stage->mesh,
                                   .level = stage->level,
                                   .tile = &stage->level->tiles[stage->level->first + local],
                                   .n_cell = n_cell,
                                   .w = w,
                                   .c2 = stage->work->c2};
    stage->census.tiles[local].signal = verdict_pace(stage, pace);
}

void verdict_survey(struct stage *stage)
{
    stage->signal = 0.0;
    for (unsigned tile = 0; tile < stage->level->n_local; tile++)
        if (!stage_tile(stage, tile)->sleeps && stage->census.tiles[tile].signal > stage->signal)
            stage->signal = stage->census.tiles[tile].signal;
}

/* Signal of the layer behind a side of a piece, taken for cells of the tile. All scratch is free between stages. */
static double verdict_layer(struct stage *stage, unsigned local, const struct frame *frame, int side)
{
    const struct model *model = stage->model;
    struct work *work = stage->work;
    size_t n = frame->outer * frame->inner;
    double *row = work->u_star;
    bound_ahead_row(stage->bound, local, frame, side, stage->level->w[local], FACE_ROOM, work->faces->frame, row);
    mix_stiffness(model, n, n, row, work->rho_c2);
    mix_speed2(model, n, n, row, work->rho_c2, work->c2);
    const struct term_pace pace = {
        .model = model, .mesh = stage->mesh, .level = stage->level, .n_cell = n, .w = row, .c2 = work->c2};
    return verdict_pace(stage, pace);
}

double verdict_ahead(struct stage *stage, double t)
{
    double most = 0.0, was = stage->bound->t;
    stage->bound->t = t;
    for (unsigned local = 0; local < stage->level->n_local; local++)
        for (int face = 0; face < 2 * stage->mesh->dim; face++) {
            size_t pieces = frame_pieces(stage->mesh, face / 2);
            if (stage_tile(stage, local)->sleeps || !bound_ahead_is(stage->bound, local, face)) continue;
            for (size_t index = 0; index < pieces; index++) {
                struct frame frame = frame_piece(stage->mesh, face / 2, index);
                double signal = verdict_layer(stage, local, &frame, face % 2);
                if (signal > most) most = signal;
            }
        }
    stage->bound->t = was;
    return most;
}

void verdict_touch(struct stage *stage, unsigned local)
{
    const struct level *level = stage->level;
    struct census_tile *tile = &stage->census.tiles[local];
    double *u = level->u_old[local], *w = level->w[local];
    unsigned present = census_materials(stage->model, stage->mesh->n_cell, u);
    if (tile->path != stage->model && present != tile->present) tile->path = stage->model;
    verdict_hold(stage, local, w);
    verdict_judge(stage, local, verdict_last(stage), level->u_new[local], u, w);
    verdict_measure(stage, local, w);
    census_turn(tile);
}

void verdict_reset(struct stage *stage)
{
    const struct level *level = stage->level;
    size_t n_cell = stage->mesh->n_cell;
    for (unsigned tile = 0; tile < level->n_local; tile++) {
        if (stage_tile(stage, tile)->sleeps && level->stale) continue;
        verdict_forget(stage, tile);
        mix_primitives(stage->model, n_cell, n_cell, level->u_old[tile], level->w[tile]);
        census_forget(&stage->census, tile);
    }
}

/* No stage is behind the first cause of all. */
static int verdict_refuse(const struct stage *stage)
{
    const char *cause = stage->guard->cause, *end = strstr(cause, ", after stage");
    return status_fail(STATUS_CASE, "the initial state is not admissible: %.*s%s",
                       end ? (int)(end - cause) : (int)strlen(cause), cause,
                       strstr(cause, GUARD_NAME_TENSION)
                           ? " ('balance: tension' of a layer adds to its pressure what its curvature "
                             "and surface tension ask for)"
                           : "");
}

int verdict_start(struct stage *stage, long long *relaxed)
{
    const struct level *level = stage->level;
    size_t bytes = stage->model->n_field * stage->mesh->n_cell * sizeof(double);
    bool repair = stage->guard->repair;
    verdict_reset(stage);
    guard_attempt(stage->guard);
    stage->guard->repair = relaxed && repair && stage->model->split;
    for (unsigned tile = 0; tile < level->n_local; tile++) {
        memcpy(level->u_new[tile], level->u_old[tile], bytes); /* an earlier state, for verdict_touch */
        verdict_hold(stage, tile, level->w[tile]);
        verdict_judge(stage, tile, verdict_last(stage), level->u_new[tile], level->u_old[tile], level->w[tile]);
        verdict_measure(stage, tile, level->w[tile]);
        census_turn(&stage->census.tiles[tile]);
    }
    verdict_survey(stage);
    if (relaxed) *relaxed += stage->guard->relaxed;
    stage->guard->repair = repair;
    guard_clear(stage->guard);
    if (!relaxed || !stage->guard->cause[0]) return STATUS_OK;
    return verdict_refuse(stage);
}

void verdict_welcome(struct stage *stage, unsigned local)
{
    const struct model *model = stage->model;
    struct work *work = stage->work;
    const double *w = stage->level->w[local];
    size_t n_cell = stage->mesh->n_cell;
    census_forget(&stage->census, local);
    mix_stiffness(model, n_cell, n_cell, w, work->rho_c2);
    mix_speed2(model, n_cell, n_cell, w, work->rho_c2, work->c2);
    verdict_measure(stage, local, w);
}
