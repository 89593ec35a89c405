/* nodes.h - the corners of leaf cells, numbered once: the points of a plot file.
 *
 * Tiles that touch share their corner points; if each tile brought its own, contours would break
 * at every tile. A point belongs to the first tile (level, then Morton order) that has a leaf there, and
 * points are numbered tile by tile, x fastest within a tile: numbers do not depend on the ranks. Each rank finds
 * which points its tiles own, learns how many there are before them, and tells both to those that know the tile
 * (mesh/fringe.h); so nobody holds a list of all. Coarse and fine cells share the corners of the coarse ones; the
 * others of the fine ones hang on their faces. */
#ifndef NODES_H
#define NODES_H

#include "mesh/mesh.h"

enum { NODES_WORDS = 4 };

/* The points that belong to a tile. */
struct nodes_tile {
    size_t first, n;             /* number of the first one, how many */
    uint64_t kinds[NODES_WORDS]; /* bit k: those of class k (nodes.c) */
};

struct nodes {
    size_t total;                          /* of all levels and ranks */
    size_t first[MESH_LEVELS];             /* number of the first point of this rank's tiles of a level */
    size_t own[MESH_LEVELS];               /* points of these */
    struct nodes_tile *tiles[MESH_LEVELS]; /* [n_known] */
    int n[3];                              /* points of a tile per axis, its own or not */
    size_t n_point;                        /* their product */
    unsigned char *kinds;                  /* [n_point] class of each point of a tile */
    int32_t *number;                       /* [n_point] work space */
};

/* Numbers all points. Collective. */
struct nodes *nodes_new(const struct mesh *mesh);
void nodes_free(struct nodes *nodes); /* NULL is fine */

/* The numbers of all points of an own tile, x fastest; -1 where no leaf is. */
void nodes_of_tile(struct nodes *nodes, const struct mesh *mesh, int level, unsigned tile, int32_t *ret_numbers);

/* Positions [m] of the points that belong to an own tile, in the order of their numbers; returns how many. */
size_t nodes_positions(struct nodes *nodes, const struct mesh *mesh, int level, unsigned tile, double (*ret_x)[3]);

#endif
