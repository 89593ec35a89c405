/* pair.h - what all limiters share: the two differences ordered by size.
 *
 * Of two differences of the same sign, `less` is the smaller magnitude and `more` the larger. Each
 * limiter is then a function of (less, more) that is called at one place, symmetric in its
 * arguments and odd under a change of sign by construction. With r = less/more in [0, 1] nothing
 * overflows. The including module defines LIMITER_SLOPE(less, more), from 0 to 2 less. */
#ifndef PAIR_H
#define PAIR_H

#include "bulla/limiter.h"

#include <math.h>

static inline double pair_limit(double a, double b)
{
    double size_a = fabs(a), size_b = fabs(b);
    double less = size_a < size_b ? size_a : size_b, more = size_a < size_b ? size_b : size_a;
    double value = LIMITER_SLOPE(less, more);
    int one_way = ((a > 0.0) == (b > 0.0)) & (less > 0.0);
    return copysign(one_way ? value : 0.0, a);
}

BULLA_KERNEL static void pair_slope(const void *self, size_t n, const double *BULLA_RESTRICT d_minus,
                                    const double *BULLA_RESTRICT d_plus, double *BULLA_RESTRICT slope)
{
    (void)self;
#pragma omp simd
    for (size_t i = 0; i < n; i++) slope[i] = pair_limit(d_minus[i], d_plus[i]);
}

BULLA_KERNEL static void pair_edges(const void *self, size_t n, size_t step, const double *w,
                                    double *BULLA_RESTRICT lower, double *BULLA_RESTRICT upper)
{
    const double *before = w - step, *after = w + step;
    (void)self;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double here = w[i], half = 0.5 * pair_limit(here - before[i], after[i] - here);
        lower[i] = here - half;
        upper[i] = here + half;
    }
}

static const struct bulla_limiter pair_table = {.size = sizeof(struct bulla_limiter),
                                                .slope = pair_slope,
                                                .edges = pair_edges};

#define PAIR_MODULE(name_, doc_, cite_)                                                                 \
    {                                                                                                   \
        .magic = BULLA_MAGIC, .abi = BULLA_ABI, .size = sizeof(struct bulla_module), .kind = "limiter", \
        .name = (name_), .version = "1.0", .doc = (doc_), .cite = (cite_), .table = &pair_table         \
    }

#endif
