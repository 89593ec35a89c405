/* viscous_slopes.h - velocities and the colour of a tile, with the layer around it, and their slopes.
 *
 * The colour tells materials apart: with two it is the fraction of the second, else sum (l - 1)/(N - 1) alpha_l. Of each piece of
 * a sweep rows are made beside those of the frame, from one layer before the tile to one behind it; what else lies in the
 * rows counts for nothing. */
#ifndef VISCOUS_SLOPES_H
#define VISCOUS_SLOPES_H

#include "scheme/term.h"
#include "scheme/viscous_strain.h"

enum { SLOPES_COLOUR = 3, SLOPES_QUANTITIES }; /* before the colour: velocities */

struct viscous_slopes {
    const struct term_tile *tile;
    const double *data, *colour; /* over the patch; colour NULL: one material */
    size_t pitch, first, stride[3];
    double *rows, *mixed;              /* mixed: room for the colour */
    double centroid[METRIC_CELLS + 2]; /* metric_centroids, in curved geometry */
    double radius[METRIC_CELLS + 1];   /* of the faces: the lower one of cell i */
    double along[METRIC_CELLS];        /* 1/(distance of both neighbours) along axis 0, of each cell */
};

void viscous_slopes_open(const struct mesh *mesh, struct viscous_slopes *ret);
void viscous_slopes_close(struct viscous_slopes *slopes);

/* Looks at another tile, with its patch. */
void viscous_slopes_look(struct viscous_slopes *slopes, const struct term_tile *tile);

/* Fills the rows of a piece. */
void viscous_slopes_gather(struct viscous_slopes *slopes, const struct frame *frame);

/* Row of a quantity; k = 1, 2: its slopes along axis_component(axis, k). */
static inline const double *viscous_slopes_row(const struct viscous_slopes *slopes, unsigned quantity, unsigned k)
{
    return slopes->rows + (size_t)(3 * quantity + k) * FACE_ROOM;
}

/* Lines of cells along x of a tile. */
struct viscous_lines {
    size_t first, n, length; /* cells of all together: n * length */
};

/* Gradients in the cells of some lines, at most STRAIN_POINTS cells. */
void viscous_slopes_cells(const struct viscous_slopes *slopes, const struct viscous_lines *lines,
                          struct viscous_strain *ret);

#endif
