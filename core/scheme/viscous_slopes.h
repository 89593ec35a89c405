/* viscous_slopes.h - velocities and the colour of a tile, with the layer around it, and their slopes.
 *
 * The colour tells materials apart: with two it is the fraction of the second, else sum c_l alpha_l (model->colour).
 * Batches of faces or cells are cut out of the patch as blocks of rows, and slopes are taken where its values lie:
 * nothing is copied. */
#ifndef VISCOUS_SLOPES_H
#define VISCOUS_SLOPES_H

#include "scheme/term.h"
#include "scheme/viscous_strain.h"

struct viscous_slopes {
    const struct term_tile *tile;
    const double *data, *colour; /* over the patch; colour NULL: one material */
    size_t pitch, first, stride[3];
    double *mixed;                     /* room for the colour */
    double centroid[METRIC_CELLS + 2]; /* metric_centroids, in curved geometry */
    double part[METRIC_CELLS + 1]; /* of the way from one centroid to the next, where a face across the radius lies */
    double along[3][METRIC_CELLS + 1];  /* 1/(distance of both neighbours) along an axis, by the place along x */
    double across[3][METRIC_CELLS + 1]; /* 1/(distance of the two cells of a face), likewise */
};

void viscous_slopes_open(const struct mesh *mesh, struct viscous_slopes *ret);
void viscous_slopes_close(struct viscous_slopes *slopes);

/* Looks at another tile, with its patch. */
void viscous_slopes_look(struct viscous_slopes *slopes, const struct term_tile *tile);

/* Velocity d over the patch. */
static inline const double *viscous_slopes_velocity(const struct viscous_slopes *slopes, unsigned d)
{
    return slopes->data + (slopes->tile->model->n_around_alpha + d) * slopes->pitch;
}

/* Some rows of neighbouring faces of a piece, or of cells of a tile: point i of row r is point r * n + i of a batch. A
 * face is found by the cell before it. */
struct viscous_block {
    size_t rows, n;
    size_t x;                /* place along axis 0 of the first point of each row: the cell, or the face below it */
    size_t patch, patch_row; /* cell of the patch, and from a row to the next */
    size_t face, face_row;   /* the same of the face in its piece, or of the cell in its tile */
    size_t step;             /* from a cell to the next one along the axis in the patch; 0: cells */
    int axis;                /* of the faces; -1: cells */
};

/* A walk over the faces of a piece in blocks. Begins as {slopes, frame}. */
struct viscous_walk {
    const struct viscous_slopes *slopes;
    const struct frame *frame;
    size_t o, c; /* where it is */
};

/* The next block; false: there is none. Rows are no longer than STRAIN_POINTS. */
bool viscous_slopes_next(struct viscous_walk *walk, struct viscous_block *ret);

/* Takes so many first rows off a block. */
void viscous_slopes_part(struct viscous_block *rest, size_t rows, struct viscous_block *ret);

/* Takes the first rows off a block, of at most STRAIN_POINTS points; false: there are none left. */
bool viscous_slopes_batch(struct viscous_block *rest, struct viscous_block *ret);

/* Lines of cells along x of the tile, from line `first` on, at most `most`, as a block. */
struct viscous_block viscous_slopes_cells(const struct viscous_slopes *slopes, size_t first, size_t most);

/* Gradients and strain at the points of a block of at most STRAIN_POINTS. */
void viscous_slopes_strain(const struct viscous_slopes *slopes, const struct viscous_block *block,
                           struct viscous_strain *ret);

/* Velocity d at the faces of a block: the mean of both cells; across the radius by the distances of centroids. */
void viscous_slopes_speed(const struct viscous_slopes *slopes, const struct viscous_block *block, unsigned d,
                          double *ret);

#endif
