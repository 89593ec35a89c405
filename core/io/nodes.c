/* nodes.c - see nodes.h.
 *
 * The points of a tile fall into 3^d classes by their place along each axis: on the lower face
 * (0), between the faces (1), on the upper face (2). All points of a class are touched by the same
 * tiles, so the owner is found once per class. */
#include "io/nodes.h"

#include "base/comm.h"
#include "base/mem.h"

enum { NODES_CLASSES = 27 };

static int nodes_place(const struct mesh *mesh, int axis, int i)
{
    if (axis >= mesh->dim) return 1;
    return i == 0 ? 0 : i == mesh->n[axis] ? 2 : 1;
}

static void nodes_at(const struct nodes *nodes, size_t point, int ret_at[3])
{
    size_t n0 = (size_t)nodes->n[0], n1 = (size_t)nodes->n[1];
    ret_at[0] = (int)(point % n0);
    ret_at[1] = (int)(point / n0 % n1);
    ret_at[2] = (int)(point / (n0 * n1));
}

static int nodes_class(const struct mesh *mesh, const int at[3])
{
    int digit = 1, kind = 0;
    for (int axis = 0; axis < 3; axis++, digit *= 3) kind += digit * nodes_place(mesh, axis, at[axis]);
    return kind;
}

/* The tile at `at` + `step`, or -1 beyond the domain: periodic sides are two places here. */
static int nodes_tile(const struct mesh *mesh, const struct level *level, const int at[3], const int step[3])
{
    int there[3];
    for (int axis = 0; axis < 3; axis++) {
        there[axis] = at[axis] + step[axis];
        if (there[axis] < 0 || there[axis] >= level->extent[axis]) return -1;
    }
    return mesh_find(mesh, level, there);
}

/* First of the tiles that touch the points of class `kind` of a tile. */
static unsigned nodes_owner(const struct mesh *mesh, const struct level *level, unsigned tile, int kind)
{
    const int place[3] = {kind % 3 - 1, kind / 3 % 3 - 1, kind / 9 - 1};
    unsigned owner = tile;
    for (int corner = 1; corner < 8; corner++) {
        int step[3];
        bool touching = true;
        for (int axis = 0; axis < 3; axis++) {
            step[axis] = (corner >> axis & 1) * place[axis];
            touching = touching && (step[axis] || !(corner >> axis & 1));
        }
        if (!touching) continue;
        int other = nodes_tile(mesh, level, level->tiles[tile].at, step);
        if (other >= 0 && (unsigned)other < owner) owner = (unsigned)other;
    }
    return owner;
}

static void nodes_owners(const struct mesh *mesh, const struct level *level, unsigned tile,
                         unsigned ret_owner[NODES_CLASSES])
{
    for (int kind = 0; kind < NODES_CLASSES; kind++) {
        const int places[3] = {kind % 3, kind / 3 % 3, kind / 9};
        ret_owner[kind] = tile;
        bool used = true;
        for (int axis = mesh->dim; axis < 3; axis++) used = used && places[axis] == 1;
        if (used) ret_owner[kind] = nodes_owner(mesh, level, tile, kind);
    }
}

/* Numbers the points that a tile owns from 0 on, the others -1; returns how many. */
static size_t nodes_own(const struct nodes *nodes, const struct mesh *mesh, const struct level *level, unsigned tile,
                        int32_t *ret_number)
{
    unsigned owner[NODES_CLASSES];
    nodes_owners(mesh, level, tile, owner);
    int32_t count = 0;
    for (size_t point = 0; point < nodes->n_point; point++) {
        int at[3];
        nodes_at(nodes, point, at);
        ret_number[point] = owner[nodes_class(mesh, at)] == tile ? count++ : -1;
    }
    return (size_t)count;
}

/* Counts of all tiles of a level, each found by the rank that holds the tile. */
static void nodes_count(struct nodes *nodes, const struct mesh *mesh, int l)
{
    const struct level *level = &mesh->levels[l];
    double *own = mem_new(level->n_local + 1, sizeof *own), *all = mem_new(level->n_tile, sizeof *all);
    for (unsigned i = 0; i < level->n_local; i++)
        own[i] = (double)nodes_own(nodes, mesh, level, level->first + i, nodes->number);
    comm_join(own, (int)level->n_local, all);
    nodes->first[l] = mem_new((size_t)level->n_tile + 1, sizeof *nodes->first[l]);
    for (unsigned tile = 0; tile < level->n_tile; tile++) {
        nodes->first[l][tile] = nodes->total;
        nodes->total += (size_t)all[tile];
    }
    nodes->first[l][level->n_tile] = nodes->total;
    mem_free(all);
    mem_free(own);
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
    for (int level = 0; level < mesh->n_level; level++) nodes_count(nodes, mesh, level);
    return nodes;
}

void nodes_free(struct nodes *nodes)
{
    if (!nodes) return;
    for (int level = 0; level < MESH_LEVELS; level++) mem_free(nodes->first[level]);
    mem_free(nodes->number);
    mem_free(nodes);
}

/* Gives the points whose owner is `owner` their numbers, seen from `tile`. */
static void nodes_take(struct nodes *nodes, const struct mesh *mesh, int l, unsigned tile, unsigned owner,
                       const unsigned owners[NODES_CLASSES], int32_t *ret_numbers)
{
    const struct level *level = &mesh->levels[l];
    const int *here = level->tiles[tile].at, *there = level->tiles[owner].at;
    nodes_own(nodes, mesh, level, owner, nodes->number);
    for (size_t point = 0; point < nodes->n_point; point++) {
        int at[3];
        nodes_at(nodes, point, at);
        if (owners[nodes_class(mesh, at)] != owner) continue;
        for (int axis = 0; axis < 3; axis++) at[axis] += (here[axis] - there[axis]) * mesh->n[axis];
        int place = at[0] + nodes->n[0] * (at[1] + nodes->n[1] * at[2]);
        ret_numbers[point] = (int32_t)nodes->first[l][owner] + nodes->number[place];
    }
}

void nodes_of_tile(struct nodes *nodes, const struct mesh *mesh, int level, unsigned tile, int32_t *ret_numbers)
{
    unsigned owners[NODES_CLASSES];
    nodes_owners(mesh, &mesh->levels[level], tile, owners);
    for (int kind = 0; kind < NODES_CLASSES; kind++) {
        bool done = false;
        for (int before = 0; before < kind; before++) done = done || owners[before] == owners[kind];
        if (!done) nodes_take(nodes, mesh, level, tile, owners[kind], owners, ret_numbers);
    }
}

size_t nodes_positions(struct nodes *nodes, const struct mesh *mesh, int level, unsigned tile, double (*ret_x)[3])
{
    const struct level *here = &mesh->levels[level];
    size_t count = 0;
    nodes_own(nodes, mesh, here, tile, nodes->number);
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
