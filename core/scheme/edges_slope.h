/* edges_slope.h - limited slopes (MUSCL; van Leer, J. Comput. Phys. 32 (1979) 101-136): those that a scheme may call
 * for, and those of pressure, which core draws by itself where forces act or solids have normals.
 *
 * With rises b below and a above that forces hold, pressure has limited slopes of what is left of its differences, less
 * a_i + b_k from cell i to the next, and edges p - (s/2 + b) and p + (s/2 + a): where p differs by what forces hold,
 * edges of neighbours meet. With leans the differences are these, of each cell's own. */
#ifndef EDGES_SLOPE_H
#define EDGES_SLOPE_H

#include "phys/model.h"

#include <stddef.h>

/* The slopes of one limiter, and four rows of work space, the last two for pressure that leans. */
struct edges_slope {
    struct bulla_limited call; /* the first: a pointer to it is one to the whole */
    struct model_limiter limiter;
    double *difference, *slope, *below, *above;
    double *three; /* three rows of cells, for limiters of two sides */
    /* Of fractions whose limiter goes by the slant of their surface (slant.h): the limiter along it, the slants along
     * the axis of the row, as far behind `cells` as the first of them, rows of `pitch` cells, and room for two rows of
     * edges. soft: NULL if the limiter acts as it is. */
    const struct edges_slope *soft;
    const double *cells, *slant;
    size_t pitch, rows;
    double *room;
};

/* Pressure of n cells that have edges, `step` apart along the axis, and what lies in them (edges.h); one more cell
 * follows on both sides. */
struct edges_pressure {
    size_t n, step;
    const double *p, *rise[2], *lean[2];
    double *lower, *upper; /* the edges, to be filled */
};

/* bulla_limited.edges: edges of n cells by a limiter of one or two sides. Cells that lie elsewhere than in the rows of
 * `cells` have no slant: there the limiter acts as it is. */
void edges_slope_limit(const struct bulla_limited *limited, size_t n, size_t step, const double *w,
                       double *restrict lower, double *restrict upper);

/* Fills the edges of pressure; without rises and leans as with those of 0. */
void edges_slope_press(const struct edges_slope *own, const struct edges_pressure *row);

#endif
