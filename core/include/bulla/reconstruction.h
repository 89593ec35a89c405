/* bulla/reconstruction.h - functions of a module of kind "reconstruction".
 *
 * A reconstruction turns the values of the cells along an axis into the values at both edges of each cell: what the
 * Riemann solver gets. Rows are long: the neighbour along the axis is `step` doubles away, whatever the axis.
 * [any thread; pure; no allocation; n >= 1; outputs overlap nothing]
 * Contract:
 *   equal cells have edges that are their value, to the bit (uniform pressure and velocity rest on that),
 *   a cell's edges depend on itself and on `layers` - 1 cells on each side, on nothing else,
 *   a mirrored row gives mirrored edges, to the bit,
 *   with `bounded`: an edge is no further from its cell than the nearer neighbour in value, and at an extreme not at
 * all. Without `bounded`, core looks at the edges, and puts limited ones in where a fraction would leave its bounds, or
 * anything else overshoots its neighbours by much (docs/numerics.md). So a scheme may overshoot a little. */
#ifndef BULLA_RECONSTRUCTION_H
#define BULLA_RECONSTRUCTION_H

#include "bulla/module.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The limited slopes that the case chose for a component (`limiter`; of volume fractions `interface-limiter`): the
 * edges w -+ s/2 of n cells. They look at one cell on each side and keep the bounds above. w: the
 * row that the scheme was given, or a piece of it (`interface-along: normal` knows by that how surfaces lie in its
 * cells; of cells from elsewhere it does not, and all of the limiter acts). */
struct bulla_limited {
    uint32_t size; /* sizeof(struct bulla_limited) */
    void (*edges)(const struct bulla_limited *limited, size_t n, size_t step, const double *w,
                  double *BULLA_RESTRICT lower, double *BULLA_RESTRICT upper);
};

/* Rows of all components: alpha_l (none for one material), rho_l, u_i, p, then the stretch of a solid and those of its
 * branches. The first of n cells is w[q][0]; w[q][i + k step] may be read for |k| < layers. */
struct bulla_cells {
    uint32_t size; /* sizeof(struct bulla_cells) */
    uint32_t axis; /* of the row: i_u + axis is the velocity along it */
    size_t n, step;
    uint32_t n_row, n_alpha, n_rho, n_u, n_stretch; /* there is one p */
    uint32_t i_alpha, i_rho, i_u, i_p, i_stretch;   /* first row of each */
    const double *const *w;
    double *const *lower, *const *upper;
    const struct bulla_limited *const *limited; /* [n_row] */
};

struct bulla_reconstruction {
    uint32_t size;    /* sizeof(struct bulla_reconstruction) */
    uint32_t layers;  /* of neighbours that a tile needs on each side: 2 or 3 */
    uint32_t bounded; /* 0 or 1, see above */

    /* One component: values at both edges of n cells. NULL if there is `all`. */
    void (*edges)(const void *self, const struct bulla_limited *limited, size_t n, size_t step, const double *w,
                  double *BULLA_RESTRICT lower, double *BULLA_RESTRICT upper);

    /* All components at once, for schemes that choose by one what they do with another; then it is the only one that
     * core calls. NULL: none. */
    void (*all)(const void *self, const struct bulla_cells *cells);
};

#ifdef __cplusplus
}
#endif
#endif
