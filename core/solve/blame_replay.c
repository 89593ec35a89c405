/* blame_replay.c - see blame_replay.h. The mesh is a single tile, made by hand: nothing asks for its neighbours,
 * because the frames are given. */
#include "solve/blame_replay.h"

#include "base/mem.h"
#include "mesh/rigid.h"
#include "phys/mix.h"
#include "scheme/operators.h"
#include "scheme/rate.h"
#include "scheme/shore.h"
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
    struct terms *terms;
    void *own[TERMS_MOST];
    const struct tableau *tableau;
    double *rates, *K, *rho_c2, *c2, *u, *w, *grown;
    unsigned char *shore; /* where liquids end, as scheme/shore.h marks it; or NULL */
    double *room;         /* for that */
};

static void blame_replay_mesh(struct replay *replay)
{
    const struct blame_facts *facts = &replay->blame->facts;
    const struct scene *scene = replay->model->scene;
    struct mesh *mesh = &replay->mesh;
    *mesh = (struct mesh){.dim = scene->domain.dim,
                          .beta = (int)scene->domain.geometry,
                          .n_cell = facts->n_cell,
                          .n_field = replay->model->n_field,
                          .n_alpha = replay->model->n_alpha,
                          .ghosts = scene->scheme.ghosts,
                          .n_level = facts->level + 1};
    replay->tile = (struct tile){.covered = (unsigned char)facts->covered};
    replay->level = &mesh->levels[facts->level];
    *replay->level = (struct level){.n_tile = 1, .n_local = 1, .tiles = &replay->tile};
    for (int d = 0; d < 3; d++) {
        mesh->n[d] = facts->n[d];
        mesh->lower[d] = d < scene->domain.dim ? scene->domain.lower[d] : 0.0;
        mesh->upper[d] = d < scene->domain.dim ? scene->domain.upper[d] : 1.0;
        replay->tile.at[d] = facts->tile[d];
        replay->level->h[d] = facts->h[d];
        replay->level->extent[d] = facts->extent[d];
        mesh->periodic[d] = d < scene->domain.dim && scene_boundary_is(scene, 2 * d, SCENE_BOUNDARY_WRAPS);
    }
    mesh->rigid = rigid_new(scene);
}

static struct replay *blame_replay_new(const struct model *model, const struct blame *blame)
{
    struct replay *replay = mem_new(1, sizeof *replay);
    size_t n_cell = blame->facts.n_cell;
    replay->model = model;
    replay->used = model_numbered(model, blame->facts.pure);
    replay->blame = blame;
    blame_replay_mesh(replay);
    replay->again = blame_like(model, &blame->facts);
    replay->faces = face_new(replay->used);
    replay->terms = terms_new(replay->used, replay->faces);
    terms_open(&(struct term_room){.model = model, .mesh = &replay->mesh}, replay->own);
    replay->tableau = tableau_numbered(blame->facts.integrator);
    replay->rates = mem_new(replay->terms->n_rates * n_cell, sizeof(double));
    replay->K = mem_new(model->n_material * n_cell, sizeof(double));
    replay->rho_c2 = mem_new(model->n_material * n_cell, sizeof(double));
    replay->c2 = mem_new(n_cell, sizeof(double));
    replay->u = mem_new(model->n_field * n_cell, sizeof(double));
    replay->w = mem_new(model->n_field * n_cell, sizeof(double));
    size_t marks = replay->used->fronts ? shore_marks(model, &replay->mesh) : 0;
    if (marks) replay->shore = mem_new(marks, sizeof *replay->shore);
    if (marks) replay->room = mem_new(shore_room(model, &replay->mesh), sizeof *replay->room);
    if (model->plastic && model->damaged) replay->grown = mem_new(model->n_solid * n_cell, sizeof(double));
    return replay;
}

static void blame_replay_free(struct replay *replay)
{
    double *blocks[] = {replay->rates, replay->K, replay->rho_c2, replay->c2,
                        replay->u,     replay->w, replay->grown,  replay->room};
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) mem_free(blocks[i]);
    mem_free(replay->shore);
    terms_free(replay->terms);
    terms_close(replay->own);
    rigid_free(replay->mesh.rigid);
    face_free(replay->faces);
    blame_free(replay->again);
    mem_free(replay);
}

/* A piece of the dump, and of what is recorded again. */
static void blame_replay_gather(void *data, const struct frame *frame, struct face_work *faces)
{
    const struct replay *replay = data;
    blame_give(replay->blame, replay->used, frame, faces);
    blame_frame(replay->again, replay->used, frame, faces);
}

static void blame_replay_seen(void *data, const struct frame *frame, struct face_work *faces)
{
    const struct replay *replay = data;
    (void)faces;
    blame_faces(replay->again, replay->terms, frame);
}

/* From the frames to the new conserved fields. */
static void blame_replay_update(struct replay *replay)
{
    const struct blame *blame = replay->blame;
    const struct blame_facts *facts = &blame->facts;
    const struct tableau_stage *row = &replay->tableau->stage[facts->stage];
    const double *u_old = blame->block[BLAME_U_OLD];
    struct metric metric;
    struct term_tile tile = {.terms = replay->terms,
                             .model = replay->used,
                             .mesh = &replay->mesh,
                             .level = replay->level,
                             .tile = &replay->tile,
                             .metric = &metric,
                             .n_cell = facts->n_cell,
                             .t = facts->t + row->at * facts->dt,
                             .dt = row->step * facts->dt,
                             .begun = facts->t + (row->previous ? row->at : 0.0) * facts->dt,
                             .u = row->previous ? blame->block[BLAME_BASE] : u_old,
                             .w = blame->block[BLAME_W],
                             .rates = replay->rates,
                             .around = blame->block[BLAME_AROUND],
                             .K = replay->K,
                             .rho_c2 = replay->rho_c2};
    const struct rate_watch watch = {replay, blame_replay_gather, blame_replay_seen, NULL};
    if (replay->mesh.beta) metric_of_tile(&replay->mesh, replay->level, &replay->tile, &metric);
    rate_take(&tile, replay->own, &watch, facts->masked);
    if (replay->shore) shore_look(replay->used, &replay->mesh, tile.around, replay->room, replay->shore);
    rate_apply(&tile, replay->own, replay->u);
    rate_mix(&tile, u_old, row->mix, replay->u);
}

/* What acts on them before they are judged. */
static void blame_replay_operate(struct replay *replay)
{
    const struct blame_facts *facts = &replay->blame->facts;
    double dt = tableau_reach(replay->tableau, facts->stage) * facts->dt;
    struct operators operators;
    const struct operator_tile tile = {.model = replay->used,
                                       .mesh = &replay->mesh,
                                       .level = replay->level,
                                       .tile = &replay->tile,
                                       .n_cell = facts->n_cell,
                                       .t = facts->t + dt,
                                       .dt = dt,
                                       .u = replay->u,
                                       .w = replay->w,
                                       .before = replay->rates,
                                       .shore = replay->shore,
                                       .grown = replay->grown};
    operators_of(replay->used, &operators);
    operators_act(&operators, facts->stage + 1 == replay->tableau->n, &tile);
}

/* The guard's opinion of the new state, which it may change. */
static void blame_replay_judge(struct replay *replay, struct blame_outcome *outcome)
{
    const struct blame_facts *facts = &replay->blame->facts;
    struct guard guard = {.model = replay->model,
                          .mesh = &replay->mesh,
                          .level = replay->level,
                          .l = facts->level,
                          .n_local = 1,
                          .repair = facts->repair,
                          .debt = GUARD_ROUND_OFF,
                          .last = true};
    struct guard_tile tile = {.model = replay->used,
                              .stage = blame_moves(facts) ? facts->stage : replay->tableau->n - 1,
                              .u_old = replay->blame->block[BLAME_U_OLD],
                              .p_before = replay->rates,
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
static size_t blame_replay_differences(const struct replay *replay, enum blame_block block)
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
    struct replay *replay = blame_replay_new(model, blame);
    const struct blame_facts *facts = &blame->facts;
    size_t bytes = model->n_field * facts->n_cell * sizeof(double);
    memcpy(replay->u, blame->block[blame_moves(facts) ? BLAME_U_OLD : BLAME_U], bytes);
    memcpy(replay->w, blame->block[BLAME_W], bytes); /* where an iteration starts */
    if (blame_moves(facts)) blame_replay_update(replay);
    const double *p_before = replay->w + replay->used->i_E * facts->n_cell;
    memcpy(replay->rates, p_before, facts->n_cell * sizeof *replay->rates); /* as verdict_hold: before operators */
    if (blame_moves(facts)) blame_replay_operate(replay);
    mix_primitives(replay->used, facts->n_cell, facts->n_cell, replay->u, replay->w);
    blame_result(replay->again, replay->used, replay->u, replay->w);
    ret_outcome->faces = blame_replay_differences(replay, BLAME_FACES);
    size_t u = blame_replay_differences(replay, BLAME_U), w = blame_replay_differences(replay, BLAME_W_NEW);
    ret_outcome->cells = u > w ? u : w;
    blame_replay_judge(replay, ret_outcome);
    blame_replay_free(replay);
}
