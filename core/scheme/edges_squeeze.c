/* edges_squeeze.c - see edges_squeeze.h. */
#include "scheme/edges_squeeze.h"

#include "bulla/module.h"
#include "phys/row.h"

#include <math.h>
#include <string.h>

/* Less of vapour and gases than this in a cell and both beside it, and it is liquid; less of liquid, and it is gas,
 * whose tiles may be advanced without a pair (solve/census.h). */
#define EDGES_SQUEEZE_TRACE 1e-4

/* What of the way to an edge is left, if half the smaller difference, or 0 at an extremum, is all of it. */
static inline double edges_squeeze_way(double way, double half)
{
    double near = fabs(way) < fabs(half) ? way : half;
    return way * half > 0.0 ? near : 0.0;
}

static inline int edges_squeeze_any(double before, double here, double after)
{
    return (before > EDGES_SQUEEZE_TRACE) | (here > EDGES_SQUEEZE_TRACE) | (after > EDGES_SQUEEZE_TRACE);
}

/* Do cells move together, with vapour in one of three and liquid in one? */
static inline int edges_squeeze_here(double fall, int thin, int wet)
{
    return (fall > 0.0) & thin & wet;
}

/* thin, wet: the first number is that of the cell before the first. */
static BULLA_KERNEL void edges_squeeze_count(size_t n, size_t step, const double *restrict u,
                                             const double *restrict thin, const double *restrict wet,
                                             double *restrict mask)
{
    const double *u_before = u - step, *u_after = u + step, *thin_here = thin + step, *thin_after = thin_here + step;
    const double *wet_here = wet + step, *wet_after = wet_here + step;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = thin[i], b = thin_here[i], c = thin_after[i], fall = u_before[i] - u_after[i], was = mask[i];
        double d = wet[i], e = wet_here[i], f = wet_after[i];
        int held = edges_squeeze_here(fall, edges_squeeze_any(a, b, c), edges_squeeze_any(d, e, f));
        mask[i] = was + (held ? 1.0 : 0.0);
    }
}

static BULLA_KERNEL void edges_squeeze_hold(size_t n, size_t step, const double *restrict u,
                                            const double *restrict thin, const double *restrict wet, const double *w,
                                            double *restrict lower, double *restrict upper)
{
    const double *u_before = u - step, *u_after = u + step, *thin_here = thin + step, *thin_after = thin_here + step;
    const double *wet_here = wet + step, *wet_after = wet_here + step;
    const double *w_before = w - step, *w_after = w + step;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double here = w[i], low = lower[i], up = upper[i], below = here - w_before[i], above = w_after[i] - here;
        double a = thin[i], b = thin_here[i], c = thin_after[i], fall = u_before[i] - u_after[i];
        double d = wet[i], e = wet_here[i], f = wet_after[i], half = 0.5 * edges_squeeze_way(below, above);
        int held = edges_squeeze_here(fall, edges_squeeze_any(a, b, c), edges_squeeze_any(d, e, f));
        double near_low = here - edges_squeeze_way(here - low, half),
               near_up = here + edges_squeeze_way(up - here, half);
        lower[i] = held ? near_low : low;
        upper[i] = held ? near_up : up;
    }
}

/* Velocities of the cells along the axis. */
static const double *edges_squeeze_along(const struct edges_squeeze *row)
{
    return row->w + (row->model->i_u + (unsigned)row->axis) * row->pitch;
}

/* The liquid of pair k, from the cell before the first on. */
static const double *edges_squeeze_wet(const struct edges_squeeze *row, unsigned k)
{
    return row->w + (row->model->i_alpha + row->model->phases[k].member[0]) * row->pitch - row->step;
}

static void edges_squeeze_row(const struct edges_squeeze *row, unsigned k, unsigned q)
{
    double *upper = row->state + 2 * q * row->pitch;
    edges_squeeze_hold(row->n, row->step, edges_squeeze_along(row), row->thin, edges_squeeze_wet(row, k),
                       row->w + q * row->pitch, upper + row->n, upper);
}

/* Fills `thin` for pair k; false: it condenses at once, or no cell has any. */
static bool edges_squeeze_thin(const struct edges_squeeze *row, unsigned k)
{
    const struct model_phase *phase = &row->model->phases[k];
    const double *alpha = row->w + row->model->i_alpha * row->pitch - row->step;
    size_t n = row->n + 2 * row->step;
    if (!(phase->scene->over > 0.0)) return false;
    memset(row->thin, 0, n * sizeof *row->thin);
    for (unsigned j = 1; j < phase->n; j++) row_add(n, alpha + phase->member[j] * row->pitch, row->thin);
    return row_most(n, row->thin) > EDGES_SQUEEZE_TRACE;
}

void edges_squeeze(const struct edges_squeeze *row)
{
    for (unsigned k = 0; k < row->model->n_phase; k++) {
        if (!edges_squeeze_thin(row, k)) continue;
        edges_squeeze_row(row, k, row->model->i_u + (unsigned)row->axis);
        if (row->pressure) edges_squeeze_row(row, k, row->model->i_E);
    }
}

void edges_squeeze_mark(const struct edges_squeeze *row, double *mask)
{
    for (unsigned k = 0; k < row->model->n_phase; k++)
        if (edges_squeeze_thin(row, k))
            edges_squeeze_count(row->n, row->step, edges_squeeze_along(row), row->thin, edges_squeeze_wet(row, k),
                                mask);
}
