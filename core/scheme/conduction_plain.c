/* conduction_plain.c - see conduction_plain.h. */
#include "scheme/conduction_plain.h"

#include "bulla/module.h"
#include "scheme/conduction_law.h"

/* At how many cells a fraction is not 1. */
static BULLA_KERNEL double conduction_plain_less(size_t n, const double *restrict alpha)
{
    double count = 0.0;
#pragma omp simd reduction(+ : count)
    for (size_t i = 0; i < n; i++) count += alpha[i] != 1.0 ? 1.0 : 0.0;
    return count;
}

int conduction_plain_find(const struct model *path, size_t n, size_t pitch, const double *w)
{
    unsigned l = 0;
    while (l < path->n_alpha && w[(path->i_alpha + l) * pitch] != 1.0) l++;
    if (l == path->n_material || !conduction_law_is(path, l) || path->conductivity[l].law->needs) return -1;
    return !path->n_alpha || conduction_plain_less(n, w + (path->i_alpha + l) * pitch) == 0.0 ? (int)l : -1;
}

static BULLA_KERNEL void conduction_plain_pass(size_t n, double k, const double *restrict left,
                                               const double *restrict right, const double *restrict per_d,
                                               double *restrict flux)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = left[i], b = right[i], least = a < b ? a : b, q = k * per_d[i] * (a - b);
        flux[i] = least > 0.0 ? q : 0.0;
    }
}

void conduction_plain_flux(const struct model *path, unsigned l, size_t n, size_t step, const double *T,
                           const double *per_d, double *q)
{
    double k = path->conductivity[l].k, series = 2.0 * (k * k) / (k + k); /* of both halves, as between two numbers */
    conduction_plain_pass(n, k > 0.0 ? series : 0.0, T, T + step, per_d, q);
}
