/* contour.h - level lines of cell-centred data on cells of different sizes.
 *
 * The lines live on the dual mesh: the polygons that join the centres of the three or four
 * cells around each mesh vertex. On a mesh whose neighbours differ by at most one level these
 * polygons tile the plane without gaps, so lines cross level jumps without seams and linear
 * data give exact lines. At the outer edge a row of mirrored values extends the lines to it. */
#ifndef CONTOUR_H
#define CONTOUR_H

#include "view/raster.h"

struct contour_line {
    size_t n;
    double (*at)[2]; /* [n] points */
    double length;
};

struct contour {
    size_t n_line;
    struct contour_line *lines;
};

/* Lines where `values` (one per cell) crosses `level`, joined end to end. Cells need not have
 * any order but must come from a lattice that is halved or doubled from level to level. */
void contour_find(size_t n, const struct raster_cell *cells, const double *values, double level,
                  struct contour *ret_contour);

/* Length of all lines. */
double contour_length(const struct contour *contour);

void contour_done(struct contour *contour);

#endif
