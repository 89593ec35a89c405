/* beyond.c - see beyond.h. */
#include "solve/beyond.h"

#include "base/comm.h"
#include "base/mem.h"
#include "phys/outside.h"
#include "phys/phase_pair.h"

/* Cells of now: of each material, then of each pair. */
enum { BEYOND_ROOM = SCENE_MATERIALS + SCENE_PHASES };

static void beyond_tile(const struct state *state, const struct level *level, unsigned local, double *leaf,
                        long long *count)
{
    const struct model *model = state->model;
    const struct mesh *mesh = state->mesh;
    const struct tile *tile = &level->tiles[level->first + local];
    const double *w = level->w[local], *weight = tile->covered ? leaf : NULL;
    size_t n = mesh->n_cell;
    if (tile->hidden) return;
    if (tile->covered) mesh_leaves(mesh, tile, leaf);
    for (unsigned l = 0; l < model->n_material; l++) count[l] += (long long)outside_count(model, l, n, n, w, weight);
    for (unsigned k = 0; k < model->n_phase; k++)
        count[SCENE_MATERIALS + k] += (long long)phase_pair_past(model, k, n, n, w, weight);
}

static bool beyond_asks(const struct model *model)
{
    bool asks = model->n_phase > 0;
    for (unsigned l = 0; l < model->n_material; l++) asks = asks || outside_is_told(model, l);
    return asks;
}

static void beyond_add(unsigned n, const long long *now, long long *sum, long long *most)
{
    for (unsigned i = 0; i < n; i++) {
        sum[i] += now[i];
        if (now[i] > most[i]) most[i] = now[i];
    }
}

void beyond_count(struct state *state)
{
    const struct model *model = state->model;
    struct state_counts *counts = &state->counts;
    long long now[BEYOND_ROOM] = {0};
    if (!beyond_asks(model)) return;
    double *leaf = mem_new(state->mesh->n_cell, sizeof *leaf);
    for (int k = 0; k < state->mesh->n_level; k++) {
        const struct level *level = &state->mesh->levels[k];
        for (unsigned local = 0; local < level->n_local; local++) beyond_tile(state, level, local, leaf, now);
    }
    mem_free(leaf);
    comm_sum_counts(now, BEYOND_ROOM);
    beyond_add(model->n_material, now, counts->outside, counts->outside_most);
    beyond_add(model->n_phase, now + SCENE_MATERIALS, counts->past, counts->past_most);
}
