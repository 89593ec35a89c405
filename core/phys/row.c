/* row.c - see row.h. */
#include "phys/row.h"

#include "bulla/module.h"

BULLA_KERNEL void row_add(size_t n, const double *restrict a, double *restrict sum)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) sum[i] += a[i];
}

BULLA_KERNEL void row_add_product(size_t n, const double *restrict a, const double *restrict b, double *restrict sum)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double x = a[i], y = b[i], old = sum[i];
        sum[i] = old + x * y;
    }
}

BULLA_KERNEL void row_take(size_t n, const double *restrict a, double *restrict from)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) from[i] -= a[i];
}

BULLA_KERNEL void row_divide(size_t n, const double *restrict by, double *restrict a)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) a[i] /= by[i];
}

BULLA_KERNEL void row_step(size_t n, double dt, const double *restrict u, const double *restrict rate,
                           double *restrict now)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) now[i] = u[i] + dt * rate[i];
}

double row_most(size_t n, const double *row)
{
    double most = 0.0;
    for (size_t i = 0; i < n; i++) most = row[i] > most ? row[i] : most;
    return most;
}
