/* levels_io.h - states of several levels for tests: refined by hand, painted on all levels, with the averages of
 * finer cells under them. */
#ifndef LEVELS_IO_H
#define LEVELS_IO_H

#include "mesh/metric.h"
#include "mesh/morton.h"
#include "mesh/nest.h"
#include "paint/paint.h"
#include "phys/mix.h"
#include "replicated.h"
#include "small.h"

static inline int levels_compare(const void *a, const void *b)
{
    uint64_t ka = ((const struct tile *)a)->key, kb = ((const struct tile *)b)->key;
    return (ka > kb) - (ka < kb);
}

/* Tiles of the next level under the octants of level l whose centre is wanted. */
static inline unsigned levels_choose(const struct mesh *mesh, int l, bool (*wanted)(const double *centre),
                                     struct tile *tiles)
{
    const struct level *level = &mesh->levels[l];
    unsigned count = 0;
    for (unsigned t = 0; t < level->n_tile; t++)
        for (int o = 0; o < 1 << mesh->dim; o++) {
            struct tile *tile = &tiles[count];
            double centre[3] = {0};
            *tile = (struct tile){.rank = level->tiles[t].rank};
            for (int d = 0; d < mesh->dim; d++) {
                tile->at[d] = 2 * level->tiles[t].at[d] + (o >> d & 1);
                centre[d] = mesh->lower[d] + 0.5 * (tile->at[d] + 0.5) * mesh->n[d] * level->h[d];
            }
            tile->key = morton_key(tile->at);
            count += wanted(centre);
        }
    qsort(tiles, count, sizeof *tiles, levels_compare);
    return count;
}

/* The cell of the coarser level above a cell of a tile; its tile is returned. */
static inline unsigned levels_above(const struct mesh *mesh, int l, unsigned tile, size_t cell, size_t *ret_cell)
{
    const int *at = mesh->levels[l].tiles[tile].at, *n = mesh->n;
    size_t n0 = (size_t)n[0], n1 = (size_t)n[1];
    int in[3] = {(int)(cell % n0), (int)(cell / n0 % n1), (int)(cell / (n0 * n1))}, up[3] = {0};
    for (int d = 0; d < mesh->dim; d++) {
        int coarse = (at[d] * n[d] + in[d]) / 2;
        up[d] = coarse / n[d];
        in[d] = coarse % n[d];
    }
    *ret_cell = (size_t)(in[0] + n[0] * (in[1] + n[1] * in[2]));
    return (unsigned)mesh_find(mesh, &mesh->levels[l - 1], up);
}

/* Averages of all levels, finest first, into the conserved fields above them; then primitives everywhere. */
static inline void levels_average(struct state *state)
{
    struct mesh *mesh = state->mesh;
    size_t n = mesh->n_cell;
    double *fine = mem_new(n, sizeof *fine), *coarse = mem_new(n, sizeof *coarse);
    for (int l = mesh->n_level - 1; l > 0; l--) {
        struct level *level = &mesh->levels[l], *below = level - 1;
        for (unsigned t = 0; t < level->n_tile; t++) {
            metric_volumes(mesh, level, &level->tiles[t], fine);
            for (int pass = 0; pass < 2; pass++)
                for (size_t i = 0; i < n; i++) {
                    size_t c;
                    unsigned tile = levels_above(mesh, l, t, i, &c);
                    metric_volumes(mesh, below, &below->tiles[tile], coarse);
                    for (unsigned q = 0; q < mesh->n_field; q++) {
                        double *to = &below->u_old[tile][q * n + c];
                        *to = pass ? *to + level->u_old[t][q * n + i] * fine[i] / coarse[c] : 0.0;
                    }
                }
        }
    }
    for (int l = 0; l < mesh->n_level; l++)
        for (unsigned t = 0; t < mesh->levels[l].n_tile; t++)
            mix_primitives(state->model, n, n, mesh->levels[l].u_old[t], mesh->levels[l].w[t]);
    mem_free(coarse);
    mem_free(fine);
}

/* Refines the finest level where `wanted` says so, which must nest, and paints the new one. For one rank. */
static inline void levels_add(struct state *state, bool (*wanted)(const double *centre))
{
    struct mesh *mesh = state->mesh;
    int l = mesh->n_level;
    struct tile *tiles = mem_new(((size_t)mesh->levels[l - 1].n_tile << mesh->dim) + 1, sizeof *tiles);
    struct mesh_change change;
    unsigned n = levels_choose(mesh, l - 1, wanted, tiles);
    replicated_replace(mesh, l, tiles, n, &change);
    mesh_change_free(&change);
    struct level *level = &mesh->levels[l];
    for (unsigned t = 0; t < level->n_tile; t++)
        assert_int_equal(paint_tile(state->model, mesh, level, &level->tiles[t], level->u_old[t]), 0);
    levels_average(state);
    if (nest_check(mesh)) fail_msg("%s", status_text());
}

/* Gives all cells under finer ones wrong values: densities, momenta, energies and pressures a thousand times too
 * large, and fractions turned around. */
static inline void levels_spoil(struct state *state)
{
    struct mesh *mesh = state->mesh;
    const struct model *model = state->model;
    size_t n = mesh->n_cell;
    double *leaf = mem_new(n, sizeof *leaf);
    for (int l = 0; l < mesh->n_level; l++)
        for (unsigned t = 0; t < mesh->levels[l].n_tile; t++) {
            double *blocks[2] = {mesh->levels[l].u_old[t], mesh->levels[l].w[t]};
            mesh_leaves(mesh, &mesh->levels[l].tiles[t], leaf);
            for (int k = 0; k < 2; k++)
                for (size_t q = 0; q < mesh->n_field; q++)
                    for (size_t i = 0; i < n; i++) {
                        double *value = &blocks[k][q * n + i];
                        if (leaf[i] == 0.0) *value = q < model->n_alpha ? 1.0 - *value : 1000.0 * (*value + 1.0);
                    }
        }
    mem_free(leaf);
}

#endif
