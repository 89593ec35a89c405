/* ledger.c - see ledger.h. The evolved fields m_l, rho u_i, rho E lie one after the other in the
 * state (model.h), so the ledger is one sum for each of them. */
#include "io/ledger.h"

#include "base/mem.h"
#include "mesh/rigid.h"
#include "mesh/tally.h"

#include <stdio.h>

void ledger_take(const struct state *state, struct ledger *ret_ledger)
{
    const struct mesh *mesh = state->mesh;
    const struct model *model = state->model;
    unsigned n = model->i_E + 1 - model->i_m;
    double *sums = mem_new((tally_tiles(mesh) + 1) * n, sizeof *sums), *at = sums;
    double *volume = mem_new(mesh->n_cell, sizeof *volume);
    for (int l = 0; l < mesh->n_level; l++) {
        const struct level *level = &mesh->levels[l];
        for (unsigned tile = 0; tile < level->n_local; tile++, at += n) {
            const struct tile *here = &level->tiles[level->first + tile];
            if (tally_is_covered(mesh, here)) continue; /* its sums stay 0 */
            tally_volumes(mesh, level, here, volume);
            rigid_weigh(mesh, level, here, state->t, volume);
            for (unsigned q = 0; q < n; q++)
                at[q] = tally_row(mesh->n_cell, level->u_old[tile] + (model->i_m + q) * mesh->n_cell, volume);
        }
    }
    ret_ledger->n = n;
    tally_add(mesh, n, sums, ret_ledger->total);
    mem_free(volume);
    mem_free(sums);
}

void ledger_name(const struct model *model, unsigned index, char *ret_name, size_t size)
{
    unsigned l = index, axis = index - model->n_material;
    if (l < model->n_material) snprintf(ret_name, size, "mass_%s", model->scene->material[l].name);
    else if (axis < model->n_velocity) snprintf(ret_name, size, "momentum_%c", "xyz"[axis]);
    else snprintf(ret_name, size, "energy");
}
