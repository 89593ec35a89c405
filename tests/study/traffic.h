/* traffic.h - what a partition costs: load of each rank and level, and the messages that follow from it.
 *
 * Counted as the mesh sends them: per stage a slab of the mesh's ghosts for every face to a remote tile of the same
 * level (halo.h); per step of the coarser level two strips for every coarse-fine face whose coarse tile is remote,
 * its register back, and the average of every tile whose parent is remote (link.h), or, of parents that sleep, whenever
 * they are woken (solve/wake.h). */
#ifndef TRAFFIC_H
#define TRAFFIC_H

#include "mesh/mesh.h"

/* Who is behind each face, and above each tile: made once per mesh. */
struct traffic_graph {
    int *behind; /* [n_tile][2 dim] tile of the level; -1: boundary; -2 - c: tile c of the coarser level */
    int *above;  /* [n_tile] tile of the coarser level; NULL on level 0 */
};

enum { TRAFFIC_NODE = 64 }; /* ranks that share a node and its link */

/* One phase of one level: the most loaded rank's and node's figures, and the sum over ranks. */
struct traffic_phase {
    double most_bytes, bytes; /* per exchange: larger of in and out; all sent */
    double node_bytes;        /* of the most loaded node, to and from other nodes */
    double most_messages;
};

struct traffic {
    double mean[MESH_LEVELS], most[MESH_LEVELS]; /* cost per step of the level: mean and largest of the ranks */
    struct traffic_phase halo[MESH_LEVELS];      /* per stage of level l */
    struct traffic_phase down[MESH_LEVELS], up[MESH_LEVELS]; /* between l - 1 and l, per step of l - 1 */
    struct traffic_phase eager[MESH_LEVELS];                 /* the same as `up` if no tile slept */
    struct traffic_phase late[MESH_LEVELS][MESH_LEVELS + 1]; /* tiles of l - 1 that sleep, by depth: when they wake */
    double remote_parents;                                   /* share of tiles of the levels above 0 */
    double deep[MESH_LEVELS];                                /* share of the tiles of a level that sleep */
};

struct traffic_graph traffic_connect(const struct mesh *mesh, int l);
void traffic_free_graph(struct traffic_graph *graph);

/* Of the owners that the tiles have. costs[l]: of the tiles of level l. */
void traffic_count(const struct mesh *mesh, const struct traffic_graph *graphs, double *const *costs, int size,
                   struct traffic *ret_traffic);

#endif
