/* traffic.c - see traffic.h. The tiles of a rank follow each other in every level, so that its peers can be counted
 * with one mark per rank and no sorting. */
#include "traffic.h"

#include "base/mem.h"
#include "mesh/level.h"
#include "mesh/morton.h"

#include <string.h>

/* One post of all ranks: bytes and messages of each, and who was last seen as peer of whom. */
struct traffic_post {
    int size;
    double *in, *out, *node_in, *node_out;
    int *in_messages, *out_messages, *seen;
};

static struct traffic_post traffic_open(int size)
{
    size_t n = (size_t)size;
    struct traffic_post post = {.size = size, .in = mem_new(n, sizeof(double)), .out = mem_new(n, sizeof(double))};
    post.node_in = mem_new(n / TRAFFIC_NODE + 1, sizeof(double));
    post.node_out = mem_new(n / TRAFFIC_NODE + 1, sizeof(double));
    post.in_messages = mem_new(n, sizeof(int));
    post.out_messages = mem_new(n, sizeof(int));
    post.seen = mem_new(n, sizeof(int));
    return post;
}

/* `to` receives from `from`; all calls for one `to` follow each other. */
static void traffic_send(struct traffic_post *post, int from, int to, double bytes)
{
    if (from == to) return;
    post->in[to] += bytes;
    post->out[from] += bytes;
    if (from / TRAFFIC_NODE != to / TRAFFIC_NODE) {
        post->node_in[to / TRAFFIC_NODE] += bytes;
        post->node_out[from / TRAFFIC_NODE] += bytes;
    }
    if (post->seen[from] == to + 1) return;
    post->seen[from] = to + 1;
    post->in_messages[to]++;
    post->out_messages[from]++;
}

static double traffic_larger(double a, double b)
{
    return a > b ? a : b;
}

static struct traffic_phase traffic_close(struct traffic_post *post)
{
    struct traffic_phase phase = {0};
    for (int rank = 0; rank < post->size; rank++) {
        phase.most_bytes = traffic_larger(phase.most_bytes, traffic_larger(post->in[rank], post->out[rank]));
        phase.bytes += post->out[rank];
        phase.most_messages = traffic_larger(phase.most_messages, post->in_messages[rank]);
        phase.most_messages = traffic_larger(phase.most_messages, post->out_messages[rank]);
    }
    for (int node = 0; node <= (post->size - 1) / TRAFFIC_NODE; node++)
        phase.node_bytes = traffic_larger(phase.node_bytes, traffic_larger(post->node_in[node], post->node_out[node]));
    mem_free(post->node_in);
    mem_free(post->node_out);
    mem_free(post->in);
    mem_free(post->out);
    mem_free(post->in_messages);
    mem_free(post->out_messages);
    mem_free(post->seen);
    return phase;
}

struct traffic_graph traffic_connect(const struct mesh *mesh, int l)
{
    const struct level *level = &mesh->levels[l], *coarse = l ? level - 1 : NULL;
    unsigned faces = 2 * (unsigned)mesh->dim;
    struct traffic_graph graph = {.behind = mem_new((size_t)level->n_tile * faces, sizeof *graph.behind)};
    if (coarse) graph.above = mem_new(level->n_tile, sizeof *graph.above);
    for (unsigned i = 0; i < level->n_tile; i++) {
        if (coarse) graph.above[i] = level_find(coarse, level->tiles[i].key >> 3);
        for (unsigned face = 0; face < faces; face++) {
            int at[3], *behind = &graph.behind[i * faces + face];
            *behind = -1;
            if (!level_step(mesh, level, &level->tiles[i], (int)face, at)) continue;
            uint64_t key = morton_key(at);
            *behind = level_find(level, key);
            if (*behind < 0) *behind = -2 - level_find(coarse, key >> 3);
        }
    }
    return graph;
}

void traffic_free_graph(struct traffic_graph *graph)
{
    mem_free(graph->behind);
    mem_free(graph->above);
    *graph = (struct traffic_graph){0};
}

static void traffic_load(const struct level *level, const double *costs, int size, double *ret_mean, double *ret_most)
{
    double load = 0.0, total = 0.0;
    *ret_most = 0.0;
    for (unsigned i = 0; i < level->n_tile; i++) {
        load = i && level->tiles[i - 1].rank == level->tiles[i].rank ? load + costs[i] : costs[i];
        total += costs[i];
        *ret_most = traffic_larger(*ret_most, load);
    }
    *ret_mean = total / size;
}

/* Bytes of what travels between tiles. */
struct traffic_sizes {
    double slab, flux, average;
};

static struct traffic_sizes traffic_sizes(const struct mesh *mesh)
{
    double field = 8.0 * mesh->n_field, face = (double)mesh->n_cell / mesh->n[0], octants = 1 << mesh->dim;
    return (struct traffic_sizes){.slab = mesh->ghosts * face * field,
                                  .flux = 8.0 * (mesh->n_field + 1) * face / (octants / 2.0),
                                  .average = (double)mesh->n_cell / octants * field};
}

/* What lies behind the faces of the tiles of a level; registers travel the other way: the same pairs and sums. */
static void traffic_faces(const struct mesh *mesh, const struct traffic_graph *graph, int l, int size,
                          struct traffic *traffic, struct traffic_post *up, struct traffic_post *eager)
{
    const struct level *level = &mesh->levels[l];
    struct traffic_sizes sizes = traffic_sizes(mesh);
    struct traffic_post halo = traffic_open(size), down = traffic_open(size);
    int faces = 2 * mesh->dim;
    for (unsigned i = 0; i < level->n_tile; i++) {
        int rank = level->tiles[i].rank;
        const int *behind = &graph->behind[i * (unsigned)faces];
        for (int f = 0; f < faces; f++)
            if (behind[f] >= 0) traffic_send(&halo, level->tiles[behind[f]].rank, rank, sizes.slab);
            else if (behind[f] < -1) {
                int coarse = level[-1].tiles[-2 - behind[f]].rank;
                traffic_send(&down, coarse, rank, 2.0 * sizes.slab);
                traffic_send(up, coarse, rank, sizes.flux);
                traffic_send(eager, coarse, rank, sizes.flux);
            }
        if (!l) continue;
        const struct tile *parent = &level[-1].tiles[graph->above[i]];
        if (!parent->sleeps) traffic_send(up, parent->rank, rank, sizes.average);
        traffic_send(eager, parent->rank, rank, sizes.average);
    }
    traffic->halo[l] = traffic_close(&halo);
    traffic->down[l] = traffic_close(&down);
}

/* Averages over tiles of the level below l that sleep so deep. */
static struct traffic_phase traffic_late(const struct mesh *mesh, const struct traffic_graph *graph, int l, int size,
                                         int depth)
{
    const struct level *level = &mesh->levels[l];
    double average = traffic_sizes(mesh).average;
    struct traffic_post late = traffic_open(size);
    for (unsigned i = 0; i < level->n_tile; i++) {
        const struct tile *parent = &level[-1].tiles[graph->above[i]];
        if (parent->sleeps == depth) traffic_send(&late, parent->rank, level->tiles[i].rank, average);
    }
    return traffic_close(&late);
}

static double traffic_deep(const struct level *level)
{
    unsigned deep = 0;
    for (unsigned i = 0; i < level->n_tile; i++) deep += level->tiles[i].sleeps > 0;
    return (double)deep / level->n_tile;
}

static double traffic_remote(const struct mesh *mesh, const struct traffic_graph *graphs)
{
    double tiles = 0.0, remote = 0.0;
    for (int l = 1; l < mesh->n_level; l++) {
        const struct level *level = &mesh->levels[l];
        for (unsigned i = 0; i < level->n_tile; i++)
            remote += level[-1].tiles[graphs[l].above[i]].rank != level->tiles[i].rank;
        tiles += level->n_tile;
    }
    return tiles > 0.0 ? remote / tiles : 0.0;
}

void traffic_count(const struct mesh *mesh, const struct traffic_graph *graphs, double *const *costs, int size,
                   struct traffic *ret_traffic)
{
    *ret_traffic = (struct traffic){.remote_parents = traffic_remote(mesh, graphs)};
    for (int l = 0; l < mesh->n_level; l++) {
        const struct level *level = &mesh->levels[l];
        struct traffic_post up = traffic_open(size), eager = traffic_open(size);
        traffic_faces(mesh, &graphs[l], l, size, ret_traffic, &up, &eager);
        traffic_load(level, costs[l], size, &ret_traffic->mean[l], &ret_traffic->most[l]);
        ret_traffic->up[l] = traffic_close(&up);
        ret_traffic->eager[l] = traffic_close(&eager);
        ret_traffic->deep[l] = traffic_deep(level);
        for (int depth = 1; depth <= l; depth++)
            ret_traffic->late[l][depth] = traffic_late(mesh, &graphs[l], l, size, depth);
    }
}
