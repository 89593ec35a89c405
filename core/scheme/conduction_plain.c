/* conduction_plain.c - see conduction_plain.h. */
#include "scheme/conduction_plain.h"

#include "bulla/module.h"
#include "scheme/conduction_law.h"

bool conduction_plain_is(const struct model *path)
{
    return path->n_material == 1 && !path->n_alpha && conduction_law_is(path, 0) && !path->conductivity[0].law->needs;
}

static BULLA_KERNEL void conduction_plain_pass(size_t n, double k, const double *restrict left,
                                               const double *restrict right, const double *restrict per_d,
                                               double *restrict energy)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = left[i], b = right[i], least = a < b ? a : b, q = k * per_d[i] * (a - b), old = energy[i];
        energy[i] = old + (least > 0.0 ? q : 0.0);
    }
}

void conduction_plain_add(const struct model *path, size_t n, size_t step, const double *T, const double *per_d,
                          double *energy)
{
    double k = path->conductivity[0].k, series = 2.0 * (k * k) / (k + k); /* of both halves, as between two numbers */
    conduction_plain_pass(n, k > 0.0 ? series : 0.0, T, T + step, per_d, energy);
}
