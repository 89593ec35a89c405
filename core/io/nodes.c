/* nodes.c - see nodes.h.
 *
 * Around a tile lie 4^d regions of the size of an octant: its own octants and one layer more. Each is a leaf of
 * its level, a leaf of the next coarser level (levels nest, so none is coarser still), under finer tiles, or
 * outside. The points of a tile fall into 5^d classes by their place along each axis - faces, middle, and between
 * - so that all points of a class touch the same regions; only every other point is a corner of coarser
 * cells. So the owner is found once per class, for both kinds of points. */
#include "io/nodes.h"

#include "base/gather.h"
#include "base/comm.h"
#include "base/mem.h"
#include "base/swap.h"
#include "mesh/fringe.h"
#include "mesh/morton.h"

enum { NODES_REGIONS = 64, NODES_PLACES = 125, NODES_KINDS = 2 * NODES_PLACES, NODES_NONE = -1 };

/* Whose leaves a region holds. */
struct nodes_owner {
    int level; /* or NODES_NONE */
    unsigned tile;
};

/* Owners of the points of a tile by kind: that of class c is 2 c for its odd points, 2 c + 1 for its even ones. */
struct nodes_around {
    struct nodes_owner owners[NODES_KINDS];
};

static bool nodes_before(struct nodes_owner a, struct nodes_owner b)
{
    if (a.level == NODES_NONE || b.level == NODES_NONE) return a.level != NODES_NONE;
    return a.level != b.level ? a.level < b.level : a.tile < b.tile;
}

static bool nodes_same(struct nodes_owner a, struct nodes_owner b)
{
    return a.level == b.level && a.tile == b.tile;
}

static void nodes_at(const struct nodes *nodes, size_t point, int ret_at[3])
{
    size_t n0 = (size_t)nodes->n[0], n1 = (size_t)nodes->n[1];
    ret_at[0] = (int)(point % n0);
    ret_at[1] = (int)(point / n0 % n1);
    ret_at[2] = (int)(point / (n0 * n1));
}

/* Place of point i of a tile along an axis: 0 lower face, 1 between, 2 middle, 3 between, 4 upper face. */
static int nodes_place(const struct mesh *mesh, int axis, int i)
{
    int n = mesh->n[axis];
    if (axis >= mesh->dim) return 1;
    return i == 0 ? 0 : i == n ? 4 : 2 * i < n ? 1 : 2 * i == n ? 2 : 3;
}

static unsigned char nodes_kind(const struct mesh *mesh, const int at[3])
{
    int kind = 0;
    bool even = true;
    for (int axis = 2; axis >= 0; axis--) kind = 5 * kind + nodes_place(mesh, axis, at[axis]);
    for (int axis = 0; axis < mesh->dim; axis++) even = even && at[axis] % 2 == 0;
    return (unsigned char)(2 * kind + even);
}

/* Who has leaves in the region at octant coordinates `octant` of level l: periodic sides are two places here. */
static struct nodes_owner nodes_region(const struct mesh *mesh, int l, const int octant[3])
{
    const struct level *level = &mesh->levels[l];
    const struct nodes_owner none = {.level = NODES_NONE};
    int at[3] = {0, 0, 0}, above[3] = {0, 0, 0}, bit = 0;
    for (int axis = 0; axis < mesh->dim; axis++) {
        if (octant[axis] < 0 || octant[axis] >= 2 * level->extent[axis]) return none;
        at[axis] = octant[axis] / 2;
        above[axis] = octant[axis] / 4;
        bit |= (octant[axis] & 1) << axis;
    }
    int tile = mesh_find(mesh, level, at);
    if (tile >= 0 && level->tiles[tile].covered >> bit & 1) return none;
    if (tile >= 0) return (struct nodes_owner){l, (unsigned)tile};
    return (struct nodes_owner){l - 1, (unsigned)mesh_find(mesh, level - 1, above)};
}

static void nodes_regions(const struct mesh *mesh, int l, unsigned tile, struct nodes_owner ret_regions[NODES_REGIONS])
{
    const int *at = mesh->levels[l].tiles[tile].at;
    for (int region = 0; region < NODES_REGIONS; region++) {
        const int step[3] = {region % 4 - 1, region / 4 % 4 - 1, region / 16 - 1};
        int octant[3] = {0, 0, 0};
        bool used = true;
        for (int axis = 0; axis < 3; axis++) {
            if (axis < mesh->dim) octant[axis] = 2 * at[axis] + step[axis];
            else used = used && step[axis] == 0;
        }
        ret_regions[region] = used ? nodes_region(mesh, l, octant) : (struct nodes_owner){.level = NODES_NONE};
    }
}

/* First of the regions that the points of a kind touch; odd points have no coarser cells. */
static struct nodes_owner nodes_first(const struct nodes_owner regions[NODES_REGIONS], int l, int kind)
{
    static const int lower[5] = {0, 1, 1, 2, 2}, upper[5] = {1, 1, 2, 2, 3}; /* regions along an axis, by place */
    const int place[3] = {kind / 2 % 5, kind / 10 % 5, kind / 50};
    bool even = kind % 2;
    struct nodes_owner owner = {.level = NODES_NONE};
    for (int k = lower[place[2]]; k <= upper[place[2]]; k++)
        for (int j = lower[place[1]]; j <= upper[place[1]]; j++)
            for (int i = lower[place[0]]; i <= upper[place[0]]; i++) {
                struct nodes_owner other = regions[i + 4 * (j + 4 * k)];
                if ((even || other.level == l) && nodes_before(other, owner)) owner = other;
            }
    return owner;
}

static void nodes_look(const struct mesh *mesh, int l, unsigned tile, struct nodes_around *ret_around)
{
    struct nodes_owner regions[NODES_REGIONS];
    int from = 0, to = NODES_KINDS, one = NODES_KINDS / 5;
    for (int axis = 2; axis >= mesh->dim; axis--, one /= 5) { /* no points elsewhere along axes that there are not */
        from += one;
        to = from + one;
    }
    nodes_regions(mesh, l, tile, regions);
    for (int kind = 0; kind < NODES_KINDS; kind++)
        ret_around->owners[kind] =
            kind >= from && kind < to ? nodes_first(regions, l, kind) : (struct nodes_owner){.level = NODES_NONE};
}

/* Numbers the points that a tile owns from 0 on, the others -1; returns how many. */
static size_t nodes_number(const struct nodes *nodes, const struct nodes_tile *tile, int32_t *ret_number)
{
    int32_t count = 0;
    for (size_t point = 0; point < nodes->n_point; point++) {
        unsigned kind = nodes->kinds[point];
        ret_number[point] = tile->kinds[kind / 64] >> kind % 64 & 1 ? count++ : -1;
    }
    return (size_t)count;
}

/* Which points an own tile owns; those before it are not counted yet. */
static void nodes_own(struct nodes *nodes, const struct mesh *mesh, struct nodes_owner owner)
{
    struct nodes_tile *tile = &nodes->tiles[owner.level][owner.tile];
    struct nodes_around around;
    nodes_look(mesh, owner.level, owner.tile, &around);
    for (unsigned kind = 0; kind < NODES_KINDS; kind++)
        if (nodes_same(around.owners[kind], owner)) tile->kinds[kind / 64] |= UINT64_C(1) << kind % 64;
    tile->n = nodes_number(nodes, tile, nodes->number);
    tile->first = nodes->own[owner.level];
    nodes->own[owner.level] += tile->n;
}

/* Counts what lies before the points of this rank's tiles. */
static void nodes_count(struct nodes *nodes, const struct mesh *mesh)
{
    long long all[MESH_LEVELS], before[MESH_LEVELS];
    for (int l = 0; l < mesh->n_level; l++) {
        const struct level *level = &mesh->levels[l];
        nodes->tiles[l] = mem_new(level->n_known, sizeof *nodes->tiles[l]);
        for (unsigned i = 0; i < level->n_local; i++) nodes_own(nodes, mesh, (struct nodes_owner){l, level->first + i});
        all[l] = (long long)nodes->own[l];
    }
    gather_sums(all, mesh->n_level, before);
    for (int l = 0; l < mesh->n_level; l++) {
        nodes->first[l] = nodes->total + (size_t)before[l];
        nodes->total += (size_t)all[l];
        struct nodes_tile *own = nodes->tiles[l] + mesh->levels[l].first;
        for (unsigned i = 0; i < mesh->levels[l].n_local; i++) own[i].first += nodes->first[l];
    }
}

/* What others are told of a tile. */
struct nodes_told {
    uint64_t key;
    int level;
    struct nodes_tile tile;
};

static struct nodes_tile *nodes_find(const struct nodes *nodes, const struct mesh *mesh, int l, uint64_t key)
{
    int at[3];
    morton_at(key, at);
    return &nodes->tiles[l][mesh_find(mesh, &mesh->levels[l], at)];
}

/* Tells of this rank's tiles whoever knows them, and learns of the others around. */
static void nodes_tell(struct nodes *nodes, const struct mesh *mesh)
{
    struct swap_list fringe = {0};
    struct swap got;
    if (comm_size() == 1) return;
    for (int l = 0; l < mesh->n_level; l++) fringe_list(mesh, l, comm_rank(), &fringe);
    fringe_sort(&fringe);
    const struct fringe_item *items = fringe.items;
    struct nodes_told *told = mem_new(fringe.n, sizeof *told);
    for (unsigned i = 0; i < fringe.n; i++) {
        int l = (int)items[i].level;
        told[i] = (struct nodes_told){items[i].key, l, *nodes_find(nodes, mesh, l, items[i].key)};
    }
    swap_items(told, sizeof *told, fringe.n, fringe.to, &got);
    mem_free(told);
    swap_list_free(&fringe);
    told = got.items;
    for (unsigned i = 0; i < got.n; i++) *nodes_find(nodes, mesh, told[i].level, told[i].key) = told[i].tile;
    swap_done(&got);
}

struct nodes *nodes_new(const struct mesh *mesh)
{
    struct nodes *nodes = mem_new(1, sizeof *nodes);
    nodes->n_point = 1;
    for (int axis = 0; axis < 3; axis++) {
        nodes->n[axis] = mesh->n[axis] + (axis < mesh->dim);
        nodes->n_point *= (size_t)nodes->n[axis];
    }
    nodes->number = mem_new(nodes->n_point, sizeof *nodes->number);
    nodes->kinds = mem_new(nodes->n_point, sizeof *nodes->kinds);
    for (size_t point = 0; point < nodes->n_point; point++) {
        int at[3];
        nodes_at(nodes, point, at);
        nodes->kinds[point] = nodes_kind(mesh, at);
    }
    nodes_count(nodes, mesh);
    nodes_tell(nodes, mesh);
    return nodes;
}

void nodes_free(struct nodes *nodes)
{
    if (!nodes) return;
    for (int level = 0; level < MESH_LEVELS; level++) mem_free(nodes->tiles[level]);
    mem_free(nodes->number);
    mem_free(nodes->kinds);
    mem_free(nodes);
}

/* Gives the points whose owner is `owner` their numbers, seen from `tile` of level l. */
static void nodes_take(struct nodes *nodes, const struct mesh *mesh, const struct nodes_around *around, int l,
                       unsigned tile, struct nodes_owner owner, int32_t *ret_numbers)
{
    const int *here = mesh->levels[l].tiles[tile].at, *there = mesh->levels[owner.level].tiles[owner.tile].at;
    const struct nodes_tile *owned = &nodes->tiles[owner.level][owner.tile];
    nodes_number(nodes, owned, nodes->number);
    for (size_t point = 0; point < nodes->n_point; point++) {
        int at[3];
        if (!nodes_same(around->owners[nodes->kinds[point]], owner)) continue;
        nodes_at(nodes, point, at);
        for (int axis = 0; axis < mesh->dim; axis++) {
            int index = here[axis] * mesh->n[axis] + at[axis];
            at[axis] = (owner.level < l ? index / 2 : index) - there[axis] * mesh->n[axis];
        }
        int place = at[0] + nodes->n[0] * (at[1] + nodes->n[1] * at[2]);
        ret_numbers[point] = (int32_t)owned->first + nodes->number[place];
    }
}

void nodes_of_tile(struct nodes *nodes, const struct mesh *mesh, int level, unsigned tile, int32_t *ret_numbers)
{
    struct nodes_around around;
    struct nodes_owner done[NODES_REGIONS + 1];
    int n_done = 0;
    nodes_look(mesh, level, tile, &around);
    for (size_t point = 0; point < nodes->n_point; point++) ret_numbers[point] = -1;
    for (int kind = 0; kind < NODES_KINDS; kind++) {
        struct nodes_owner owner = around.owners[kind];
        int i = 0;
        while (i < n_done && !nodes_same(done[i], owner)) i++;
        if (i < n_done || owner.level == NODES_NONE) continue;
        done[n_done++] = owner;
        nodes_take(nodes, mesh, &around, level, tile, owner, ret_numbers);
    }
}

size_t nodes_positions(struct nodes *nodes, const struct mesh *mesh, int level, unsigned tile, double (*ret_x)[3])
{
    const struct level *here = &mesh->levels[level];
    size_t count = 0;
    nodes_number(nodes, &nodes->tiles[level][tile], nodes->number);
    for (size_t point = 0; point < nodes->n_point; point++) {
        if (nodes->number[point] < 0) continue;
        int at[3];
        nodes_at(nodes, point, at);
        for (int axis = 0; axis < 3; axis++) {
            int index = here->tiles[tile].at[axis] * mesh->n[axis] + at[axis];
            ret_x[count][axis] = axis < mesh->dim ? mesh->lower[axis] + index * here->h[axis] : 0.0;
        }
        count++;
    }
    return count;
}
