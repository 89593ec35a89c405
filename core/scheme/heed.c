/* heed.c - see heed.h. */
#include "scheme/heed.h"

#include "bulla/module.h"
#include "phys/row.h"

#include <string.h>

const double *heed_density(const struct model *path, size_t n, size_t stride, const double *w, double *room)
{
    const double *rho = w + path->i_m * stride, *alpha = w + path->i_alpha * stride;
    if (!path->n_alpha) return rho;
    memset(room, 0, n * sizeof *room);
    for (unsigned l = 0; l < path->n_alpha; l++) row_add_product(n, alpha + l * stride, rho + l * stride, room);
    return room;
}

static BULLA_KERNEL void heed_each(size_t n, const double *restrict part, const double *restrict rho_l,
                                   const double *restrict rho, double *restrict sets)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = part[i], much = a > HEED_VOLUME ? a : 0.0;
        sets[i] = a * rho_l[i] > HEED_MASS * rho[i] ? much : 0.0;
    }
}

void heed_parts(size_t n, const double *part, const double *rho_l, const double *rho, double *sets)
{
    heed_each(n, part, rho_l, rho, sets);
}
