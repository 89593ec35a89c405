/* nest_family.c - see nest_family.h. Repetitions are caught twice: those close on the curve by a small table of
 * families added lately, the others after sorting. */
#include "mesh/nest_family.h"

#include "base/mem.h"
#include "mesh/morton.h"

#include <string.h>

bool nest_family_place(const struct mesh *mesh, const struct level *level, const int at[3], uint64_t *ret_key)
{
    int inside[3];
    for (int d = 0; d < 3; d++) {
        int extent = level->extent[d], c = at[d];
        if (c < 0 || c >= extent) {
            if (!mesh->periodic[d]) return false;
            c = (c % extent + extent) % extent;
        }
        inside[d] = c;
    }
    *ret_key = morton_key(inside);
    return true;
}

void nest_family_add(struct nest_families *families, uint64_t key, uint32_t mask)
{
    unsigned *recent = &families->recent[key * 0x9e3779b97f4a7c15u >> 32 & (NEST_FAMILY_RECENT - 1)];
    if (*recent && families->list[*recent - 1].key == key) {
        families->list[*recent - 1].mask |= mask;
        return;
    }
    if (families->n == families->room) {
        unsigned room = families->room ? 2 * families->room : 64;
        families->list = mem_grow(families->list, families->n, room, sizeof *families->list);
        families->room = room;
    }
    families->list[families->n++] = (struct nest_family){key, mask};
    *recent = families->n;
}

void nest_family_add_tile(struct nest_families *families, uint64_t key)
{
    nest_family_add(families, key >> 3, 1u << (key & 7u));
}

/* Which of the 3^d tiles around a parent its child in octant o needs: those on its own side of each axis. */
static uint32_t nest_family_child_needs(int dim, unsigned octant)
{
    uint32_t needs = 0;
    for (int i = 0; i < NEST_FAMILY_AROUND; i++) {
        int off[3] = {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
        bool needed = true;
        for (int d = 0; d < 3; d++) {
            int side = octant >> d & 1u ? 1 : -1;
            if (off[d] != 0 && (d >= dim || off[d] != side)) needed = false;
        }
        if (needed) needs |= 1u << i;
    }
    return needs;
}

/* Adds the tiles `needs` around a parent, one by one: at the border of the domain. */
static void nest_family_add_singly(const struct mesh *mesh, const struct level *level, const int parent[3],
                                   uint32_t needs, struct nest_families *families)
{
    for (int a = 0; a < NEST_FAMILY_AROUND; a++) {
        int place[3] = {parent[0] + a % 3 - 1, parent[1] + a / 3 % 3 - 1, parent[2] + a / 9 - 1};
        uint64_t key;
        if (needs >> a & 1u && nest_family_place(mesh, level, place, &key)) nest_family_add_tile(families, key);
    }
}

/* The same inside the domain. Along an axis the three places around p lie in two families: `from` says in which, and
 * `bit` as which of its halves; all 2^3 combinations are gathered first. */
static void nest_family_add_around(const int parent[3], uint32_t needs, struct nest_families *families)
{
    unsigned from[3][3], bit[3][3];
    uint64_t spread[3][2];
    uint32_t masks[MESH_OCTANTS] = {0};
    for (int d = 0; d < 3; d++) {
        int low = (parent[d] - 1) >> 1;
        for (int a = 0; a < 3; a++) {
            from[d][a] = (unsigned)(((parent[d] + a - 1) >> 1) - low) << d;
            bit[d][a] = (unsigned)((parent[d] + a - 1) & 1) << d;
        }
        spread[d][0] = morton_spread((uint64_t)low) << d;
        spread[d][1] = morton_spread((uint64_t)low + 1) << d;
    }
    for (; needs; needs &= needs - 1) {
        int a = __builtin_ctz(needs), x = a % 3, y = a / 3 % 3, z = a / 9;
        masks[from[0][x] | from[1][y] | from[2][z]] |= 1u << (bit[0][x] | bit[1][y] | bit[2][z]);
    }
    for (unsigned f = 0; f < MESH_OCTANTS; f++)
        if (masks[f])
            nest_family_add(families, spread[0][f & 1u] | spread[1][f >> 1 & 1u] | spread[2][f >> 2], masks[f]);
}

void nest_family_needs(const struct mesh *mesh, int l, const struct tile *tiles, unsigned n,
                       struct nest_families *families)
{
    const struct level *coarse = &mesh->levels[l - 1];
    uint32_t child[MESH_OCTANTS];
    for (unsigned o = 0; o < MESH_OCTANTS; o++) child[o] = nest_family_child_needs(mesh->dim, o);
    for (unsigned i = 0; i < n;) {
        uint64_t family = tiles[i].key >> 3;
        const int *at = tiles[i].at;
        int parent[3] = {at[0] >> 1, at[1] >> 1, at[2] >> 1};
        uint32_t needs = 0;
        for (; i < n && tiles[i].key >> 3 == family; i++) needs |= child[tiles[i].key & 7u];
        bool border = false;
        for (int d = 0; d < mesh->dim; d++) border |= parent[d] == 0 || parent[d] == coarse->extent[d] - 1;
        if (border) nest_family_add_singly(mesh, coarse, parent, needs, families);
        else nest_family_add_around(parent, needs, families);
    }
}

/* Stable sort by one byte of the keys. */
static void nest_family_sort_byte(const struct nest_family *from, unsigned n, int shift, struct nest_family *to)
{
    unsigned start[256] = {0}, sum = 0;
    for (unsigned i = 0; i < n; i++) start[from[i].key >> shift & 255u]++;
    for (int b = 0; b < 256; b++) {
        unsigned count = start[b];
        start[b] = sum;
        sum += count;
    }
    for (unsigned i = 0; i < n; i++) to[start[from[i].key >> shift & 255u]++] = from[i];
}

/* Sorted: joins equal keys. */
static void nest_family_join(struct nest_families *families)
{
    struct nest_family *list = families->list;
    unsigned n = families->n > 0;
    for (unsigned i = 1; i < families->n; i++)
        if (list[i].key == list[n - 1].key) list[n - 1].mask |= list[i].mask;
        else list[n++] = list[i];
    families->n = n;
    memset(families->recent, 0, sizeof families->recent); /* indices have moved */
}

void nest_family_sort(struct nest_families *families)
{
    uint64_t differ = 0;
    for (unsigned i = 1; i < families->n; i++) differ |= families->list[i].key ^ families->list[0].key;
    struct nest_family *from = families->list, *to = differ ? mem_new(families->room, sizeof *to) : NULL;
    for (int shift = 0; shift < 64; shift += 8) {
        if (!(differ >> shift & 255u)) continue;
        nest_family_sort_byte(from, families->n, shift, to);
        struct nest_family *other = from;
        from = to;
        to = other;
    }
    families->list = from;
    mem_free(to);
    nest_family_join(families);
}

uint64_t *nest_family_keys(const struct nest_families *families, unsigned *ret_n)
{
    unsigned n = 0;
    for (unsigned i = 0; i < families->n; i++) n += (unsigned)__builtin_popcount(families->list[i].mask);
    uint64_t *keys = mem_new((size_t)n + 1, sizeof *keys), *to = keys;
    for (unsigned i = 0; i < families->n; i++)
        for (uint32_t mask = families->list[i].mask; mask; mask &= mask - 1)
            *to++ = families->list[i].key << 3 | (unsigned)__builtin_ctz(mask);
    *ret_n = n;
    return keys;
}

void nest_family_free(struct nest_families *families)
{
    mem_free(families->list);
    *families = (struct nest_families){0};
}
