/* contour_dual.h - which cells meet at each vertex of a mesh of cells of different sizes. */
#ifndef CONTOUR_DUAL_H
#define CONTOUR_DUAL_H

#include "view/raster.h"

#include <stdint.h>

enum { CONTOUR_DUAL_NONE = -1 };

/* A vertex and the cells in its four quadrants, anticlockwise from the lower left; a cell whose
 * edge passes the vertex fills two. CONTOUR_DUAL_NONE outside of the mesh. */
struct contour_dual_vertex {
    int64_t key[2]; /* lattice position */
    double at[2];
    long cell[4];
};

struct contour_dual {
    size_t n;
    struct contour_dual_vertex *vertices;
};

void contour_dual_build(size_t n, const struct raster_cell *cells, struct contour_dual *ret_dual);
void contour_dual_done(struct contour_dual *dual);

#endif
