/* sides.h - what limiters share whose edges need not lie as far from the cell on both sides.
 *
 * Of two differences of the same sign, `near` is the magnitude of the one towards the edge and `far` that of the other.
 * Each limiter is then a function of (near, far) that is called for both edges of a cell: mirrored cells have mirrored
 * edges, and those of -w are the negative ones, by construction. The including module defines
 * LIMITER_STEP(values, near, far), from 0 to near, or LIMITER_STEPS(values, below, above), a struct sides_steps of both
 * with the same bits; `values` are those of the instance. Blocks in which nothing changes, most of those of fractions,
 * are passed over. */
#ifndef SIDES_H
#define SIDES_H

#include "bulla/limiter.h"

#include <math.h>
#include <stddef.h>

/* Steps down and up of a cell. */
struct sides_steps {
    double down, up;
};

#ifndef LIMITER_STEPS
#define LIMITER_STEPS(values, below, above) \
    ((struct sides_steps){LIMITER_STEP(values, below, above), LIMITER_STEP(values, above, below)})
#endif

enum { SIDES_BLOCK = 64 };

static inline int sides_differ(size_t n, const double *before, const double *w, const double *after)
{
    int differ = 0;
#pragma omp simd reduction(| : differ)
    for (size_t i = 0; i < n; i++) differ |= (before[i] != w[i]) | (after[i] != w[i]);
    return differ;
}

static inline void sides_block(const double *values, size_t n, const double *before, const double *w,
                               const double *after, double *BULLA_RESTRICT lower, double *BULLA_RESTRICT upper)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double here = w[i], below = here - before[i], above = after[i] - here;
        double size_below = fabs(below), size_above = fabs(above);
        struct sides_steps steps = LIMITER_STEPS(values, size_below, size_above);
        int one_way = ((below > 0.0) == (above > 0.0)) & (size_below > 0.0) & (size_above > 0.0);
        lower[i] = here - copysign(one_way ? steps.down : 0.0, below);
        upper[i] = here + copysign(one_way ? steps.up : 0.0, below);
    }
    (void)values; /* of a limiter without any */
}

BULLA_KERNEL static void sides_edges(const void *self, size_t n, size_t step, const double *w,
                                     double *BULLA_RESTRICT lower, double *BULLA_RESTRICT upper)
{
    for (size_t from = 0; from < n; from += SIDES_BLOCK) {
        size_t some = n - from < SIDES_BLOCK ? n - from : SIDES_BLOCK;
        const double *here = w + from;
        if (sides_differ(some, here - step, here, here + step))
            sides_block(self, some, here - step, here, here + step, lower + from, upper + from);
        else
            for (size_t i = from; i < from + some; i++) lower[i] = upper[i] = w[i];
    }
}

#define SIDES_TABLE(flags_)                                                                             \
    {                                                                                                   \
        .size = sizeof(struct bulla_limiter), .edges = sides_edges, .flags = BULLA_TWO_SIDED | (flags_) \
    }

#endif
