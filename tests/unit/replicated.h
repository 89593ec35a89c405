/* replicated.h - lists of all tiles of a level on every rank, with their owners: the reference that the pieces and
 * fringes of the program are compared with, and the way in which tests say what a level is to be. */
#ifndef REPLICATED_H
#define REPLICATED_H

#include "base/comm.h"
#include "base/mem.h"
#include "mesh/level.h"
#include "mesh/mesh.h"
#include "mesh/morton.h"
#include "mesh/nest.h"
#include "mesh/span.h"

#include <string.h>

/* Sets tiles[i].rank by a table of first tiles (partition_cut). */
static inline void replicated_give(struct tile *tiles, int size, const uint32_t *first)
{
    for (int rank = 0; rank < size; rank++)
        for (uint32_t i = first[rank]; i < first[rank + 1]; i++) tiles[i].rank = rank;
}

/* The first keys of ranks that own sorted tiles: a new array (mem_free). */
static inline uint64_t *replicated_first(const struct tile *tiles, unsigned n, int size)
{
    uint64_t *first = mem_new((size_t)size, sizeof *first);
    unsigned i = n;
    for (int rank = size - 1; rank >= 0; rank--) {
        while (i > 0 && tiles[i - 1].rank >= rank) i--;
        first[rank] = i < n ? tiles[i].key : UINT64_MAX;
    }
    return first;
}

/* Gives a level a list of all its tiles (taken over): this rank knows all. */
static inline void replicated_adopt(struct level *level, struct tile *tiles, unsigned n)
{
    mem_free(level->first_keys);
    level->n_tile = n;
    level->n_rank = comm_size();
    level->first_keys = replicated_first(tiles, n, level->n_rank);
    level_adopt(level, tiles, n);
}

/* All pieces of a set, in place of this rank's. Collective. */
static inline void replicated_join(struct nest_set *set)
{
    enum { WORDS = 2 };
    unsigned n;
    uint64_t *own = mem_new(WORDS * (size_t)set->n, sizeof *own);
    for (unsigned i = 0; i < set->n; i++) {
        own[WORDS * i] = set->tiles[i].key;
        own[WORDS * i + 1] = set->tiles[i].unwanted;
    }
    uint64_t *all = comm_join_keys(own, WORDS * set->n, &n);
    nest_keys_free_set(set);
    *set = (struct nest_set){n / WORDS, mem_new(n / WORDS, sizeof *set->tiles)};
    for (unsigned i = 0; i < set->n; i++) {
        set->tiles[i] = (struct tile){.key = all[WORDS * i], .unwanted = all[WORDS * i + 1] & 0xffu};
        morton_at(all[WORDS * i], set->tiles[i].at);
    }
    mem_free(own);
    mem_free(all);
}

/* Index of a key among sorted ones, or -1. */
static inline int replicated_find(const uint64_t *keys, unsigned n, uint64_t key)
{
    unsigned low = 0, high = n;
    while (low < high) {
        unsigned middle = low + (high - low) / 2;
        if (keys[middle] < key) low = middle + 1;
        else high = middle;
    }
    return low < n && keys[low] == key ? (int)low : -1;
}

/* What this rank tells of a list of all tiles with ranks, in place of level l. Collective. */
static inline struct mesh_set replicated_set(const struct mesh *mesh, int l, const struct tile *tiles, unsigned n)
{
    const struct level *level = &mesh->levels[l];
    struct span span = span_of(mesh, l);
    struct mesh_set set = {.n_tile = n};
    unsigned n_old = l < mesh->n_level ? level->n_local : 0, n_was, first;
    uint64_t *old = mem_new(n_old, sizeof *old), *now = mem_new(n, sizeof *now);
    for (unsigned t = 0; t < n_old; t++) old[t] = level->tiles[level->first + t].key;
    for (unsigned i = 0; i < n; i++) now[i] = tiles[i].key;
    uint64_t *was = comm_join_keys(old, n_old, &n_was);
    level_local(tiles, n, &first, &set.n);
    set.tiles = mem_new(set.n, sizeof *set.tiles);
    set.from = mem_new(set.n, sizeof *set.from);
    set.to = mem_new(n_old, sizeof *set.to);
    set.first_keys = replicated_first(tiles, n, comm_size());
    if (set.n) memcpy(set.tiles, tiles + first, set.n * sizeof *set.tiles);
    for (unsigned i = 0; i < set.n; i++)
        set.from[i] = replicated_find(was, n_was, set.tiles[i].key) < 0 ? -1 : span_owner(&span, set.tiles[i].key);
    for (unsigned t = 0; t < n_old; t++) {
        int index = replicated_find(now, n, old[t]);
        set.to[t] = index < 0 ? -1 : tiles[index].rank;
    }
    mem_free(was);
    mem_free(now);
    mem_free(old);
    return set;
}

/* mesh_replace of level l by a list of all tiles (freed). Collective. */
static inline void replicated_replace(struct mesh *mesh, int l, struct tile *tiles, unsigned n,
                                      struct mesh_change *ret_change)
{
    struct mesh_set sets[MESH_LEVELS];
    struct mesh_change changes[MESH_LEVELS];
    sets[l] = replicated_set(mesh, l, tiles, n);
    mesh_replace(mesh, l, l, sets, changes);
    *ret_change = changes[l];
    mem_free(tiles);
}

#endif
