/* mesh.h - the mesh as data: levels of equal tiles, and where each tile's numbers live.
 *
 * A level is a set of tiles of n^d cells (n the same everywhere), sorted along the Morton
 * curve. The list is replicated on all ranks; the curve is cut into one contiguous piece per
 * rank, so the local tiles of a level are tiles[first .. first + n_local). Arrays are always
 * 3D: extents beyond `dim` are 1. Tiles store no ghosts; primitives of neighbours are gathered
 * into a frame when needed (phys/frame.h), remote ones come through mesh/halo.h.
 *
 * Level 0 covers the domain. Finer levels (ratio 2) will lie above it in the same array. */
#ifndef MESH_H
#define MESH_H

#include "case/scene.h"

#include <stddef.h>
#include <stdint.h>

enum { MESH_LEVELS = 16, MESH_FACES = 6, MESH_GHOST = 2 };

struct tile {
    uint64_t key; /* Morton key of `at` */
    int at[3];    /* tile coordinates; cell (i, j, k) of the tile is cell at * n + (i, j, k) of the level */
    int rank;
};

/* What lies behind face 2 * axis + side of a local tile. */
struct neighbour {
    enum { NEIGHBOUR_LOCAL, NEIGHBOUR_REMOTE, NEIGHBOUR_BOUNDARY } kind;
    unsigned index; /* LOCAL: local tile; REMOTE: slab of the halo; BOUNDARY: unused */
};

struct halo;

struct level {
    double h[3];   /* cell size [m]; 1 beyond dim */
    int extent[3]; /* tiles per axis */
    unsigned n_tile, first, n_local;
    struct tile *tiles;                         /* [n_tile], replicated, Morton order */
    struct neighbour (*neighbours)[MESH_FACES]; /* [n_local] */
    double **u_old, **u_new; /* [n_local] conserved at t^n and the one being made: [n_field][n^d], 64-byte aligned */
    double **w;              /* [n_local] primitives of the last completed stage: [n_prim][n^d] */
    struct halo *halo;
};

struct mesh {
    int dim, beta; /* beta: 0 cartesian, 1 axisymmetric, 2 spherical */
    double lower[3], upper[3];
    int n[3];         /* cells of a tile per axis: n, or 1 beyond dim */
    size_t n_cell;    /* cells of a tile */
    unsigned n_field; /* evolved fields */
    int n_level;
    struct level levels[MESH_LEVELS];
    bool periodic[3];
};

/* Builds level 0 for a scene with `n_field` evolved fields (as many primitives): chooses the
 * tile size if the case does not, partitions over the ranks, allocates. A cell count that no
 * tile divides is STATUS_CASE with a suggestion. Collective. */
int mesh_new(const struct scene *scene, unsigned n_field, struct mesh **ret_mesh);
void mesh_free(struct mesh *mesh);

/* The tile size that mesh_new would use, or 0 with a recorded message. */
int mesh_tile_size(const struct scene *scene);

/* Lower corner of a tile [m]. */
void mesh_corner(const struct mesh *mesh, const struct level *level, const struct tile *tile, double ret_corner[3]);

/* The tile of a level at tile coordinates, or -1. Periodic axes wrap. */
int mesh_find(const struct mesh *mesh, const struct level *level, const int at[3]);

/* Swaps u_old and u_new of a level. */
void mesh_swap(struct level *level);

#endif
