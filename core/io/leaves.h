/* leaves.h - the leaf cells of a mesh, numbered: the cells of a plot file.
 *
 * By level; in a level first the tiles of which nothing lies under finer ones, along the Morton curve, then the
 * others, of which the open octants remain, one after the other. In a tile, and in an octant, x is fastest. So a
 * block (a tile or an octant) is a box of the level, and the local ones of each kind follow each other. A rank knows
 * its own blocks, and how many there are before them and of all. */
#ifndef LEAVES_H
#define LEAVES_H

#include "mesh/mesh.h"

enum { LEAVES_WHOLE = -1, LEAVES_KINDS = 2 };

struct leaves_block {
    int level;
    unsigned tile; /* among those that this rank knows */
    int octant;    /* or LEAVES_WHOLE: all of the tile */
    size_t first;  /* number of its first cell */
};

/* Blocks of one kind (0 tiles, 1 octants) of a level, which have the same number of cells each. */
struct leaves_run {
    unsigned from, n;          /* this rank's blocks */
    size_t all, before;        /* blocks of all ranks, and of lower ones */
    size_t first, cells;       /* number of the first cell of all ranks, cells of a block */
    size_t local_first, local; /* number of the first cell on this rank, and how many there are */
};

struct leaves {
    const struct mesh *mesh;
    size_t n_cell;
    unsigned n_block;
    struct leaves_block *blocks; /* [n_block] of this rank */
    struct leaves_run runs[MESH_LEVELS][LEAVES_KINDS];
};

/* Collective. */
struct leaves *leaves_new(const struct mesh *mesh);
void leaves_free(struct leaves *leaves); /* NULL is fine */

/* Index of the block that a cell of this rank is in, and the cells of a block. */
unsigned leaves_find(const struct leaves *leaves, size_t cell);
size_t leaves_cells(const struct leaves *leaves, unsigned block);

/* Where a block begins in its tile, and how many cells it has, per axis. */
void leaves_box(const struct leaves *leaves, unsigned block, int ret_from[3], int ret_count[3]);

#endif
