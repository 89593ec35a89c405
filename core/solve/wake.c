/* wake.c - see wake.h. */
#include "solve/wake.h"

#include "levels/restrict.h"
#include "phys/elastic.h"
#include "solve/stage.h"
#include "solve/verdict.h"

#include <string.h>

static void wake_tile(struct stage *stage, unsigned local)
{
    const struct level *level = stage->level;
    size_t n_cell = stage->mesh->n_cell, block = stage->model->n_field * n_cell;
    double *u = level->u_old[local];
    elastic_settle(stage->model, n_cell, n_cell, u);
    memcpy(level->u_new[local], u, block * sizeof *u); /* an earlier state, for verdict_touch */
    verdict_forget(stage, local);
    census_forget(&stage->census, local);
    guard_attempt(stage->guard);
    verdict_touch(stage, local);
}

/* Those of a level that sleep at least so deep, at most so deep. */
static void wake_level(struct stage *stage, int least, int most)
{
    struct level *level = stage->level;
    struct mix_effort effort = stage->effort; /* of steps, which this is no part of */
    for (int depth = least; depth <= most; depth++) restrict_late(stage->mesh, stage->l + 1, depth);
    for (unsigned local = 0; local < level->n_local; local++) {
        int depth = stage_tile(stage, local)->sleeps;
        if (depth >= least && depth <= most) wake_tile(stage, local);
    }
    guard_attempt(stage->guard);
    stage->effort = effort;
}

void wake_leave(struct stage *stage)
{
    stage->level->stale = stage->l + 1 < stage->mesh->n_level; /* on the finest level none sleeps */
}

void wake_above(struct stage *const *stages, int l)
{
    for (int k = stages[l]->mesh->n_level - 2; k > l; k--) wake_level(stages[k], k - l, k - l);
}

void wake_levels(const struct state *state, int base)
{
    for (int l = state->mesh->n_level - 2; l >= base; l--) {
        if (!state->stages[l]->level->stale) continue;
        wake_level(state->stages[l], l - base + 1, l + 1);
        state->stages[l]->level->stale = false;
    }
}
