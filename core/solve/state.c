/* state.c - from a scene to a state in memory, see state.h. */
#include "solve/state.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "mesh/nest.h"
#include "mesh/partition.h"
#include "paint/paint.h"
#include "phys/mix.h"
#include "solve/regrid.h"
#include "solve/adopt.h"
#include "solve/normals.h"
#include "solve/peak.h"
#include "solve/stage.h"
#include "solve/unmixed.h"
#include "solve/verdict.h"

#include <string.h>

static int state_paint(struct state *state)
{
    const struct mesh *mesh = state->mesh;
    const struct level *level = &mesh->levels[0];
    int status = STATUS_OK;
    for (unsigned t = 0; t < level->n_local && !status; t++)
        status = paint_tile(state->model, mesh, level, &level->tiles[level->first + t], level->u_old[t]);
    return comm_agree(status);
}

/* A level that was just given its tiles: they are all new here. */
static int state_enter(struct state *state, int l)
{
    const struct level *level = &state->mesh->levels[l];
    int *from = mem_new(level->n_local + 1, sizeof *from);
    bool *born = mem_new(level->n_known + 1, sizeof *born);
    for (unsigned t = 0; t < level->n_local; t++) from[t] = -1;
    if (!state->stages[l]) state->stages[l] = stage_new(state->model, state->mesh, l, state->work);
    adopt_level(state->stages[l], from, born);
    mem_free(from);
    mem_free(born);
    return comm_agree(state->stages[l]->bound->status);
}

/* What every state needs before its levels have data. */
static struct state *state_blank(const struct scene *scene)
{
    struct state *state = mem_new(1, sizeof *state);
    state->scene = scene;
    state->dt_shrink = scene->scheme.first_step;
    state->whole = true;
    state->model = model_new(scene);
    state->tagged = mem_new(scene->mesh.n_refine + 1, sizeof *state->tagged);
    return state;
}

static int state_build(struct state *state)
{
    TRY(mesh_new(state->scene, state->model->n_field, state->model->n_alpha, &state->mesh));
    state->work = work_new(state->model, state->mesh);
    return STATUS_OK;
}

static int state_begin(struct state *state)
{
    TRY(state_build(state));
    TRY(state_paint(state));
    TRY(state_enter(state, 0));
    curve_take(state->work->curve, 0, state->mesh->levels[0].u_old);
    TRY(comm_agree(verdict_start(state->stages[0], normals_count(state))));
    TRY(regrid_initial(state));
    regrid_signals(state);
    for (int l = 0; l < state->mesh->n_level; l++) peak_take(state, l, state->t);
    return STATUS_OK;
}

/* The state, or nothing if it could not be made. */
static int state_hand_over(struct state *state, int status, struct state **ret_state)
{
    if (status) state_free(state);
    else *ret_state = state;
    return status;
}

/* Does some surface lie on faces of cells, to which heat or vapour is carried? */
static bool state_touches(const struct state *state)
{
    bool carries = state->model->conducts || state->model->n_fick > 0, touches = false;
    for (unsigned k = 0; carries && k < state->scene->n_phase; k++) touches = unmixed_is(state, k) || touches;
    return touches;
}

int state_new(const struct scene *scene, struct state **ret_state)
{
    struct state *state = state_blank(scene);
    int status = state_begin(state);
    if (!status && state_touches(state)) {
        state_free(state);
        state = state_blank(scene);
        state->model->reaches = true;
        status = state_begin(state);
    }
    return state_hand_over(state, status, ret_state);
}

/* This rank's piece of a level. */
static struct mesh_set state_piece(const struct state_source *source, int l)
{
    size_t size = (size_t)comm_size();
    struct mesh_set set = {.n_tile = source->n_tile[l], .n = source->n_own[l]};
    set.tiles = mem_new(set.n, sizeof *set.tiles);
    set.from = mem_new(set.n, sizeof *set.from);
    set.first_keys = mem_new(size, sizeof *set.first_keys);
    if (set.n) memcpy(set.tiles, source->tiles[l], set.n * sizeof *set.tiles);
    for (unsigned i = 0; i < set.n; i++) set.from[i] = -1;
    memcpy(set.first_keys, source->first_keys[l], size * sizeof *set.first_keys);
    return set;
}

/* One level of a source: tiles in equal pieces (costs are not known yet), then their data. */
static int state_load_level(struct state *state, const struct state_source *source, int l)
{
    struct mesh *mesh = state->mesh;
    struct mesh_set sets[MESH_LEVELS];
    struct mesh_change changes[MESH_LEVELS];
    size_t n_cell = mesh->n_cell;
    unsigned first = source->first[l];
    sets[l] = state_piece(source, l);
    mesh_replace(mesh, l, l, sets, changes);
    mesh_change_free(&changes[l]);
    const struct level *level = &mesh->levels[l];
    double *p = mem_new(n_cell, sizeof *p);
    int status = STATUS_OK;
    for (unsigned t = 0; t < level->n_local && !status; t++) {
        status = source->fill(source->data, l, first + t, level->u_old[t], p, level->kept ? level->kept[t] : NULL);
        memcpy(level->w[t] + state->model->i_E * n_cell, p, n_cell * sizeof *p);
        mix_primitives(state->model, n_cell, n_cell, level->u_old[t], level->w[t]);
    }
    mem_free(p);
    return comm_agree(status);
}

static int state_load(struct state *state, const struct state_source *source)
{
    TRY(state_build(state));
    for (int l = 0; l < source->n_level; l++) TRY(state_load_level(state, source, l));
    for (int l = 0; l < source->n_level; l++) TRY(state_enter(state, l));
    TRY(nest_check(state->mesh));
    state->t = source->t;
    regrid_signals(state);
    state->dt = source->dt;
    state->dt_shrink = source->dt_shrink;
    state->dt_longest = source->dt_longest;
    state->step = source->step;
    memcpy(state->level_steps, source->level_steps, sizeof state->level_steps);
    return STATUS_OK;
}

int state_resume(const struct scene *scene, const struct state_source *source, struct state **ret_state)
{
    struct state *state = state_blank(scene);
    return state_hand_over(state, state_load(state, source), ret_state);
}

void state_free(struct state *state)
{
    if (!state) return;
    for (int l = 0; l < MESH_LEVELS; l++) stage_free(state->stages[l]);
    work_free(state->work);
    mesh_free(state->mesh);
    model_free(state->model);
    mem_free(state->tagged);
    mem_free(state);
}

struct state_counts state_counts_total(const struct state *state)
{
    struct state_counts total = state->counts;
    struct mix_effort *closures = &total.closures;
    long long *sums[] = {&total.cells,  &total.carried, &total.fallback,   &total.relaxed,   &total.clipped,
                         &total.spread, &total.limited, &closures->solved, &closures->steps, &closures->failed};
    double most = (double)closures->most;
    long long values[sizeof sums / sizeof *sums];
    for (size_t i = 0; i < sizeof sums / sizeof *sums; i++) values[i] = *sums[i];
    comm_sum_counts(values, (int)(sizeof sums / sizeof *sums));
    for (size_t i = 0; i < sizeof sums / sizeof *sums; i++) *sums[i] = values[i];
    comm_max(&most, 1);
    closures->most = (long long)most;
    return total;
}
