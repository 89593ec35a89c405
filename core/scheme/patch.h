/* patch.h - a tile with g layers all around it, edges and corners included, gathered for terms that need them.
 *
 * [n_field][n_z + 2g][n_y + 2g][n_x + 2g], g = 1 to 3 (no layers along axes that are not used). Frames (frame.h)
 * are enough for what looks along one axis at a time; tangential gradients at faces and normals at corners look
 * across edges. Fields may be any numbers per cell, primitives (patch_state.h) or what a term made of them. Pieces of
 * neighbours come as they are, from ranks and from the coarser level (mesh/rim.h). What lies behind boundaries is
 * made here out of what is inside: mirrors and copies act on one axis after the other and do not mind in which order,
 * so that corners behind two boundaries are mirrors of mirrors, and the exchange of x and y keeps all bits. Where all
 * boundaries behind which a corner lies are given, the mean of the nearest given values stands there. */
#ifndef PATCH_H
#define PATCH_H

#include "mesh/rim.h"

#include <stdbool.h>

/* What stands behind a boundary of the domain. */
enum patch_rule {
    PATCH_COPY,    /* the cell inside, in all layers */
    PATCH_MIRROR,  /* the cells inside in reverse order; vectors and tensors turned as `parity` says */
    PATCH_NO_SLIP, /* the same, but velocities (PATCH_VELOCITY) turned round, nothing else */
    PATCH_GIVEN    /* what `given` writes */
};

/* Parity of a field: in which axes a mirror changes its sign. 0: a scalar; of u_y: PATCH_Y | PATCH_VELOCITY; of the
 * component xy of a tensor: PATCH_X | PATCH_Y. */
enum { PATCH_X = 1, PATCH_Y = 2, PATCH_Z = 4, PATCH_VELOCITY = 8 };

/* What is gathered. */
struct patch_source {
    const struct mesh *mesh;
    const struct level *level;
    double *const *arrays; /* [n_local] blocks of components, of which the rim's form names n_field */
    struct rim *rim;       /* of the level, from rim_of with the form below */
    enum patch_rule rules[MESH_FACES];
    const unsigned char *parity; /* [n_field]; NULL: scalars */
    /* [n_field]: the field that this one counts with, as a density does with its volume fraction, or -1; NULL: none.
     * Between the beginning and the end of the coarser level's step such a field is linear in time times its weight. */
    const int *weight;
    /* Writes the g layers of all fields behind face 2 * axis + side of a local tile; `data` is its own. NULL: no rule
     * is PATCH_GIVEN. */
    void (*given)(void *data, unsigned local, int face, const struct box_block *ret);
    void *data;
};

/* Bits of the faces with PATCH_GIVEN, for rim_form. */
unsigned char patch_given(const enum patch_rule rules[MESH_FACES]);

/* Sends what other ranks need, after asking `given`; patch_finish waits. Only then may patches be gathered, and on
 * levels above 0 only after the rim's pieces on the coarser level came down (levels/prolong_rim.h). Collective. */
void patch_start(const struct patch_source *source);
void patch_finish(const struct patch_source *source);

/* Gathers a local tile and all around it into w (rim_block). */
void patch_gather(const struct patch_source *source, unsigned local, double *w);

#endif
