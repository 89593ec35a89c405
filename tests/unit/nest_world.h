/* nest_world.h - small meshes for unit/nest.c: tiles without blocks, owned in pieces that are drawn, the same on all
 * ranks. */
#ifndef NEST_WORLD_H
#define NEST_WORLD_H

#include "mesh/nest.h"

#include "base/comm.h"
#include "base/mem.h"
#include "mesh/morton.h"
#include "replicated.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

enum { MOST = 4, ROUNDS = 24 };

static uint64_t seed;

static unsigned pick(unsigned count)
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (unsigned)(seed >> 33) % count;
}

static bool at_home; /* rank 0 owns all tiles */

/* Random pieces, the same on all ranks: some may be empty. */
static void owners(struct tile *tiles, unsigned n)
{
    for (unsigned i = 0; i < n; i++) tiles[i].rank = 0;
    for (int rank = 1; n && !at_home && rank < comm_size(); rank++)
        for (unsigned i = pick(n + 1); i < n; i++) tiles[i].rank++;
}

/* What all ranks hold of joined keys. */
static void whole(struct nest_keys *keys)
{
    struct nest_keys all = {0};
    all.keys = comm_join_keys(keys->keys, keys->n, &all.n);
    nest_keys_free(keys);
    *keys = all;
}

/* A mesh of tiles without blocks. */
static void mesh_make(struct mesh *mesh, int dim, const int extent[3], int n, unsigned periodic, int most_level)
{
    *mesh = (struct mesh){.dim = dim, .n_cell = 1, .n_level = 1, .most_level = most_level};
    struct level *level = &mesh->levels[0];
    for (int d = 0; d < 3; d++) {
        mesh->n[d] = d < dim ? n : 1;
        mesh->n_cell *= (size_t)mesh->n[d];
        mesh->periodic[d] = d < dim && (periodic >> d & 1u);
        for (int l = 0; l <= most_level; l++) mesh->levels[l].extent[d] = d < dim ? extent[d] << l : 1;
    }
    unsigned count = 0, n_tile = (unsigned)(level->extent[0] * level->extent[1] * level->extent[2]);
    struct tile *tiles = mem_new(n_tile, sizeof *tiles);
    for (uint64_t key = 0; count < n_tile; key++) {
        struct tile tile = {.key = key};
        morton_at(key, tile.at);
        bool inside = true;
        for (int d = 0; d < 3; d++) inside &= tile.at[d] < level->extent[d];
        if (inside) tiles[count++] = tile;
    }
    owners(tiles, n_tile);
    replicated_adopt(level, tiles, n_tile);
}

static void mesh_drop(struct mesh *mesh)
{
    for (int l = 0; l <= mesh->most_level; l++) level_drop(&mesh->levels[l]);
}

static void mesh_take(struct mesh *mesh, int base, struct nest_set *sets)
{
    mesh->n_level = base + 1;
    for (int l = base + 1; l <= mesh->most_level; l++) {
        struct level *level = &mesh->levels[l];
        owners(sets[l].tiles, sets[l].n);
        replicated_adopt(level, sets[l].tiles, sets[l].n);
        if (level->n_tile) mesh->n_level = l + 1;
    }
}

static size_t place_of(const struct mesh *mesh, int l, const int at[3])
{
    const int *extent = mesh->levels[l].extent;
    return (size_t)at[0] + (size_t)extent[0] * ((size_t)at[1] + (size_t)extent[1] * (size_t)at[2]);
}

static size_t places(const struct mesh *mesh, int l)
{
    const int *extent = mesh->levels[l].extent;
    return (size_t)extent[0] * (size_t)extent[1] * (size_t)extent[2];
}

static void at_of(const struct mesh *mesh, int l, size_t place, int ret_at[3])
{
    for (int d = 0; d < 3; d++) {
        size_t extent = (size_t)mesh->levels[l].extent[d];
        ret_at[d] = (int)(place % extent);
        place /= extent;
    }
}

static bool settle(const struct mesh *mesh, int l, int at[3])
{
    for (int d = 0; d < 3; d++) {
        int extent = mesh->levels[l].extent[d];
        if (mesh->periodic[d]) at[d] = (at[d] % extent + extent) % extent;
        if (at[d] < 0 || at[d] >= extent) return false;
    }
    return true;
}

#endif
