/* bulla/limiter.h - functions of a module of kind "limiter".
 *
 * A limiter turns the two one-sided differences of a cell into one slope (per cell width), or, if it says
 * BULLA_TWO_SIDED, into two steps from the cell's value to its edges that need not be as long as each other.
 * [any thread; pure; no allocation; n >= 1; arrays do not overlap; unit stride]
 * Contract, relied on by core to keep face values inside the range of the neighbours:
 *   slope = 0 where the differences have opposite signs or one of them is 0,
 *   |slope| <= 2 min(|d_minus|, |d_plus|), and slope(-a, -b) = -slope(a, b).
 * With two sides the same is said of the edges:
 *   both are w where the differences have opposite signs or one of them is 0,
 *   else each lies between w and the neighbour of its side,
 *   edges(-w) = -edges(w), and mirrored cells have mirrored edges, both to the bit,
 *   units do not matter: edges(k w) = k edges(w) to round-off.
 */
#ifndef BULLA_LIMITER_H
#define BULLA_LIMITER_H

#include "bulla/module.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Values of `flags`. */
#define BULLA_TWO_SIDED 1u /* edges are not w -+ half of one slope: core calls `edges` alone, `slope` may be NULL */
#define BULLA_SURFACES 2u  /* for volume fractions of fluids alone: other uses are refused */

struct bulla_limiter {
    uint32_t size; /* sizeof(struct bulla_limiter) */
    void (*slope)(const void *self, size_t n, const double *BULLA_RESTRICT d_minus, const double *BULLA_RESTRICT d_plus,
                  double *BULLA_RESTRICT slope);

    /* Optional (NULL: core composes it from `slope`): the values at the two edges of n cells,
     *   lower = w - s/2, upper = w + s/2, with s the slope of w[i] - w[i - step] and w[i + step] - w[i],
     * bitwise what `slope` gives. One pass instead of three: this is a large part of a run's time.
     * With BULLA_TWO_SIDED it is required, and keeps the promises above instead. */
    void (*edges)(const void *self, size_t n, size_t step, const double *w, double *BULLA_RESTRICT lower,
                  double *BULLA_RESTRICT upper);

    /* Since 1.1; a table whose `size` ends before it has none. */
    uint32_t flags; /* 0, or a sum of the values above */
};

#ifdef __cplusplus
}
#endif
#endif
