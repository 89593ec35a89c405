/* sides.h - what limiters share whose edges need not lie as far from the cell on both sides.
 *
 * Of two differences of the same sign, `near` is the magnitude of the one towards the edge and `far` that of the other.
 * Each limiter is then a function of (near, far) that is called for both edges of a cell: mirrored cells have mirrored
 * edges, and those of -w are the negative ones, by construction. The including module defines
 * LIMITER_STEP(values, near, far), from 0 to near; `values` are those of the instance. */
#ifndef SIDES_H
#define SIDES_H

#include "bulla/limiter.h"

#include <math.h>
#include <stddef.h>

BULLA_KERNEL static void sides_edges(const void *self, size_t n, size_t step, const double *w,
                                     double *BULLA_RESTRICT lower, double *BULLA_RESTRICT upper)
{
    const double *before = w - step, *after = w + step, *values = self;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double here = w[i], below = here - before[i], above = after[i] - here;
        double size_below = fabs(below), size_above = fabs(above);
        double down = LIMITER_STEP(values, size_below, size_above), up = LIMITER_STEP(values, size_above, size_below);
        int one_way = ((below > 0.0) == (above > 0.0)) & (size_below > 0.0) & (size_above > 0.0);
        lower[i] = here - copysign(one_way ? down : 0.0, below);
        upper[i] = here + copysign(one_way ? up : 0.0, below);
    }
    (void)values; /* of a limiter without any */
}

#define SIDES_TABLE(flags_)                                                                             \
    {                                                                                                   \
        .size = sizeof(struct bulla_limiter), .edges = sides_edges, .flags = BULLA_TWO_SIDED | (flags_) \
    }

#endif
