/* elastic_unimodular.c - see elastic.h: det V = 1. */
#include "phys/elastic.h"

#include "phys/elastic_tensor.h"

#include <math.h>

enum { UNIMODULAR_BATCH = 512 };

/* d^(-1/3); NaN for d <= 0. Farther out than 1/8 < d < 8 det V comes nearer to 1 by each call. */
static ELASTIC_BODY double elastic_unimodular_root(double d)
{
    double x = elastic_tensor_per_root(d, 4);
    return d > 0.0 ? x : (double)NAN;
}

#define UNIMODULAR_FACTOR(nv)                                                                                 \
    static BULLA_KERNEL void unimodular_factor_##nv(size_t n, struct elastic_rows V, double *restrict factor) \
    {                                                                                                         \
        ELASTIC_LOCAL(V);                                                                                     \
        _Pragma("omp simd") for (size_t i = 0; i < n; i++) factor[i] =                                        \
            elastic_unimodular_root(elastic_tensor_det(ELASTIC_AT(i, nv)));                                   \
    }
UNIMODULAR_FACTOR(1)
UNIMODULAR_FACTOR(2)
UNIMODULAR_FACTOR(3)

static BULLA_KERNEL void elastic_unimodular_scale(size_t n, const double *restrict factor, double *restrict V)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) V[i] *= factor[i];
}

void elastic_unimodular(const struct model *model, size_t n, size_t stride, double *V)
{
    double factor[UNIMODULAR_BATCH];
    for (size_t from = 0; from < n; from += UNIMODULAR_BATCH) {
        size_t part = n - from < UNIMODULAR_BATCH ? n - from : UNIMODULAR_BATCH;
        struct elastic_rows rows = elastic_tensor_rows(V + from, stride, model->n_stretch);
        ELASTIC_CHOOSE(model->n_velocity, unimodular_factor, part, rows, factor);
        for (unsigned c = 0; c < model->n_stretch; c++) elastic_unimodular_scale(part, factor, V + c * stride + from);
    }
}
