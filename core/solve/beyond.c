/* beyond.c - see beyond.h. */
#include "solve/beyond.h"

#include "base/comm.h"
#include "base/mem.h"
#include "phys/outside.h"

static void beyond_tile(const struct state *state, const struct level *level, unsigned local, double *leaf,
                        long long *count)
{
    const struct model *model = state->model;
    const struct mesh *mesh = state->mesh;
    const struct tile *tile = &level->tiles[level->first + local];
    if (tile->hidden) return;
    if (tile->covered) mesh_leaves(mesh, tile, leaf);
    for (unsigned l = 0; l < model->n_material; l++)
        count[l] += (long long)outside_count(model, l, mesh->n_cell, mesh->n_cell, level->w[local],
                                             tile->covered ? leaf : NULL);
}

void beyond_count(struct state *state)
{
    const struct model *model = state->model;
    long long now[SCENE_MATERIALS] = {0};
    bool told = false;
    for (unsigned l = 0; l < model->n_material; l++) told = told || outside_is_told(model, l);
    if (!told) return;
    double *leaf = mem_new(state->mesh->n_cell, sizeof *leaf);
    for (int k = 0; k < state->mesh->n_level; k++) {
        const struct level *level = &state->mesh->levels[k];
        for (unsigned local = 0; local < level->n_local; local++) beyond_tile(state, level, local, leaf, now);
    }
    mem_free(leaf);
    comm_sum_counts(now, (int)model->n_material);
    for (unsigned l = 0; l < model->n_material; l++) {
        state->counts.outside[l] += now[l];
        if (now[l] > state->counts.outside_most[l]) state->counts.outside_most[l] = now[l];
    }
}
