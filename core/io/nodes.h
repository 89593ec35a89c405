/* nodes.h - the corners of leaf cells, numbered once: the points of a plot file.
 *
 * Tiles that touch share their corner points; if each tile brought its own, contours would break
 * at every tile. A point belongs to the first tile (level, then Morton order) that has a leaf there, and
 * points are numbered tile by tile, x fastest within a tile. All of this follows from the lists of
 * all tiles (whole.h), so that numbers do not depend on the ranks and nobody has to ask a neighbour. Coarse and fine
 * cells share the corners of the coarse ones; the others of the fine ones hang on their faces. */
#ifndef NODES_H
#define NODES_H

#include "mesh/mesh.h"

struct nodes {
    size_t total;               /* of all levels */
    size_t *first[MESH_LEVELS]; /* [n_tile + 1] number of the first point of each tile of a level */
    int n[3];                   /* points of a tile per axis, its own or not */
    size_t n_point;             /* their product */
    unsigned char *kinds;       /* [n_point] class of each point of a tile (nodes.c) */
    int32_t *number;            /* [n_point] work space */
};

/* Numbers all points. Collective. */
struct nodes *nodes_new(const struct mesh *mesh);
void nodes_free(struct nodes *nodes); /* NULL is fine */

/* The numbers of all points of a tile, x fastest; -1 where no leaf is. */
void nodes_of_tile(struct nodes *nodes, const struct mesh *mesh, int level, unsigned tile, int32_t *ret_numbers);

/* Positions [m] of the points that belong to a tile, in the order of their numbers; returns how many. */
size_t nodes_positions(struct nodes *nodes, const struct mesh *mesh, int level, unsigned tile, double (*ret_x)[3]);

#endif
