/* elastic_unimodular.c - see elastic.h: det V = 1, and the stretch fading out where there is little solid. */
#include "phys/elastic.h"

#include "phys/elastic_tensor.h"

#include <math.h>

enum { UNIMODULAR_BATCH = 512 };

/* d^(-1/3) for 1/8 < d < 8 to round-off, by the series of (1 - e)^(-1/3) with e = 1 - d x^3; NaN for d <= 0. Farther
 * out det V comes nearer to 1 by each call. */
ELASTIC_BODY double unimodular_root(double d)
{
    double x = 2.0 / (1.0 + d);
    for (int round = 0; round < 4; round++) {
        double e = 1.0 - d * x * x * x;
        x = x * (1.0 + e * (1.0 / 3.0 + e * (2.0 / 9.0 + e * (14.0 / 81.0))));
    }
    return d > 0.0 ? x : (double)NAN;
}

#define UNIMODULAR_FACTOR(nv)                                                                                 \
    static BULLA_KERNEL void unimodular_factor_##nv(size_t n, struct elastic_rows V, double *restrict factor) \
    {                                                                                                         \
        ELASTIC_LOCAL(V);                                                                                     \
        _Pragma("omp simd") for (size_t i = 0; i < n; i++) factor[i] =                                        \
            unimodular_root(elastic_det(ELASTIC_AT(i, nv)));                                                  \
    }
UNIMODULAR_FACTOR(1)
UNIMODULAR_FACTOR(2)
UNIMODULAR_FACTOR(3)

static BULLA_KERNEL void unimodular_scale(size_t n, const double *restrict factor, double *restrict V)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) V[i] *= factor[i];
}

void elastic_unimodular(const struct model *model, size_t n, size_t stride, double *V)
{
    double factor[UNIMODULAR_BATCH];
    for (size_t from = 0; from < n; from += UNIMODULAR_BATCH) {
        size_t part = n - from < UNIMODULAR_BATCH ? n - from : UNIMODULAR_BATCH;
        struct elastic_rows rows = elastic_rows(V + from, stride, model->n_stretch);
        ELASTIC_CHOOSE(model->n_velocity, unimodular_factor, part, rows, factor);
        for (unsigned c = 0; c < model->n_stretch; c++) unimodular_scale(part, factor, V + c * stride + from);
    }
}

/* Square of |V - 1|, component by component: weight 2 off the diagonal. */
static BULLA_KERNEL void unimodular_distance(size_t n, double one, double weight, const double *restrict V,
                                             double *restrict square)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double e = V[i] - one, s = square[i];
        square[i] = s + weight * e * e;
    }
}

/* How much of V - 1 stays: 1 within the bound, 0 without solid. */
static BULLA_KERNEL void unimodular_share(size_t n, const double *restrict alpha, double *restrict square)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double phi = alpha[i] / ELASTIC_FADE, bound = phi * phi, size = sqrt(square[i]), cut = bound / size;
        double share = size > bound ? cut : 1.0;
        square[i] = phi > 0.0 ? share : 0.0;
    }
}

static BULLA_KERNEL void unimodular_fade(size_t n, double one, const double *restrict share, double *restrict V)
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
    double share[UNIMODULAR_BATCH];
    for (size_t from = 0; from < n; from += UNIMODULAR_BATCH) {
        size_t part = n - from < UNIMODULAR_BATCH ? n - from : UNIMODULAR_BATCH;
        for (size_t i = 0; i < part; i++) share[i] = 0.0;
        for (unsigned c = 0; c < model->n_stretch; c++)
            unimodular_distance(part, c < 3 ? 1.0 : 0.0, c < 3 ? 1.0 : 2.0, V + c * stride + from, share);
        unimodular_share(part, alpha + from, share);
        for (unsigned c = 0; c < model->n_stretch; c++)
            unimodular_fade(part, c < 3 ? 1.0 : 0.0, share, V + c * stride + from);
    }
}
