/* derive_curvature.c - see derive_curvature.h. */
#include "derive/derive_curvature.h"

#include "base/mem.h"
#include "levels/prolong_rim.h"
#include "scheme/curvature.h"
#include "scheme/patch_state.h"

#include <string.h>

/* One to average fractions, one for the normals. */
enum { CURVATURE_LAYERS = 2 };

/* Least fraction, of the material and of all others, that makes a surface. */
#define CURVATURE_LEAST 1e-2

/* The fractions, which are the first of the primitives. */
static struct patch_source derive_curvature_source(const struct model *model, const struct mesh *mesh,
                                                   const struct level *level)
{
    return patch_state_fractions(model, mesh, (int)(level - mesh->levels), CURVATURE_LAYERS, 1);
}

void derive_curvature_exchange(const struct model *model, const struct mesh *mesh)
{
    if (!model->n_alpha) return;
    for (int l = 0; l < mesh->n_level; l++) {
        const struct patch_source source = derive_curvature_source(model, mesh, &mesh->levels[l]);
        patch_start(&source);
        patch_finish(&source);
        if (l + 1 == mesh->n_level) break;
        struct rim *fine = derive_curvature_source(model, mesh, &mesh->levels[l + 1]).rim;
        prolong_rim(&source, fine, 0, NULL);
        rim_down(fine);
    }
}

/* kappa where psi is that of a surface; else 0. psi has one layer around the tile. */
static void derive_curvature_cells(const struct derive_view *tile, const double *psi, const double *kappa, double *out)
{
    const struct box_block cells = rim_block(tile->mesh, CURVATURE_LAYERS - 1, NULL);
    double low = curvature_psi_of(CURVATURE_LEAST), high = curvature_psi_of(1.0 - CURVATURE_LEAST);
    size_t n0 = (size_t)tile->mesh->n[0], n1 = (size_t)tile->mesh->n[1];
    for (size_t c = 0; c < tile->n; c++) {
        double here = psi[box_at(&cells, (int)(c % n0), (int)(c / n0 % n1), (int)(c / n0 / n1))];
        out[c] = here < low || here > high ? 0.0 : kappa[c];
    }
}

void derive_curvature(const struct derive_view *tile, double *out)
{
    memset(out, 0, tile->n * sizeof *out);
    if (!tile->model->n_alpha) return;
    const struct patch_source source = derive_curvature_source(tile->model, tile->mesh, tile->level);
    size_t cells = rim_block(tile->mesh, CURVATURE_LAYERS, NULL).pitch, all = tile->model->n_alpha * cells;
    double *alpha = mem_new(all + cells, sizeof *alpha), *rest = alpha + all;
    const double *a = alpha + (size_t)tile->field->index * cells;
    patch_gather(&source, tile->local, alpha);
    if (curvature_is_mixed(cells, a, CURVATURE_LEAST)) {
        struct curvature *room = curvature_new(tile->mesh, CURVATURE_LAYERS);
        for (size_t c = 0; c < cells; c++) rest[c] = 1.0 - a[c];
        const double *kappa =
            curvature_take(room, tile->level, &tile->level->tiles[tile->level->first + tile->local], a, rest, NULL);
        derive_curvature_cells(tile, curvature_psi(room), kappa, out);
        curvature_free(room);
    }
    mem_free(alpha);
}
