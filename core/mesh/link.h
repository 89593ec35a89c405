/* link.h - what a level and the next coarser one tell each other: ghosts down, averages and fluxes up.
 *
 * Down: for every face of a fine tile that no fine tile covers, a strip of fine ghost primitives,
 * [n_field][outer][layers][inner] like a slab of the halo, at the beginning and at the end of a step of the
 * coarse level. Its layers are those of whole coarse cells: as many as the mesh's ghosts, or one more. The owner of the
 * coarse tile behind the face makes it (levels/prolong.h), so that only finished ghosts travel. A face looks at exactly
 * one octant of one coarse tile. Up: per such face the sum over fine steps and sub-faces of the fluxes (the register),
 * and per fine tile its average on the octant above; of tiles that sleep (mesh/doze.h) on demand. Where both tiles are
 * on one rank the two ends share memory. */
#ifndef LINK_H
#define LINK_H

#include "mesh/mesh.h"

#include <stdbool.h>

/* One end of a coarse-fine face. */
struct link_face {
    uint64_t key;          /* of the fine tile */
    unsigned fine, coarse; /* local tiles; an end that is on another rank: at least n_local */
    int face;              /* 2 * axis + side of the fine tile */
    int layer;             /* along the axis: the layer of coarse cells next to the face, in the coarse tile */
    int from[3];           /* first cell of the patch that strips are made from, in the coarse tile: link_depth cells
                              along the axis, `layer` among them, n/2 along the other axes */
    double *strip[2]; /* [n_field][outer][2 link_depth][inner]: at the beginning and at the end of the coarse step */
    double *flux;     /* register: [n_register][(n/2)^(d-1)], lower axes fastest: sum of dt times mean flux */
};

/* A fine tile and the octant under which it lies. */
struct link_child {
    unsigned fine, coarse; /* as above */
    int octant;
    unsigned char sleeps; /* of the coarse tile: above 0 its averages do not travel with the registers */
    double *average;      /* [n_field][(n/2)^d]: of the fine tile, x fastest; NULL where both tiles are local */
};

struct link {
    int fine_level;
    unsigned n_register; /* components of a register: the fields; u_n where there are fractions or a solid; with a
                            solid the velocities along the face too, in the order of the axes */
    size_t face_cells;   /* (n/2)^(d-1) */
    size_t strip_doubles, octant_cells;
    double theta; /* where between the two strips the fine level stands: set before each of its stages */
    /* of local fine tiles: neighbours[t][face].index counts these */
    unsigned n_face;
    struct link_face *faces;
    /* of local coarse tiles, sorted by (coarse tile, fine tile, face); those of local coarse tile c are
     * sources[source_from[c] .. source_from[c + 1]) */
    unsigned n_source, *source_from;
    struct link_face *sources;
    unsigned n_child; /* of local fine tiles, in their order */
    struct link_child *children;
    unsigned n_octant, *octant_from; /* of local coarse tiles, sorted by (coarse tile, octant); as source_from */
    struct link_child *octants;
    bool *waits; /* of local coarse tiles: averages or registers of theirs come from other ranks in each step */
    void *own;
};

/* Coarse cells along the axis that the ghosts behind a coarse-fine face lie in. */
static inline int link_depth(const struct mesh *mesh)
{
    return (mesh->ghosts + 1) / 2;
}

/* The link between fine_level and fine_level - 1, both with tiles and with their neighbours and covered flags made;
 * NULL if a local fine tile lies in no coarse tile or looks at none. Not collective. */
struct link *link_new(const struct mesh *mesh, int fine_level);
void link_free(struct link *link);

/* Strips to the owners of the fine tiles, after both have been written through `sources`. Collective. */
void link_down(struct link *link);

/* Registers and averages to the owners of the coarse tiles, after they have been written through `faces` and
 * `children`; registers are then read through `sources`, averages through `octants`. Those of tiles that sleep stay
 * behind. Collective. */
void link_up(struct link *link);

/* The same in two parts. Between them registers and averages of coarse tiles that do not wait (`waits`) may be read
 * already, and nothing of `faces` and `children` may be written. */
void link_up_start(struct link *link);
void link_up_finish(struct link *link);

/* The averages of the coarse tiles that sleep `depth` levels deep, from 1 to fine_level. Collective. */
void link_up_late(struct link *link, int depth);

#endif
