/* elastic_fade.c - see elastic.h: little stretch where there is little solid. */
#include "phys/elastic.h"

#include <math.h>

enum { FADE_BATCH = 512 };

/* Square of |V - 1|, component by component: weight 2 off the diagonal. */
static BULLA_KERNEL void elastic_fade_distance(size_t n, double one, double weight, const double *restrict V,
                                               double *restrict square)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double e = V[i] - one, s = square[i];
        square[i] = s + weight * e * e;
    }
}

/* How much of V - 1 stays: 1 within the bound, 0 without solid. */
static BULLA_KERNEL void elastic_fade_share(size_t n, const double *restrict alpha, double *restrict square)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double phi = alpha[i] / ELASTIC_FADE, bound = phi * phi, size = sqrt(square[i]), cut = bound / size;
        double share = size > bound ? cut : 1.0;
        square[i] = phi > 0.0 ? share : 0.0;
    }
}

static BULLA_KERNEL void elastic_fade_shrink(size_t n, double one, const double *restrict share, double *restrict V)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double v = V[i], s = share[i], less = one + s * (v - one);
        less = s < 1.0 ? less : v;
        V[i] = s > 0.0 ? less : one;
    }
}

void elastic_fade(const struct model *model, size_t n, size_t stride, const double *alpha, double *V)
{
    double share[FADE_BATCH];
    for (size_t from = 0; from < n; from += FADE_BATCH) {
        size_t part = n - from < FADE_BATCH ? n - from : FADE_BATCH;
        for (size_t i = 0; i < part; i++) share[i] = 0.0;
        for (unsigned c = 0; c < model->n_stretch; c++)
            elastic_fade_distance(part, c < 3 ? 1.0 : 0.0, c < 3 ? 1.0 : 2.0, V + c * stride + from, share);
        elastic_fade_share(part, alpha + from, share);
        for (unsigned c = 0; c < model->n_stretch; c++)
            elastic_fade_shrink(part, c < 3 ? 1.0 : 0.0, share, V + c * stride + from);
    }
}
