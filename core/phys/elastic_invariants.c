/* elastic_invariants.c - see elastic.h: invariants of B, for laws and for people. */
#include "phys/elastic.h"

#include "phys/elastic_tensor.h"

#define ELASTIC_INVARIANTS(nv)                                                                             \
    static BULLA_KERNEL void elastic_invariants_##nv(size_t n, struct elastic_rows V, double *restrict I1, \
                                                     double *restrict I2)                                  \
    {                                                                                                      \
        ELASTIC_LOCAL(V);                                                                                  \
        _Pragma("omp simd") for (size_t i = 0; i < n; i++)                                                 \
        {                                                                                                  \
            struct elastic_tensor B = elastic_tensor_square(ELASTIC_AT(i, nv));                            \
            double trace = elastic_tensor_trace(B);                                                        \
            I1[i] = trace;                                                                                 \
            I2[i] = 0.5 * (trace * trace - elastic_tensor_norm2(B));                                       \
        }                                                                                                  \
    }
ELASTIC_INVARIANTS(1)
ELASTIC_INVARIANTS(2)
ELASTIC_INVARIANTS(3)

void elastic_invariants(const struct model *model, size_t n, size_t stride, const double *V, double *restrict I1,
                        double *restrict I2)
{
    struct elastic_rows rows = elastic_tensor_rows(V, stride, model->n_stretch);
    ELASTIC_CHOOSE(model->n_velocity, elastic_invariants, n, rows, I1, I2);
}

/* I1 alone, which is all that plain laws ask for. */
#define ELASTIC_INVARIANTS_FIRST(nv)                                                                             \
    static BULLA_KERNEL void elastic_invariants_first_##nv(size_t n, struct elastic_rows V, double *restrict I1) \
    {                                                                                                            \
        ELASTIC_LOCAL(V);                                                                                        \
        _Pragma("omp simd") for (size_t i = 0; i < n; i++) I1[i] =                                               \
            elastic_tensor_trace(elastic_tensor_square(ELASTIC_AT(i, nv)));                                      \
    }
ELASTIC_INVARIANTS_FIRST(1)
ELASTIC_INVARIANTS_FIRST(2)
ELASTIC_INVARIANTS_FIRST(3)

void elastic_invariants_first(const struct model *model, size_t n, size_t stride, const double *V, double *restrict I1)
{
    struct elastic_rows rows = elastic_tensor_rows(V, stride, model->n_stretch);
    ELASTIC_CHOOSE(model->n_velocity, elastic_invariants_first, n, rows, I1);
}
