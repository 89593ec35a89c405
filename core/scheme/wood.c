/* wood.c - see wood.h. */
#include "scheme/wood.h"

#include "bulla/module.h"
#include "phys/mix.h"

#include <math.h>
#include <string.h>

static BULLA_KERNEL void wood_add(size_t n, const double *restrict alpha, const double *restrict rho_c2,
                                  double *restrict give)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], part = a / rho_c2[i], sum = give[i];
        give[i] = sum + (a > MIX_ABSENT ? part : 0.0);
    }
}

void wood_give(size_t n, unsigned l, const double *alpha, const double *rho_c2, double *give)
{
    if (l == 0) memset(give, 0, n * sizeof *give);
    wood_add(n, alpha, rho_c2, give);
}

/* u and u_next: of the cells on both sides of the faces. */
static BULLA_KERNEL void wood_side(size_t n, const double *restrict u, const double *restrict u_next,
                                   const double *restrict rho, const double *restrict give, double *restrict c)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double frozen = c[i], wood = sqrt(1.0 / (rho[i] * give[i])), apart = u_next[i] - u[i];
        double slow = wood < WOOD_FELT * frozen ? wood : frozen;
        c[i] = apart > 0.0 ? slow : frozen;
    }
}

void wood_slow(const struct wood *faces, double *c)
{
    const double *next = faces->u + faces->step;
    wood_side(faces->n, faces->u, next, faces->rho, faces->give, c);
    wood_side(faces->n, faces->u, next, faces->rho + faces->right, faces->give + faces->right, c + faces->right);
}
