/* levels.h - meshes of random nested levels for the tests of core/mesh, on any number of ranks, beside a plain picture
 * of the same levels (a map of each) that everything can be compared with. All ranks draw the same numbers. */
#ifndef LEVELS_H
#define LEVELS_H

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "mesh/halo.h"
#include "mesh/link.h"
#include "mesh/mesh.h"
#include "mesh/morton.h"
#include "mesh/pool.h"
#include "replicated.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { LEVELS_MOST = 4, LEVELS_FIELDS = 3 };

struct levels_shape {
    int dim, tiles[3], n, levels;
    bool periodic[3];
};

static const struct levels_shape LEVELS_SHAPES[] = {
    {1, {9, 1, 1}, 4, 3, {false}},
    {1, {1, 1, 1}, 6, 3, {true}},
    {1, {7, 1, 1}, 8, 2, {true}},
    {2, {5, 4, 1}, 4, 2, {false, false}},
    {2, {3, 5, 1}, 6, 2, {true, false}},
    {2, {1, 2, 1}, 4, 3, {true, true}},
    {2, {4, 3, 1}, 4, 2, {true, true}},
    {3, {3, 2, 3}, 4, 2, {false, false, false}},
    {3, {2, 3, 3}, 4, 2, {false, true, false}},
    {3, {1, 2, 3}, 4, 2, {true, true, true}},
};
enum { LEVELS_SHAPE_COUNT = sizeof LEVELS_SHAPES / sizeof *LEVELS_SHAPES };

/* maps[l][index of a place]: is there a tile of level l? lists[l]: all tiles that the mesh was given, with their
 * owners. */
struct levels {
    struct levels_shape shape;
    struct mesh *mesh;
    uint64_t seed;
    unsigned char *maps[LEVELS_MOST];
    struct tile *lists[LEVELS_MOST];
    unsigned counts[LEVELS_MOST];
};

static inline uint64_t levels_random(struct levels *levels)
{
    uint64_t z = levels->seed += 0x9e3779b97f4a7c15u; /* splitmix64 */
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

/* Number of places of a level; at[] of the place `index`. */
static inline size_t levels_places(const struct levels *levels, int l)
{
    size_t count = 1;
    for (int d = 0; d < levels->shape.dim; d++) count *= (size_t)levels->shape.tiles[d] << l;
    return count;
}

static inline void levels_at(const struct levels *levels, int l, size_t index, int ret_at[3])
{
    for (int d = 0; d < 3; d++) {
        size_t extent = d < levels->shape.dim ? (size_t)levels->shape.tiles[d] << l : 1;
        ret_at[d] = (int)(index % extent);
        index /= extent;
    }
}

/* Wraps a place; its index, or -1 outside the domain. */
static inline long levels_index(const struct levels *levels, int l, int at[3])
{
    long index = 0;
    for (int d = 2; d >= 0; d--) {
        int extent = d < levels->shape.dim ? levels->shape.tiles[d] << l : 1;
        if (levels->shape.periodic[d]) at[d] = (at[d] + 8 * extent) % extent;
        if (at[d] < 0 || at[d] >= extent) return -1;
        index = index * extent + at[d];
    }
    return index;
}

/* Is there a tile of level l at a place? False outside and on levels that do not exist. */
static inline bool levels_has(const struct levels *levels, int l, const int at[3])
{
    int wrapped[3] = {at[0], at[1], at[2]};
    long index = l < LEVELS_MOST ? levels_index(levels, l, wrapped) : -1;
    return index >= 0 && levels->maps[l] && levels->maps[l][index];
}

/* The place behind a face; false outside the domain. */
static inline bool levels_behind(const struct levels *levels, int l, const struct tile *tile, int face, int ret_at[3])
{
    for (int d = 0; d < 3; d++) ret_at[d] = tile->at[d];
    ret_at[face / 2] += face % 2 ? 1 : -1;
    return levels_index(levels, l, ret_at) >= 0;
}

/* Marks what the tile of level l at `at` needs on level l - 1: all places above the 3^d octants around it. */
static inline void levels_close(struct levels *levels, int l, const int at[3])
{
    for (int step = 0; step < 27; step++) {
        const int steps[3] = {step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1};
        int there[3];
        bool flat = true;
        for (int d = 0; d < 3; d++) {
            there[d] = at[d] + steps[d];
            flat = flat && (d < levels->shape.dim || !steps[d]);
        }
        if (!flat || levels_index(levels, l, there) < 0) continue;
        for (int d = 0; d < 3; d++) there[d] >>= 1;
        levels->maps[l - 1][levels_index(levels, l - 1, there)] = 1;
    }
}

/* New random maps of levels 1 .. most: some places of each level at random, closed under the nesting rule. */
static inline void levels_draw(struct levels *levels)
{
    for (int l = levels->shape.levels; l > 0; l--) {
        size_t places = levels_places(levels, l);
        uint64_t chance = levels_random(levels) % 40; /* per cent, a quarter of it on fine levels */
        if (levels_random(levels) % 8 == 0) chance = 100;
        for (size_t i = 0; i < places; i++)
            if (levels_random(levels) % 100 < chance / (unsigned)l) levels->maps[l][i] = 1;
        for (size_t i = 0; i < places; i++) {
            int at[3];
            levels_at(levels, l, i, at);
            if (levels->maps[l][i]) levels_close(levels, l, at);
        }
    }
}

static inline int levels_compare(const void *a, const void *b)
{
    uint64_t x = ((const struct tile *)a)->key, y = ((const struct tile *)b)->key;
    return (x > y) - (x < y);
}

/* The list of a map, with random owners: ranks may come away empty. */
static inline struct tile *levels_list(struct levels *levels, int l, unsigned *ret_n)
{
    size_t places = levels_places(levels, l);
    struct tile *tiles = mem_new(places, sizeof *tiles);
    unsigned n = 0;
    for (size_t i = 0; i < places; i++) {
        if (!levels->maps[l][i]) continue;
        levels_at(levels, l, i, tiles[n].at);
        tiles[n].key = morton_key(tiles[n].at);
        n++;
    }
    qsort(tiles, n, sizeof *tiles, levels_compare);
    for (int cut = 1; cut < comm_size(); cut++) {
        unsigned from = (unsigned)(levels_random(levels) % (n + 1u));
        for (unsigned i = from; i < n; i++) tiles[i].rank++;
    }
    *ret_n = n;
    return tiles;
}

/* Gives level l such a list (taken over), and keeps a copy. n 0: takes it away. */
static inline void levels_give(struct levels *levels, int l, struct tile *tiles, unsigned n,
                               struct mesh_change *ret_change)
{
    mem_free(levels->lists[l]);
    levels->lists[l] = mem_new(n, sizeof *tiles);
    levels->counts[l] = n;
    if (n) memcpy(levels->lists[l], tiles, n * sizeof *tiles);
    replicated_replace(levels->mesh, l, tiles, n, ret_change);
}

/* The owner of a place; -1: there is no tile. */
static inline int levels_owner(const struct levels *levels, int l, const int at[3])
{
    int wrapped[3] = {at[0], at[1], at[2]};
    if (!levels_has(levels, l, at)) return -1;
    levels_index(levels, l, wrapped);
    for (unsigned i = 0; i < levels->counts[l]; i++)
        if (levels->lists[l][i].key == morton_key(wrapped)) return levels->lists[l][i].rank;
    return -1;
}

/* Is a tile of this rank among the places `from` to `to` around at, of level l? */
static inline bool levels_near(const struct levels *levels, int l, const int at[3], int from, int to)
{
    int step[3];
    for (step[2] = from; step[2] <= to; step[2]++)
        for (step[1] = from; step[1] <= to; step[1]++)
            for (step[0] = from; step[0] <= to; step[0]++) {
                int there[3] = {at[0], at[1], at[2]};
                bool used = true;
                for (int d = 0; d < 3; d++) {
                    used = used && (d < levels->shape.dim || step[d] == 0);
                    there[d] += step[d];
                }
                if (used && levels_owner(levels, l, there) == comm_rank()) return true;
            }
    return false;
}

/* Must this rank know the tile of level l at `at`? See mesh/fringe.h. */
static inline bool levels_known(const struct levels *levels, int l, const int at[3])
{
    const int above[3] = {at[0] >> 1, at[1] >> 1, at[2] >> 1}, below[3] = {2 * at[0], 2 * at[1], 2 * at[2]};
    if (levels_near(levels, l, at, -1, 1)) return true;
    if (l > 0 && levels_near(levels, l - 1, above, -1, 1)) return true;
    return l + 1 < levels->mesh->n_level && levels_near(levels, l + 1, below, -1, 2);
}

/* A number that tells a value of a cell from any other: field q of a cell of level l, exact in a double. */
static inline double levels_value(const struct levels *levels, int l, const struct tile *tile, unsigned q, size_t cell)
{
    double value = (double)(q + 10 * (unsigned)l + 100);
    for (int d = 0; d < 3; d++) {
        size_t n = (size_t)levels->mesh->n[d];
        value = 1000.0 * value + (double)tile->at[d] * (double)n + (double)(cell % n);
        cell /= n;
    }
    return value;
}

/* Fills u_old with the values of a level, w with their negatives. */
static inline void levels_fill(struct levels *levels, int l)
{
    struct level *level = &levels->mesh->levels[l];
    size_t n = levels->mesh->n_cell;
    for (unsigned t = 0; t < level->n_local; t++)
        for (size_t i = 0; i < n * LEVELS_FIELDS; i++) {
            double value = levels_value(levels, l, &level->tiles[level->first + t], (unsigned)(i / n), i % n);
            level->u_old[t][i] = value;
            level->w[t][i] = -value;
        }
}

/* The list of level 0 as mesh_new has cut it: equal pieces. */
static inline void levels_begin(struct levels *levels)
{
    uint64_t seed = levels->seed;
    unsigned n;
    struct tile *tiles = levels_list(levels, 0, &n);
    for (uint64_t rank = 0, size = (uint64_t)comm_size(); rank < size; rank++)
        for (uint64_t i = n * rank / size; i < n * (rank + 1) / size; i++) tiles[i].rank = (int)rank;
    levels->lists[0] = tiles;
    levels->counts[0] = n;
    levels->seed = seed;
}

static inline void levels_open(struct levels *levels, const struct levels_shape *shape, uint64_t seed)
{
    struct scene scene = {.domain = {.dim = shape->dim, .cells_place = "case.yaml:1:1"},
                          .mesh = {.levels = shape->levels, .tile = shape->n},
                          .scheme = {.ghosts = seed % 2 && shape->n >= 6 ? SCENE_GHOSTS_MOST : SCENE_GHOSTS}};
    for (int d = 0; d < 3; d++) {
        scene.domain.cells[d] = d < shape->dim ? shape->tiles[d] * shape->n : 1;
        scene.domain.lower[d] = d < shape->dim ? -1.5 : 0.0;
        scene.domain.upper[d] = d < shape->dim ? 0.25 * scene.domain.cells[d] - 1.5 : 0.0;
        for (int side = 0; side < 2; side++)
            scene.domain.boundary[d][side].type = shape->periodic[d] ? SCENE_PERIODIC : SCENE_OUTFLOW;
    }
    *levels = (struct levels){.shape = *shape, .seed = seed};
    assert_int_equal(mesh_new(&scene, LEVELS_FIELDS, 1, &levels->mesh), STATUS_OK);
    for (int l = 0; l <= shape->levels; l++) levels->maps[l] = mem_new(levels_places(levels, l), 1);
    memset(levels->maps[0], 1, levels_places(levels, 0));
    levels_begin(levels);
    levels_fill(levels, 0);
}

static inline void levels_close_all(struct levels *levels)
{
    mesh_free(levels->mesh);
    for (int l = 0; l < LEVELS_MOST; l++) {
        mem_free(levels->maps[l]);
        mem_free(levels->lists[l]);
    }
}

/* Gives the mesh new random levels, coarse before fine; levels that end empty are taken away first. */
static inline void levels_refine(struct levels *levels)
{
    struct mesh *mesh = levels->mesh;
    struct mesh_change change;
    for (int l = 1; l <= levels->shape.levels; l++) memset(levels->maps[l], 0, levels_places(levels, l));
    levels_draw(levels);
    int last = levels->shape.levels;
    while (!memchr(levels->maps[last], 1, levels_places(levels, last))) last--;
    while (mesh->n_level - 1 > last) {
        levels_give(levels, mesh->n_level - 1, NULL, 0, &change);
        mesh_change_free(&change);
    }
    for (int l = 1; l <= last; l++) {
        unsigned n;
        struct tile *tiles = levels_list(levels, l, &n);
        levels_give(levels, l, tiles, n, &change);
        mesh_change_free(&change);
        levels_fill(levels, l);
    }
}

/* Under mpirun the same tests run on several ranks. */
static inline int levels_main(int argc, char **argv, int (*run)(void))
{
    comm_init(&argc, &argv);
    int failed = run();
    comm_done();
    return failed;
}

/* Is a tile there, and all that lie over it? */
static inline bool levels_whole(const struct levels *levels, int l, const int at[3])
{
    bool all = levels_has(levels, l, at);
    for (int o = 0; o < 1 << levels->shape.dim; o++) {
        const int below[3] = {2 * at[0] + (o & 1), 2 * at[1] + (o >> 1 & 1), 2 * at[2] + (o >> 2)};
        all = all && levels_has(levels, l + 1, below);
    }
    return all;
}

#endif
