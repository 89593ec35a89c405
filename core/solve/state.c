/* state.c - from a scene to a state in memory, see state.h. */
#include "solve/state.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "phys/paint.h"
#include "solve/stage.h"

static int state_paint(struct state *state)
{
    const struct mesh *mesh = state->mesh;
    const struct level *level = &mesh->levels[0];
    int status = STATUS_OK;
    for (unsigned t = 0; t < level->n_local && !status; t++)
        status = paint_tile(state->model, mesh, level, &level->tiles[level->first + t], level->u_old[t]);
    return comm_agree(status);
}

/* Primitives, boundary references and the first signal speed. */
static int state_begin(struct state *state)
{
    struct stage *stage = state->stage;
    guard_attempt(stage->guard);
    stage_reset(stage);
    mesh_swap(stage->level); /* the painted state closes like that of a step */
    stage_close(stage);
    mesh_swap(stage->level);
    state->signal = stage->signal;
    comm_max(&state->signal, 1);
    guard_clear(stage->guard);
    int status = STATUS_OK;
    if (stage->guard->cause[0])
        status = status_fail(STATUS_CASE, "the initial state is not admissible: %s", stage->guard->cause);
    TRY(comm_agree(status));
    stage_bind(stage);
    return STATUS_OK;
}

int state_new(const struct scene *scene, struct state **ret_state)
{
    struct state *state = mem_new(1, sizeof *state);
    state->scene = scene;
    state->dt_shrink = 1.0;
    state->model = model_new(scene);
    int status = mesh_new(scene, state->model->n_field, state->model->n_alpha, &state->mesh);
    if (!status) {
        state->stage = stage_new(state->model, state->mesh, &state->mesh->levels[0]);
        status = state_paint(state);
    }
    if (!status) status = state_begin(state);
    if (status) {
        state_free(state);
        return status;
    }
    *ret_state = state;
    return STATUS_OK;
}

void state_free(struct state *state)
{
    if (!state) return;
    stage_free(state->stage);
    mesh_free(state->mesh);
    model_free(state->model);
    mem_free(state);
}

struct state_counts state_counts_total(const struct state *state)
{
    struct state_counts total = state->counts;
    long long *sums[] = {&total.cells,   &total.carried, &total.fallback, &total.relaxed,
                         &total.clipped, &total.limited, &total.spread};
    long long values[sizeof sums / sizeof *sums];
    for (size_t i = 0; i < sizeof sums / sizeof *sums; i++) values[i] = *sums[i];
    comm_sum_counts(values, (int)(sizeof sums / sizeof *sums));
    for (size_t i = 0; i < sizeof sums / sizeof *sums; i++) *sums[i] = values[i];
    return total;
}
