/* blame_replay.c - see blame_replay.h. The mesh is a single tile, made by hand: nothing asks for its neighbours, because the frames
 * are given. */
#include "solve/blame_replay.h"

#include "base/mem.h"
#include "phys/mix.h"
#include "scheme/source.h"
#include "scheme/update.h"
#include "solve/guard.h"
#include "solve/pace.h"

#include <string.h>

/* The work space of one tile. */
struct replay {
    const struct model *model, *used;
    const struct blame *blame;
    struct blame *again;
    struct mesh mesh;
    struct level *level;
    struct tile tile;
    struct face_work *faces;
    double *rates, *K, *rho_c2, *c2, *u, *w;
};

static void replay_mesh(struct replay *replay)
{
    const struct blame_facts *facts = &replay->blame->facts;
    const struct scene *scene = replay->model->scene;
    struct mesh *mesh = &replay->mesh;
    *mesh = (struct mesh){.dim = scene->dim,
                          .beta = (int)scene->geometry,
                          .n_cell = facts->n_cell,
                          .n_field = replay->model->n_field,
                          .n_alpha = replay->model->n_alpha,
                          .ghosts = scene->ghosts,
                          .n_level = facts->level + 1};
    replay->tile = (struct tile){.covered = (unsigned char)facts->covered};
    replay->level = &mesh->levels[facts->level];
    *replay->level = (struct level){.n_tile = 1, .n_local = 1, .tiles = &replay->tile};
    for (int d = 0; d < 3; d++) {
        mesh->n[d] = facts->n[d];
        mesh->lower[d] = d < scene->dim ? scene->lower[d] : 0.0;
        mesh->upper[d] = d < scene->dim ? scene->upper[d] : 1.0;
        replay->tile.at[d] = facts->tile[d];
        replay->level->h[d] = facts->h[d];
        replay->level->extent[d] = facts->extent[d];
    }
}

static struct replay *replay_new(const struct model *model, const struct blame *blame)
{
    struct replay *replay = mem_new(1, sizeof *replay);
    size_t n_cell = blame->facts.n_cell;
    replay->model = model;
    replay->used = model_numbered(model, blame->facts.pure);
    replay->blame = blame;
    replay_mesh(replay);
    replay->again = blame_like(model, &blame->facts);
    replay->faces = face_new(replay->used);
    replay->rates = mem_new(update_rates(replay->used) * n_cell, sizeof(double));
    replay->K = mem_new(model->n_material * n_cell, sizeof(double));
    replay->rho_c2 = mem_new(model->n_material * n_cell, sizeof(double));
    replay->c2 = mem_new(n_cell, sizeof(double));
    replay->u = mem_new(model->n_field * n_cell, sizeof(double));
    replay->w = mem_new(model->n_field * n_cell, sizeof(double));
    return replay;
}

static void replay_free(struct replay *replay)
{
    double *blocks[] = {replay->rates, replay->K, replay->rho_c2, replay->c2, replay->u, replay->w};
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) mem_free(blocks[i]);
    face_free(replay->faces);
    blame_free(replay->again);
    mem_free(replay);
}

static void replay_sweep(struct replay *replay, int axis, const struct metric *metric, const double *hoop)
{
    const struct blame *blame = replay->blame;
    for (size_t piece = 0; piece < frame_pieces(&replay->mesh, axis); piece++) {
        struct frame frame = frame_piece(&replay->mesh, axis, piece);
        blame_give(blame, replay->used, &frame, replay->faces);
        face_solve(replay->faces, &frame, blame->facts.masked);
        blame_piece(replay->again, replay->used, &frame, replay->faces);
        update_add(replay->used, replay->level, metric, &frame, replay->faces, blame->facts.n_cell, hoop,
                   replay->rates);
    }
}

static void replay_sources(struct replay *replay)
{
    const struct blame_facts *facts = &replay->blame->facts;
    struct source *source = source_new(replay->model, &replay->mesh);
    double at = facts->stage == 0 ? 0.0 : 0.5;
    source_add(source, replay->used, replay->level, &replay->tile, facts->t + at * facts->dt,
               replay->blame->block[BLAME_W], replay->rates);
    source_free(source);
}

/* From the frames to the new conserved fields. */
static void replay_update(struct replay *replay)
{
    const struct blame *blame = replay->blame;
    const struct model *used = replay->used;
    size_t n_cell = blame->facts.n_cell;
    const double *w = blame->block[BLAME_W];
    struct metric metric;
    if (replay->mesh.beta) metric_of_tile(&replay->mesh, replay->level, &replay->tile, &metric);
    const double *hoop = w + used->i_E * n_cell;
    if (used->beta && used->n_stretch) {
        mix_hoop(used, n_cell, n_cell, w, replay->c2); /* free until the new state is judged */
        hoop = replay->c2;
    }
    for (int axis = 0; axis < replay->mesh.dim; axis++) replay_sweep(replay, axis, &metric, hoop);
    if (used->kapila) {
        mix_stiffness_everywhere(used, n_cell, n_cell, w, replay->rho_c2);
        mix_closure(used, n_cell, n_cell, w, replay->rho_c2, replay->K);
    }
    replay_sources(replay);
    struct update_input input = {.u_old = blame->block[BLAME_U_OLD],
                                 .w = w,
                                 .K = replay->K,
                                 .rho_c2 = replay->rho_c2,
                                 .rates = replay->rates,
                                 .h = update_length(replay->level, replay->mesh.dim)};
    double part = blame->facts.stage == 0 ? 0.5 : 1.0;
    update_apply(used, n_cell, part * blame->facts.dt, &input, replay->u);
}

/* The guard's opinion of the new state, which it may change. */
static void replay_judge(struct replay *replay, struct blame_outcome *outcome)
{
    const struct blame_facts *facts = &replay->blame->facts;
    struct guard guard = {.model = replay->model,
                          .mesh = &replay->mesh,
                          .level = replay->level,
                          .l = facts->level,
                          .n_local = 1,
                          .repair = facts->repair,
                          .last = true};
    struct guard_tile tile = {.model = replay->used,
                              .stage = facts->stage == 0 ? 0 : 1,
                              .u_old = replay->blame->block[BLAME_U_OLD],
                              .u = replay->u,
                              .w = replay->w,
                              .rho_c2 = replay->rho_c2,
                              .c2 = replay->c2};
    size_t n_cell = facts->n_cell;
    if (facts->stage == BLAME_TOO_SLOW) {
        guard.found.cell = facts->cell;
        pace_judge(&guard, replay->used, replay->blame->block[BLAME_W], &guard.found);
    } else {
        mix_stiffness(replay->used, n_cell, n_cell, replay->w, replay->rho_c2);
        mix_speed2(replay->used, n_cell, n_cell, replay->w, replay->rho_c2, replay->c2);
        guard_check(&guard, &tile);
        mem_free(guard.kept);
    }
    outcome->value = guard.found.value;
    outcome->same_value = !memcmp(&guard.found.value, &facts->value, sizeof facts->value);
    outcome->same_verdict = !strcmp(guard.found.words, facts->verdict);
    memcpy(outcome->verdict, guard.found.words, sizeof outcome->verdict);
}

/* Columns of a block in which any row differs. */
static size_t replay_differences(const struct replay *replay, enum blame_block block)
{
    struct blame_shape shape = blame_shape(replay->model, &replay->blame->facts, block);
    const double *was = replay->blame->block[block], *is = replay->again->block[block];
    size_t count = 0;
    for (size_t c = 0; c < shape.columns; c++) {
        bool differs = false;
        for (unsigned r = 0; r < shape.rows; r++) {
            size_t at = r * shape.columns + c;
            differs = differs || memcmp(was + at, is + at, sizeof *was) != 0;
        }
        count += differs;
    }
    return count;
}

void blame_replay(const struct model *model, const struct blame *blame, struct blame_outcome *ret_outcome)
{
    struct replay *replay = replay_new(model, blame);
    const struct blame_facts *facts = &blame->facts;
    size_t bytes = model->n_field * facts->n_cell * sizeof(double);
    memcpy(replay->u, blame->block[blame_moves(facts) ? BLAME_U_OLD : BLAME_U], bytes);
    memcpy(replay->w, blame->block[BLAME_W], bytes); /* where an iteration starts */
    if (blame_moves(facts)) replay_update(replay);
    mix_primitives(replay->used, facts->n_cell, facts->n_cell, replay->u, replay->w);
    blame_result(replay->again, replay->used, replay->u, replay->w);
    ret_outcome->faces = replay_differences(replay, BLAME_FACES);
    size_t u = replay_differences(replay, BLAME_U), w = replay_differences(replay, BLAME_W_NEW);
    ret_outcome->cells = u > w ? u : w;
    replay_judge(replay, ret_outcome);
    replay_free(replay);
}
