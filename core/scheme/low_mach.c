/* low_mach.c - see low_mach.h. */
#include "scheme/low_mach.h"

#include "bulla/module.h"

#include <math.h>

/* From the pressure jump over rho c^2 to its part of z. Shocks of more than 1/200 of rho c^2, 11 MPa in water, see the
 * whole jump; with less the tubes R07 to R09 overshoot (docs/decisions/low-mach.md). */
#define LOW_MACH_JUMP 200.0

static BULLA_KERNEL void low_mach_part(size_t n, double least, const double *restrict rho_l,
                                       const double *restrict rho_r, const double *restrict s_l,
                                       const double *restrict s_r, const double *restrict p_l,
                                       const double *restrict p_r, const double *restrict u_l,
                                       const double *restrict u_r, double *restrict part)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = s_l[i], b = s_r[i], left = u_l[i], right = u_r[i], jump = fabs(p_r[i] - p_l[i]);
        double fast_l = left * left * rho_l[i] / a, fast_r = right * right * rho_r[i] / b;
        double fast = fast_l > fast_r ? fast_l : fast_r, stiff = a > b ? a : b;
        part[i] = least + sqrt(fast) + LOW_MACH_JUMP * jump / stiff;
    }
}

static BULLA_KERNEL void low_mach_blend(size_t n, const double *restrict part, double *restrict u_l,
                                        double *restrict u_r)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double z = part[i], left = u_l[i], right = u_r[i], mean = 0.5 * (left + right), half = 0.5 * z * (right - left);
        double lower = mean - half, upper = mean + half;
        u_l[i] = z < 1.0 ? lower : left;
        u_r[i] = z < 1.0 ? upper : right;
    }
}

void low_mach_draw(const struct low_mach *faces, double *u)
{
    const size_t n = faces->n, right = faces->right;
    low_mach_part(n, faces->least, faces->rho, faces->rho + right, faces->rho_c2, faces->rho_c2 + right, faces->p,
                  faces->p + right, u, u + right, faces->part);
    for (size_t i = 0; faces->mask && i < n; i++)
        if (faces->mask[i] + faces->mask[i + faces->step] != 0.0) faces->part[i] = 1.0;
    low_mach_blend(n, faces->part, u, u + right);
}
