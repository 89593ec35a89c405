/* evaporate.c - see evaporate.h. */
#include "solve/evaporate.h"

#include "base/comm.h"
#include "base/mem.h"
#include "mesh/rigid.h"
#include "mesh/tally.h"

#include <string.h>

/* Rows of masses that a tile had before its operators, then one for volumes. */
enum { EVAPORATE_ROWS = SCENE_PHASES + 1 };

static bool evaporate_wanted(const struct scene *scene)
{
    bool wanted = false;
    for (unsigned i = 0; i < scene->output.n_column; i++)
        wanted = wanted || scene->output.columns[i].measure == SCENE_EVAPORATED;
    return wanted;
}

void evaporate_renew(struct stage *stage)
{
    mem_free(stage->evaporated);
    stage->evaporated = NULL;
    if (!evaporate_wanted(stage->model->scene)) return;
    size_t rows = EVAPORATE_ROWS * stage->mesh->n_cell, tiles = (size_t)stage->level->n_local * SCENE_PHASES;
    stage->evaporated = mem_new(rows + tiles, sizeof *stage->evaporated);
}

/* What the tiles have made, [n_local][SCENE_PHASES]. */
static double *evaporate_made(const struct stage *stage)
{
    return stage->evaporated + EVAPORATE_ROWS * stage->mesh->n_cell;
}

void evaporate_forget(struct stage *stage)
{
    if (!stage->evaporated) return;
    memset(evaporate_made(stage), 0, (size_t)stage->level->n_local * SCENE_PHASES * sizeof *stage->evaporated);
}

/* What a change after stage `turn` counts for at the end of the step. */
static double evaporate_weight(const struct tableau *tableau, int turn)
{
    double weight = 1.0;
    for (int s = turn + 1; s < tableau->n; s++) weight *= tableau->stage[s].previous ? tableau->stage[s].mix : 0.0;
    return weight;
}

static const double *evaporate_row(const struct stage *stage, unsigned pair, const double *u)
{
    return u + (stage->model->i_m + stage->model->phases[pair].scene->vapour) * stage->mesh->n_cell;
}

/* Does a tile of this path change phase, in a stage that leaves something? */
static bool evaporate_counts(const struct stage *stage, unsigned local)
{
    return stage->evaporated && stage->census.tiles[local].path->n_phase > 0 &&
           evaporate_weight(stage->tableau, stage->turn) > 0.0;
}

void evaporate_before(const struct stage *stage, unsigned local, const double *u)
{
    size_t n = stage->mesh->n_cell;
    if (!evaporate_counts(stage, local)) return;
    for (unsigned k = 0; k < stage->model->n_phase; k++)
        memcpy(stage->evaporated + k * n, evaporate_row(stage, k, u), n * sizeof *u);
}

void evaporate_after(struct stage *stage, unsigned local, double t, const double *u)
{
    size_t n = stage->mesh->n_cell;
    const struct tile *tile = stage_tile(stage, local);
    double *volume = stage->evaporated + SCENE_PHASES * n, weight = evaporate_weight(stage->tableau, stage->turn);
    if (!evaporate_counts(stage, local) || tally_is_covered(stage->mesh, tile)) return;
    tally_volumes(stage->mesh, stage->level, tile, volume);
    rigid_weigh(stage->mesh, stage->level, tile, t, volume);
    for (unsigned k = 0; k < stage->model->n_phase; k++) {
        double *change = stage->evaporated + k * n;
        const double *after = evaporate_row(stage, k, u);
        for (size_t i = 0; i < n; i++) change[i] = after[i] - change[i];
        evaporate_made(stage)[local * SCENE_PHASES + k] += weight * tally_row(n, change, volume);
    }
}

void evaporate_accept(struct state *state, const struct stage *stage)
{
    if (!stage->evaporated) return;
    const double *made = evaporate_made(stage);
    for (unsigned local = 0; local < stage->level->n_local; local++)
        for (unsigned k = 0; k < stage->model->n_phase; k++)
            account_add(&state->evaporated[k], made[local * SCENE_PHASES + k]);
}

struct account evaporate_account(const struct state *state, unsigned pair)
{
    struct account all = state->evaporated[pair];
    account_carry(&all);
    comm_sum_counts((long long *)&all, ACCOUNT_NUMBERS);
    account_carry(&all);
    return all;
}

double evaporate_total(const struct state *state, unsigned vapour)
{
    const struct scene_phase *pair = scene_phase_of(state->scene, vapour);
    struct account all = evaporate_account(state, (unsigned)(pair - state->scene->phases));
    return account_value(&all);
}
