/* mesh.c - level 0: tiles along the Morton curve, their owners, neighbours and memory.
 *
 * Main invariant: tiles are sorted by key and every rank holds the whole list, so that who
 * owns what, and what must be exchanged, follows on every rank from the same data without a
 * message. Storage is three arrays per tile (u_old, u_new, w), component-major and without
 * ghosts: measured cheaper than stored ghost frames (docs/decisions). */
#include "mesh/mesh.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "mesh/halo.h"
#include "mesh/morton.h"

#include <stdlib.h>

enum { MESH_TILE_LEAST = 4 };

static int mesh_gcd(int a, int b)
{
    return b ? mesh_gcd(b, a % b) : a;
}

/* Largest tile side by dimension: long rows in 1D; else small enough that most tiles hold one material. */
static int mesh_tile_most(int dim)
{
    return dim == 1 ? 64 : 16;
}

static int mesh_refuse(const struct scene *scene, int common)
{
    struct text counts = {0};
    for (int d = 0; d < scene->dim; d++) text_add(&counts, "%s%d", d ? ", " : "", (scene->cells[d] + 15) / 16 * 16);
    status_fail(
        STATUS_CASE,
        "%s: domain.cells: the counts have no common tile side from %d to %d (greatest common divisor %d); try [%s]",
        scene->cells_place, MESH_TILE_LEAST, mesh_tile_most(scene->dim), common, counts.at);
    text_done(&counts);
    return 0;
}

int mesh_tile_size(const struct scene *scene)
{
    int common = scene->cells[0];
    for (int d = 1; d < scene->dim; d++) common = mesh_gcd(common, scene->cells[d]);
    if (scene->tile) {
        if (common % scene->tile == 0) return scene->tile;
        status_fail(STATUS_CASE, "%s: mesh.tile: %d does not divide all of domain.cells (greatest common divisor %d)",
                    scene->cells_place, scene->tile, common);
        return 0;
    }
    for (int n = mesh_tile_most(scene->dim); n >= MESH_TILE_LEAST; n--)
        if (common % n == 0) return n;
    return mesh_refuse(scene, common);
}

static int mesh_compare_tiles(const void *a, const void *b)
{
    uint64_t ka = ((const struct tile *)a)->key, kb = ((const struct tile *)b)->key;
    return (ka > kb) - (ka < kb);
}

/* All tiles of a box of extent[] tiles, cut into equal pieces of the curve. */
static void mesh_fill_level(struct level *level)
{
    const int *extent = level->extent;
    level->n_tile = (unsigned)(extent[0] * extent[1] * extent[2]);
    level->tiles = mem_new(level->n_tile, sizeof *level->tiles);
    unsigned count = 0;
    for (int k = 0; k < extent[2]; k++)
        for (int j = 0; j < extent[1]; j++)
            for (int i = 0; i < extent[0]; i++) {
                struct tile *tile = &level->tiles[count++];
                *tile = (struct tile){.at = {i, j, k}};
                tile->key = morton_key(tile->at);
            }
    qsort(level->tiles, level->n_tile, sizeof *level->tiles, mesh_compare_tiles);
    uint64_t size = (uint64_t)comm_size();
    for (unsigned rank = 0; rank < size; rank++) {
        unsigned from = (unsigned)(level->n_tile * (uint64_t)rank / size);
        unsigned to = (unsigned)(level->n_tile * (rank + 1ull) / size);
        for (unsigned i = from; i < to; i++) level->tiles[i].rank = (int)rank;
        if ((int)rank != comm_rank()) continue;
        level->first = from;
        level->n_local = to - from;
    }
}

int mesh_find(const struct mesh *mesh, const struct level *level, const int at[3])
{
    struct tile wanted = {0};
    for (int d = 0; d < 3; d++) {
        int c = at[d], extent = level->extent[d];
        if (mesh->periodic[d]) c = (c % extent + extent) % extent;
        if (c < 0 || c >= extent) return -1;
        wanted.at[d] = c;
    }
    wanted.key = morton_key(wanted.at);
    const struct tile *found = bsearch(&wanted, level->tiles, level->n_tile, sizeof *level->tiles, mesh_compare_tiles);
    return found ? (int)(found - level->tiles) : -1;
}

static void mesh_find_neighbours(const struct mesh *mesh, struct level *level)
{
    level->neighbours = mem_new(level->n_local, sizeof *level->neighbours);
    unsigned slab = 0; /* remote slabs are numbered in the order tile, face: halo.c relies on it */
    for (unsigned t = 0; t < level->n_local; t++)
        for (int face = 0; face < 2 * mesh->dim; face++) {
            const struct tile *tile = &level->tiles[level->first + t];
            int at[3] = {tile->at[0], tile->at[1], tile->at[2]};
            at[face / 2] += face % 2 ? 1 : -1;
            int other = mesh_find(mesh, level, at);
            struct neighbour *neighbour = &level->neighbours[t][face];
            neighbour->kind = other < 0                                 ? NEIGHBOUR_BOUNDARY
                              : level->tiles[other].rank == comm_rank() ? NEIGHBOUR_LOCAL
                                                                        : NEIGHBOUR_REMOTE;
            if (neighbour->kind == NEIGHBOUR_LOCAL) neighbour->index = (unsigned)other - level->first;
            if (neighbour->kind == NEIGHBOUR_REMOTE) neighbour->index = slab++;
        }
}

/* `count` arrays of one size, all in one block (large pages where the system has them). */
static double **mesh_arrays(unsigned count, size_t doubles)
{
    double **arrays = mem_new(count + 1, sizeof *arrays);
    size_t pitch = (doubles + 15) / 8 * 8; /* a cache line apart, so that arrays do not share cache sets */
    arrays[0] = mem_new_large(pitch * (count ? count : 1), sizeof **arrays);
    for (unsigned i = 1; i < count; i++) arrays[i] = arrays[0] + i * pitch;
    return arrays;
}

static void mesh_free_arrays(double **arrays)
{
    if (arrays) mem_free(arrays[0]);
    mem_free(arrays);
}

static void mesh_store_level(const struct mesh *mesh, struct level *level)
{
    size_t doubles = mesh->n_field * mesh->n_cell;
    level->u_old = mesh_arrays(level->n_local, doubles);
    level->u_new = mesh_arrays(level->n_local, doubles);
    level->w = mesh_arrays(level->n_local, doubles);
    level->halo = halo_new(mesh, level, mesh->n_field);
}

int mesh_new(const struct scene *scene, unsigned n_field, unsigned n_alpha, struct mesh **ret_mesh)
{
    int n = mesh_tile_size(scene);
    if (!n) return STATUS_CASE;
    struct mesh *mesh = mem_new(1, sizeof *mesh);
    mesh->dim = scene->dim;
    mesh->beta = (int)scene->geometry;
    mesh->n_field = n_field;
    mesh->n_alpha = n_alpha;
    mesh->most_level = scene->levels;
    mesh->n_level = 1;
    mesh->n_cell = 1;
    struct level *level = &mesh->levels[0];
    for (int d = 0; d < 3; d++) {
        bool used = d < scene->dim;
        mesh->lower[d] = scene->lower[d];
        mesh->upper[d] = scene->upper[d];
        mesh->n[d] = used ? n : 1;
        mesh->n_cell *= (size_t)mesh->n[d];
        mesh->periodic[d] = used && scene->boundary[d][0].type == SCENE_PERIODIC;
        level->extent[d] = used ? scene->cells[d] / n : 1;
        level->h[d] = used ? (scene->upper[d] - scene->lower[d]) / scene->cells[d] : 1.0;
    }
    mesh_fill_level(level);
    mesh_find_neighbours(mesh, level);
    mesh_store_level(mesh, level);
    *ret_mesh = mesh;
    return STATUS_OK;
}

void mesh_free(struct mesh *mesh)
{
    if (!mesh) return;
    for (int l = 0; l < mesh->n_level; l++) {
        struct level *level = &mesh->levels[l];
        halo_free(level->halo);
        mesh_free_arrays(level->u_old);
        mesh_free_arrays(level->u_new);
        mesh_free_arrays(level->w);
        mem_free(level->neighbours);
        mem_free(level->tiles);
    }
    mem_free(mesh);
}

void mesh_corner(const struct mesh *mesh, const struct level *level, const struct tile *tile, double ret_corner[3])
{
    for (int d = 0; d < 3; d++) ret_corner[d] = mesh->lower[d] + (double)(tile->at[d] * mesh->n[d]) * level->h[d];
}

void mesh_swap(struct level *level)
{
    double **keep = level->u_old;
    level->u_old = level->u_new;
    level->u_new = keep;
}
