/* level.c - see level.h. Own tiles are found by a table of slots: a build asks some ten times per tile, and
 * bisection of a long list costs several times as much. Those of others, which only tiles at the rim of the own piece
 * ask for, are found by bisection. */
#include "mesh/level.h"

#include "base/comm.h"
#include "base/mem.h"
#include "mesh/morton.h"

void level_local(const struct tile *tiles, unsigned n_tile, unsigned *ret_first, unsigned *ret_n_local)
{
    unsigned first = 0, end;
    int rank = comm_rank();
    while (first < n_tile && tiles[first].rank < rank) first++;
    for (end = first; end < n_tile && tiles[end].rank == rank;) end++;
    *ret_first = first;
    *ret_n_local = end - first;
}

static bool level_has(const void *tiles, unsigned index, const void *key)
{
    return ((const struct tile *)tiles)[index].key == *(const uint64_t *)key;
}

void level_tabulate(struct level *level)
{
    const struct tile *own = level->tiles + level->first;
    slots_start(&level->slots, level->n_local);
    for (unsigned i = 0; i < level->n_local; i++)
        *slots_find(&level->slots, own[i].key, level_has, own, &own[i].key) = i + 1;
}

void level_adopt(struct level *level, struct tile *tiles, unsigned n_known)
{
    mem_free(level->tiles);
    level->tiles = tiles;
    level->n_known = n_known;
    level_local(tiles, n_known, &level->first, &level->n_local);
    level_tabulate(level);
}

void level_drop(struct level *level)
{
    mem_free(level->neighbours);
    slots_done(&level->slots);
    mem_free(level->tiles);
    mem_free(level->first_keys);
    level->first_keys = NULL;
    level->neighbours = NULL;
    level->tiles = NULL;
    level->n_tile = level->n_known = level->first = level->n_local = 0;
}

/* A tile in one of the pieces before or after the own one. */
static int level_find_far(const struct level *level, uint64_t key)
{
    unsigned end = level->first + level->n_local;
    bool before = level->first > 0 && key <= level->tiles[level->first - 1].key;
    unsigned low = before ? 0 : end, high = before ? level->first : level->n_known;
    while (low < high) {
        unsigned middle = low + (high - low) / 2;
        if (level->tiles[middle].key < key) low = middle + 1;
        else high = middle;
    }
    return low < level->n_known && level->tiles[low].key == key ? (int)low : -1;
}

int level_find(const struct level *level, uint64_t key)
{
    const struct tile *own = level->tiles + level->first;
    if (!level->n_local || key < own[0].key || key > own[level->n_local - 1].key) return level_find_far(level, key);
    unsigned slot = *slots_find(&level->slots, key, level_has, own, &key);
    return slot ? (int)(level->first + slot - 1) : -1;
}

bool level_step(const struct mesh *mesh, const struct level *level, const struct tile *tile, int face, int ret_at[3])
{
    int axis = face / 2, extent = level->extent[axis];
    for (int d = 0; d < 3; d++) ret_at[d] = tile->at[d];
    ret_at[axis] += face % 2 ? 1 : -1;
    if (ret_at[axis] >= 0 && ret_at[axis] < extent) return true;
    ret_at[axis] = face % 2 ? 0 : extent - 1;
    return mesh->periodic[axis];
}

int level_behind(const struct mesh *mesh, const struct level *level, const struct tile *tile, int face)
{
    int at[3];
    return level_step(mesh, level, tile, face, at) ? level_find(level, morton_key(at)) : -1;
}

/* Remote slabs and faces of the link are numbered in the order tile, face: halo.c and link.c rely on it. */
void level_connect(const struct mesh *mesh, struct level *level)
{
    unsigned slab = 0, strip = 0;
    int rank = comm_rank();
    mem_free(level->neighbours);
    level->neighbours = mem_new(level->n_local, sizeof *level->neighbours);
    for (unsigned t = 0; t < level->n_local; t++)
        for (int face = 0; face < MESH_FACES; face++) {
            struct neighbour *neighbour = &level->neighbours[t][face];
            int at[3];
            *neighbour = (struct neighbour){.kind = NEIGHBOUR_BOUNDARY};
            if (face >= 2 * mesh->dim || !level_step(mesh, level, &level->tiles[level->first + t], face, at)) continue;
            int other = level_find(level, morton_key(at));
            if (other < 0) *neighbour = (struct neighbour){NEIGHBOUR_COARSE, strip++};
            else if (level->tiles[other].rank == rank)
                *neighbour = (struct neighbour){NEIGHBOUR_LOCAL, (unsigned)other - level->first};
            else *neighbour = (struct neighbour){NEIGHBOUR_REMOTE, slab++};
        }
}

unsigned char level_whole(const struct mesh *mesh)
{
    return (unsigned char)((1u << (1u << mesh->dim)) - 1u);
}

/* Both lists follow the curve, and the key of a parent is that of its child without the last digit: one walk. */
void level_mark(struct mesh *mesh, int l)
{
    const struct level none = {0}, *finer = l + 1 < mesh->n_level ? &mesh->levels[l + 1] : &none;
    struct level *level = &mesh->levels[l];
    unsigned i = 0;
    for (unsigned t = 0; t < level->n_known; t++) level->tiles[t].covered = 0;
    for (unsigned t = 0; t < finer->n_known; t++) {
        uint64_t key = finer->tiles[t].key;
        while (i < level->n_known && level->tiles[i].key < key >> 3) i++;
        if (i < level->n_known && level->tiles[i].key == key >> 3)
            level->tiles[i].covered = (unsigned char)(level->tiles[i].covered | 1u << (key & 7u));
    }
}

/* Place of the tile that lies behind edges or corners, `step` away along each axis; false: there is none. */
static bool level_beyond(const struct mesh *mesh, const struct level *level, const struct tile *tile, const int step[3],
                         int ret_at[3])
{
    for (int d = 0; d < 3; d++) {
        int extent = level->extent[d], at = tile->at[d] + step[d];
        if ((at < 0 || at >= extent) && !mesh->periodic[d]) return false;
        ret_at[d] = (at + extent) % extent;
    }
    return true;
}

int level_around(const struct mesh *mesh, const struct level *level, const struct tile *tile,
                 unsigned ret_tiles[static 26], bool *ret_all)
{
    static const int ways = 27;
    int n = 0;
    *ret_all = true;
    for (int way = 0; way < ways; way++) {
        const int step[3] = {way % 3 - 1, way / 3 % 3 - 1, way / 9 - 1};
        int at[3];
        if ((mesh->dim < 3 && step[2]) || (mesh->dim < 2 && step[1]) || way == ways / 2) continue;
        if (!level_beyond(mesh, level, tile, step, at)) continue;
        int other = level_find(level, morton_key(at));
        if (other < 0) *ret_all = false;
        else ret_tiles[n++] = (unsigned)other;
    }
    return n;
}

/* Are all tiles around a tile wholly covered, those across edges and corners too? */
static bool level_surrounded(const struct mesh *mesh, const struct level *level, const struct tile *tile)
{
    unsigned around[26];
    bool all;
    int n = level_around(mesh, level, tile, around, &all);
    for (int i = 0; all && i < n; i++) all = level->tiles[around[i]].covered == level_whole(mesh);
    return all;
}

static bool level_hidden(const struct mesh *mesh, const struct level *level, const struct tile *tile)
{
    unsigned char whole = level_whole(mesh);
    bool hidden = tile->covered == whole;
    if (hidden && mesh->corners) return level_surrounded(mesh, level, tile);
    for (int face = 0; hidden && face < 2 * mesh->dim; face++) {
        int at[3];
        if (!level_step(mesh, level, tile, face, at)) continue;
        int other = level_find(level, morton_key(at));
        hidden = other >= 0 && level->tiles[other].covered == whole;
    }
    return hidden;
}

void level_hide(struct mesh *mesh, int l)
{
    struct level *level = &mesh->levels[l];
    for (struct tile *tile = level->tiles + level->first; tile < level->tiles + level->first + level->n_local; tile++)
        tile->hidden = level_hidden(mesh, level, tile);
}

void level_cover(struct mesh *mesh, int l)
{
    level_mark(mesh, l);
    level_hide(mesh, l);
}
