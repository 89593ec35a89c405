/* mesh.h - the mesh as data: levels of equal tiles, and where each tile's numbers live.
 *
 * A level is a set of tiles of n^d cells (n the same everywhere), sorted along the Morton
 * curve, which is cut into one contiguous piece per rank, ranks ascending. A rank knows its own piece, what lies
 * around it on its level and the two next to it (mesh/fringe.h), and the first key of every rank, no more.
 * Arrays are always 3D: extents beyond `dim` are 1. Tiles store no ghosts; primitives of
 * neighbours are gathered into a frame when needed (scheme/frame.h), remote ones come through
 * mesh/halo.h, those of the next coarser level through mesh/link.h.
 *
 * Level 0 covers the domain. A tile of level l + 1 at b lies under exactly one octant of (n/2)^d
 * cells of the tile b >> 1 of level l; the coarse cells under it stay allocated. Levels nest: the
 * 3^d octants around every fine tile lie in tiles of the coarser level or outside the domain, so
 * that what a tile's ghost layers need exists on the next coarser level at the latest
 * (Berger & Colella 1989, J. Comput. Phys. 82, 64, on fixed tiles).
 *
 * This folder, mesh: tiles and levels, who owns which, geometry, and messages between ranks. No physics. */
#ifndef MESH_H
#define MESH_H

#include "base/slots.h"
#include "case/scene.h"

#include <stddef.h>
#include <stdint.h>

enum { MESH_LEVELS = 16, MESH_FACES = 6, MESH_OCTANTS = 8 };

struct tile {
    uint64_t key; /* Morton key of `at` */
    int at[3];    /* tile coordinates; cell (i, j, k) of the tile is cell at * n + (i, j, k) of the level */
    int rank;
    unsigned char covered;  /* bit o: octant o = ox + 2 oy + 4 oz lies under a tile of the next level (right for the own
                               tiles and those around them) */
    unsigned char unwanted; /* regrids in a row that found no use for the tile: its owner knows */
    bool born;              /* made by the last change of its level: see mesh_change */
    bool hidden;            /* wholly covered, and so are its neighbours: nobody reads its cells between averages of the
                               finer level, so they are not advanced; its owner knows */
    unsigned char sleeps; /* s > 0: hidden, and its averages are not looked at after each of its steps, but after those
                             of s levels below (mesh/doze.h); its owner knows, and those of the tiles that cover it */
};

/* What lies behind face 2 * axis + side of a local tile. */
struct neighbour {
    enum { NEIGHBOUR_LOCAL, NEIGHBOUR_REMOTE, NEIGHBOUR_BOUNDARY, NEIGHBOUR_COARSE } kind;
    unsigned index; /* LOCAL: local tile; REMOTE: slab of the halo; COARSE: face of the link; BOUNDARY: unused */
};

struct halo;
struct link;
struct pool;
struct rigid;
struct rim;

struct level {
    double h[3];     /* cell size [m]; 1 beyond dim */
    int extent[3];   /* tiles per axis if the level covered the domain */
    unsigned n_tile; /* of all ranks */
    unsigned n_known, first, n_local;
    struct tile *tiles; /* [n_known] that this rank knows, Morton order; its own: tiles[first .. first + n_local) */
    int n_rank;
    uint64_t *first_keys;                       /* [n_rank] of each rank's piece (mesh/span.h) */
    struct slots slots;                         /* for mesh_find: local tiles by their keys */
    struct neighbour (*neighbours)[MESH_FACES]; /* [n_local] */
    double **u_old, **u_new; /* [n_local] conserved at t^n and the one being made: [n_field][n^d], 64-byte aligned */
    double **w;              /* [n_local] primitives of the last completed stage: [n_prim][n^d] */
    double **kept; /* [n_local] what outputs keep from step to step (solve/peak.h): [n_kept][n^d], NaN in tiles
                                that are new here; NULL where they keep nothing */
    struct halo *halo;
    struct link *link; /* to the next coarser level; NULL on level 0 */
    bool stale;        /* tiles that sleep do not hold what covers them (solve/wake.h); the same on all ranks */
};

struct mesh {
    int dim, beta; /* beta: 0 cartesian, 1 axisymmetric, 2 spherical */
    double lower[3], upper[3];
    int n[3];          /* cells of a tile per axis: n, or 1 beyond dim */
    size_t n_cell;     /* cells of a tile */
    int ghosts;        /* layers of neighbours that a sweep needs on each side of a tile: 2 or 3; at most n, and n / 2
                          where tiles are refined */
    unsigned n_field;  /* evolved fields */
    unsigned turns;    /* that which counts with a lever (metric.h); UINT_MAX: none */
    unsigned n_alpha;  /* volume fractions among them (the first), for the sizes of registers */
    unsigned n_face_u; /* components of the face velocity that registers keep: all with a solid, the normal one with
                          fractions, else none */
    bool corners;      /* a term looks across edges and corners: neighbours there count (level_cover) */
    bool sleepless;    /* no tile sleeps (mesh/doze.h): super steps look at all of them */
    unsigned n_kept;   /* rows that outputs keep per cell */
    int n_level;       /* levels in use: none of them is empty */
    int most_level;    /* finest level the case allows */
    unsigned revision; /* counts changes of any level's tiles or owners (mesh_replace): who keeps something per
                          tile makes it anew when this has moved */
    struct level levels[MESH_LEVELS];
    struct pool *pool;      /* where blocks of tiles come from */
    struct pool *kept_pool; /* where those of `kept` come from; NULL without */
    struct rim **rims;      /* by level: what terms that need edges and corners have asked for (mesh/rim.h) */
    bool periodic[3];
    struct rigid *rigid; /* what bodies leave of the cells (mesh/rigid.h); NULL without bodies */
};

/* Builds level 0 for a scene with `n_field` evolved fields (as many primitives), `n_alpha` of them volume
 * fractions: chooses the tile size if the case does not, partitions over the ranks, allocates. A cell count
 * that no tile divides is STATUS_CASE with a suggestion. Collective. */
int mesh_new(const struct scene *scene, unsigned n_field, unsigned n_alpha, struct mesh **ret_mesh);
void mesh_free(struct mesh *mesh);

/* The tile size that mesh_new would use, or 0 with a recorded message. */
int mesh_tile_size(const struct scene *scene);

/* What a level is to become: each rank tells it for its own tiles. */
struct mesh_set {
    unsigned n_tile;      /* of all ranks; 0: the level goes */
    unsigned n;           /* this rank's */
    struct tile *tiles;   /* [n] sorted; key, at and unwanted are set */
    int *from;            /* [n] the rank that a tile comes from; -1: it was on none */
    int *to;              /* [n_local of the level as it is] the rank that a tile goes to; -1: it ends */
    uint64_t *first_keys; /* [ranks] where their pieces will begin (mesh/span.h) */
};

/* What mesh_replace did with the tiles of a level. */
struct mesh_change {
    int *from;         /* [n_local] of the new level: local index the tile had before on this rank, or -1: new here */
    bool *born;        /* [n_known] of the new level: the tile did not exist on any rank, its blocks hold nothing yet */
    unsigned n_before; /* local tiles before */
};

/* Gives the levels `lowest` to `highest` the sets sets[l] (taken over; levels that are not there yet follow those that
 * are). Tiles that stay on a rank keep their blocks, tiles that move bring u_old, w and kept along, born ones get
 * blocks for the caller to fill. Levels without tiles go; none may be left above them. Neighbours, halo and links of
 * these levels, the link of the next finer one, and flags of all and of the next coarser one are made anew; a link is
 * NULL as long as its level does not nest (then that one must be replaced next). Level 0 may be given its own tiles
 * with other ranks. Collective; ret_changes[l] are freed by mesh_change_free. */
void mesh_replace(struct mesh *mesh, int lowest, int highest, struct mesh_set *sets, struct mesh_change *ret_changes);
void mesh_change_free(struct mesh_change *change);

/* Lower corner of a tile [m]. */
void mesh_corner(const struct mesh *mesh, const struct level *level, const struct tile *tile, double ret_corner[3]);

/* The tile of a level at tile coordinates, if this rank knows it, or -1. Periodic axes wrap. */
int mesh_find(const struct mesh *mesh, const struct level *level, const int at[3]);

/* Is the leaf that holds the point x (in the domain; upper faces belong to the last tile) on this rank? Then its level,
 * local tile and cell. */
bool mesh_locate(const struct mesh *mesh, const double x[3], int *ret_level, unsigned *ret_local, size_t *ret_cell);

/* Which cells of a tile are leaves: ret_leaf[n_cell], 0 under finer tiles and 1 elsewhere. */
void mesh_leaves(const struct mesh *mesh, const struct tile *tile, double *ret_leaf);

/* Octant of a tile that a cell lies in. */
int mesh_octant(const struct mesh *mesh, size_t cell);

/* Swaps u_old and u_new of a level. */
void mesh_swap(struct level *level);

/* Bytes that the blocks of `n_tile` tiles take (three each, and what outputs keep). */
double mesh_bytes(const struct mesh *mesh, double n_tile);

#endif
