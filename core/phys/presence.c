/* presence.c - see presence.h. */
#include "phys/presence.h"

#include "base/mem.h"
#include "mesh/tally.h"

#define PRESENCE_DENSITY 1e-3 /* of the mean: a bubble that fills itself evenly is felt however far it grows */

enum { PRESENCE_MASS, PRESENCE_VOLUME, PRESENCE_SUMS };

double presence_density(const struct model *model, const struct mesh *mesh, unsigned l)
{
    if (!model->n_alpha) return 0.0;
    double *sums = mem_new((tally_tiles(mesh) + 1) * PRESENCE_SUMS, sizeof *sums), *at = sums, totals[PRESENCE_SUMS];
    double *volume = mem_new(mesh->n_cell, sizeof *volume);
    for (int k = 0; k < mesh->n_level; k++) {
        const struct level *level = &mesh->levels[k];
        for (unsigned i = 0; i < level->n_local; i++, at += PRESENCE_SUMS) {
            if (tally_is_covered(mesh, &level->tiles[level->first + i])) continue; /* its sums stay 0 */
            const double *alpha = level->w[i] + (model->i_alpha + l) * mesh->n_cell;
            const double *rho = level->w[i] + (model->i_m + l) * mesh->n_cell;
            tally_volumes(mesh, level, &level->tiles[level->first + i], volume);
            at[PRESENCE_VOLUME] = tally_row(mesh->n_cell, alpha, volume);
            for (size_t c = 0; c < mesh->n_cell; c++) volume[c] *= alpha[c];
            at[PRESENCE_MASS] = tally_row(mesh->n_cell, rho, volume);
        }
    }
    tally_add(mesh, PRESENCE_SUMS, sums, totals);
    mem_free(volume);
    mem_free(sums);
    return totals[PRESENCE_VOLUME] > 0.0 ? PRESENCE_DENSITY * totals[PRESENCE_MASS] / totals[PRESENCE_VOLUME] : 0.0;
}
