/* seam.h - cells in which a solid meets another material, and solids that slide there along the surface.
 *
 * Few cells do: they are gathered into rows, their stretches turned into the frame of the surface, n first, where
 * elastic_sides() knows tractions and stiffness of any law. weld.h and slip.h say which cells, and by how much each
 * solid slides there. */
#ifndef SEAM_H
#define SEAM_H

#include "scheme/term.h"

enum { SEAM_BATCH = 64, SEAM_LOOK = 512 }; /* cells that are worked on, and looked at, together */

/* Shears below this are round-off, and leave bits as they are. */
#define SEAM_NOTHING 1e-14

/* Cells of a tile. By solid: in the order of model->solids. */
struct seam {
    const struct model *model;
    size_t n;
    unsigned cell[SEAM_BATCH];
    double part[SEAM_BATCH];        /* of the way that solids slide */
    double steep[SEAM_BATCH];       /* area of the surface per volume [1/m] */
    double frame[3][3][SEAM_BATCH]; /* n and two tangents */
    double alpha[SCENE_MATERIALS][SEAM_BATCH], m[SCENE_MATERIALS][SEAM_BATCH]; /* by solid; m as far as it bears */
    double V[6 * MODEL_STRETCHES][SEAM_BATCH];                                 /* in the frame of the surface */
    double t[2][SCENE_MATERIALS][SEAM_BATCH]; /* shear traction along each tangent, per own volume */
    double k[SCENE_MATERIALS][SEAM_BATCH];    /* stiffness against shear along n, per own volume; 0: bears none */
    double a[2][SCENE_MATERIALS][SEAM_BATCH]; /* what the solids are to slide by */
};

/* What a term does at seams. */
struct seam_work {
    /* Of n cells from cell `from` on those in which a solid meets what the term is for: at[count]. Returns the count.
     */
    size_t (*pick)(const struct term_tile *tile, const double *u, size_t from, size_t n, unsigned *at);
    /* One of them comes into the batch (seam_add), or has no surface. */
    void (*look)(struct seam *seam, const struct term_tile *tile, const double *u, unsigned cell);
    /* Sets a[2][n_solid] of the batch, with t, k, alpha, m and part. */
    void (*slide)(struct seam *seam, const struct term_tile *tile);
};

/* For a term's `open`; mem_free closes it. */
void *seam_open(const struct term_room *room);

/* For its `apply`: V <- polar((1 + a n^T) V) of the solids of all its cells; those that slide nowhere keep their bits.
 * tile->own is from seam_open. */
void seam_apply(const struct seam_work *work, const struct term_tile *tile, double *u);

/* Counts solid s in those of n cells from cell `from` on that hold it: there[n]. */
void seam_count(const struct term_tile *tile, unsigned s, const double *u, size_t from, size_t n, unsigned char *there);

/* g: steps of sum weight[s] alpha_s from cell to cell, along each axis, from the gradients that strain.h has taken. */
void seam_gradient(const struct term_tile *tile, size_t cell, const double *weight, double g[3]);

/* Takes a cell into the batch, which has room; its normal lies along g. Returns how much it has of a surface, up to 1,
 * which is its part at first; 0 if it has none: then it is left out. */
double seam_add(struct seam *seam, const struct term_tile *tile, unsigned cell, const double g[3]);

#endif
