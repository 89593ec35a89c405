/* row.c - see row.h. */
#include "phys/row.h"

#include "bulla/module.h"

/* Kernels are static: a clone of clang 14 has a name that other files do not know. */

static BULLA_KERNEL void row_kernel_add(size_t n, const double *restrict a, double *restrict sum)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) sum[i] += a[i];
}

static BULLA_KERNEL void row_kernel_add_product(size_t n, const double *restrict a, const double *restrict b,
                                                double *restrict sum)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double x = a[i], y = b[i], old = sum[i];
        sum[i] = old + x * y;
    }
}

static BULLA_KERNEL void row_kernel_add_both(size_t n, const double *restrict a, const double *restrict b,
                                             double *restrict sum)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double old = sum[i];
        sum[i] = old + (a[i] + b[i]);
    }
}

static BULLA_KERNEL void row_kernel_take(size_t n, const double *restrict a, double *restrict from)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) from[i] -= a[i];
}

static BULLA_KERNEL void row_kernel_divide(size_t n, const double *restrict by, double *restrict a)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) a[i] /= by[i];
}

static BULLA_KERNEL void row_kernel_step(size_t n, double dt, const double *restrict u, const double *restrict rate,
                                         double *restrict now)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) now[i] = u[i] + dt * rate[i];
}

static BULLA_KERNEL void row_kernel_mean(size_t n, const double *restrict a, const double *restrict b,
                                         double *restrict mean)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double x = a[i], y = b[i];
        mean[i] = 0.5 * (x + y);
    }
}

void row_add(size_t n, const double *restrict a, double *restrict sum)
{
    row_kernel_add(n, a, sum);
}

void row_add_product(size_t n, const double *restrict a, const double *restrict b, double *restrict sum)
{
    row_kernel_add_product(n, a, b, sum);
}

void row_add_both(size_t n, const double *restrict a, const double *restrict b, double *restrict sum)
{
    row_kernel_add_both(n, a, b, sum);
}

void row_take(size_t n, const double *restrict a, double *restrict from)
{
    row_kernel_take(n, a, from);
}

void row_divide(size_t n, const double *restrict by, double *restrict a)
{
    row_kernel_divide(n, by, a);
}

void row_step(size_t n, double dt, const double *restrict u, const double *restrict rate, double *restrict now)
{
    row_kernel_step(n, dt, u, rate, now);
}

void row_mean(size_t n, const double *restrict a, const double *restrict b, double *restrict mean)
{
    row_kernel_mean(n, a, b, mean);
}

double row_most(size_t n, const double *row)
{
    double most = 0.0;
    for (size_t i = 0; i < n; i++) most = row[i] > most ? row[i] : most;
    return most;
}

/* Asks for one line of caches at each of `count` places. */
static void row_ask_lines(size_t count, size_t pitch, const double *row)
{
    enum { SECOND = 2, AT_ONCE = 4 }; /* the first level is full of frames; a loop costs more than asking */
    size_t i = 0;
    for (; i + AT_ONCE <= count; i += AT_ONCE)
        for (size_t k = 0; k < AT_ONCE; k++, row += pitch) __builtin_prefetch(row, 0, SECOND);
    for (; i < count; i++, row += pitch) __builtin_prefetch(row, 0, SECOND);
}

void row_ask(size_t count, size_t pitch, size_t length, const double *row)
{
    enum { LINE = 8 }; /* doubles */
    if (length <= LINE) row_ask_lines(count, pitch, row);
    else
        for (size_t i = 0; i < count; i++) row_ask_lines((length + LINE - 1) / LINE, LINE, row + i * pitch);
}
