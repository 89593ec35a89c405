/* unmixed.c - see unmixed.h. */
#include "solve/unmixed.h"

#include "base/comm.h"
#include "phys/phase_pair.h"
#include "solve/wake.h"

/* Cells, leaves and those below them alike, that hold liquid, what it evaporates into, and both. */
enum { UNMIXED_LIQUID, UNMIXED_THIN, UNMIXED_BOTH, UNMIXED_COUNTS };

static void unmixed_count_tile(const struct state *state, const struct scene_phase *pair, const double *u,
                               long long count[UNMIXED_COUNTS])
{
    size_t n = state->mesh->n_cell;
    const double *alpha = u + state->model->i_alpha * n;
    for (size_t c = 0; c < n; c++) {
        double thin = alpha[pair->vapour * n + c];
        for (unsigned g = 0; g < pair->n_gas; g++) thin += alpha[pair->gas[g] * n + c];
        bool wet = alpha[pair->liquid * n + c] > PHASE_PAIR_FELT, dry = thin > PHASE_PAIR_FELT;
        count[UNMIXED_LIQUID] += wet;
        count[UNMIXED_THIN] += dry;
        count[UNMIXED_BOTH] += wet && dry;
    }
}

static void unmixed_count(const struct state *state, const struct scene_phase *pair, long long count[UNMIXED_COUNTS])
{
    wake_levels(state, 0);
    for (int l = 0; l < state->mesh->n_level; l++) {
        const struct level *level = &state->mesh->levels[l];
        for (unsigned t = 0; t < level->n_local; t++) unmixed_count_tile(state, pair, level->u_old[t], count);
    }
    comm_sum_counts(count, UNMIXED_COUNTS);
}

bool unmixed_is(const struct state *state, unsigned k)
{
    const struct scene_phase *pair = &state->scene->phases[k];
    long long count[UNMIXED_COUNTS] = {0};
    if (pair->everywhere || pair->rate == SCENE_PHASE_NONE) return false;
    unmixed_count(state, pair, count);
    return count[UNMIXED_LIQUID] && count[UNMIXED_THIN] && !count[UNMIXED_BOTH];
}
