/* pair.h - what all limiters share: the two differences ordered by size.
 *
 * Of two differences of the same sign, `less` is the one nearer to zero. Each limiter is then a
 * function of (less, more) that is called at one place, symmetric in its arguments and odd
 * under a change of sign by construction. With r = less/more in [0, 1] nothing overflows.
 * The including module defines LIMITER_SLOPE(less, more), a value between 0 and 2 less. */
#ifndef PAIR_H
#define PAIR_H

#include "bulla/limiter.h"

#include <math.h>

BULLA_KERNEL static void pair_slope(const void *self, size_t n, const double *BULLA_RESTRICT d_minus,
                                    const double *BULLA_RESTRICT d_plus, double *BULLA_RESTRICT slope)
{
    (void)self;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = d_minus[i], b = d_plus[i];
        double less = fabs(a) < fabs(b) ? a : b, more = fabs(a) < fabs(b) ? b : a;
        int rising = (a > 0.0) & (b > 0.0), falling = (a < 0.0) & (b < 0.0);
        double value = LIMITER_SLOPE(less, more);
        slope[i] = rising | falling ? value : 0.0;
    }
}

static const struct bulla_limiter pair_table = {.size = sizeof(struct bulla_limiter), .slope = pair_slope};

#define PAIR_MODULE(name_, doc_, cite_)                                                                 \
    {                                                                                                   \
        .magic = BULLA_MAGIC, .abi = BULLA_ABI, .size = sizeof(struct bulla_module), .kind = "limiter", \
        .name = (name_), .version = "1.0", .doc = (doc_), .cite = (cite_), .table = &pair_table         \
    }

#endif
