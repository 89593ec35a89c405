/* edges_slope.c - see edges_slope.h. */
#include "scheme/edges_slope.h"

#include "plug/vet.h"

#include <string.h>

static BULLA_KERNEL void edges_slope_differ(size_t n, const double *restrict a, const double *restrict b,
                                            double *restrict d)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) d[i] = b[i] - a[i];
}

static BULLA_KERNEL void edges_slope_draw(size_t n, const double *restrict w, const double *restrict slope,
                                          double *restrict lower, double *restrict upper)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double here = w[i], half = 0.5 * slope[i];
        lower[i] = here - half;
        upper[i] = here + half;
    }
}

static void edges_slope_plain(const struct edges_slope *own, size_t n, size_t step, const double *w,
                              double *restrict lower, double *restrict upper)
{
    const struct model_limiter *limiter = &own->limiter;
    if (limiter->law->edges) {
        limiter->law->edges(limiter->self, n, step, w, lower, upper);
        return;
    }
    edges_slope_differ(n + step, w - step, w, own->difference);
    limiter->law->slope(limiter->self, n, own->difference, own->difference + step, own->slope);
    edges_slope_draw(n, w, own->slope, lower, upper);
}

static BULLA_KERNEL void edges_slope_mix(size_t n, const double *restrict slant, const double *restrict soft,
                                         double *restrict edge)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double s = slant[i], a = soft[i], b = edge[i];
        edge[i] = a + s * (b - a);
    }
}

/* The slants of the cells of a row that begins at w; NULL: it is none of those of the frame. */
static const double *edges_slope_slant(const struct edges_slope *own, const double *w)
{
    bool inside = own->soft && w >= own->cells && w < own->cells + own->rows * own->pitch;
    return inside ? own->slant + (size_t)(w - own->cells) % own->pitch : NULL;
}

void edges_slope_limit(const struct bulla_limited *limited, size_t n, size_t step, const double *w,
                       double *restrict lower, double *restrict upper)
{
    const struct edges_slope *own = (const struct edges_slope *)limited;
    const double *slant = edges_slope_slant(own, w);
    edges_slope_plain(own, n, step, w, lower, upper);
    if (!slant) return;
    edges_slope_plain(own->soft, n, step, w, own->room, own->room + n);
    edges_slope_mix(n, slant, own->room, lower);
    edges_slope_mix(n, slant, own->room + n, upper);
}

/* The difference of pressure that is not held by forces: `above` of the cell before, `below` of the one behind. */
static BULLA_KERNEL void edges_slope_differ_held(size_t n, const double *restrict a, const double *restrict b,
                                                 const double *restrict above, const double *restrict below,
                                                 double *restrict d)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) d[i] = (b[i] - a[i]) - (above[i] + below[i]);
}

static BULLA_KERNEL void edges_slope_hold(size_t n, const double *restrict w, const double *restrict slope,
                                          const double *restrict below, const double *restrict above,
                                          double *restrict lower, double *restrict upper)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double here = w[i], half = 0.5 * slope[i], low = below[i], high = above[i];
        lower[i] = here - (half + low);
        upper[i] = here + (half + high);
    }
}

/* What a limiter of two sides, which knows cells alone, makes of given differences: edges of cells of value 0 between
 * neighbours that differ by them. */
static void edges_slope_sides(const struct edges_slope *own, size_t n, const double *below, const double *above,
                              double *lower, double *upper)
{
    double *before = own->three, *here = before + n, *behind = here + n;
    for (size_t i = 0; i < n; i++) before[i] = -below[i];
    memset(here, 0, n * sizeof *here);
    memcpy(behind, above, n * sizeof *behind);
    own->limiter.law->edges(own->limiter.self, n, n, here, lower, upper);
}

static BULLA_KERNEL void edges_slope_lift(size_t n, const double *restrict w, double *restrict lower,
                                          double *restrict upper)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double here = w[i];
        lower[i] = here + lower[i];
        upper[i] = here + upper[i];
    }
}

static BULLA_KERNEL void edges_slope_lift_held(size_t n, const double *restrict w, const double *restrict below,
                                               const double *restrict above, double *restrict lower,
                                               double *restrict upper)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double here = w[i], down = lower[i] - below[i], up = upper[i] + above[i];
        lower[i] = here + down;
        upper[i] = here + up;
    }
}

/* Edges of pressure from its differences to the cells before and behind, less what forces hold. */
static void edges_slope_drawn(const struct edges_slope *own, const struct edges_pressure *row, const double *below,
                              const double *above)
{
    const double *const *rise = row->rise;
    double *lower = row->lower, *upper = row->upper;
    size_t n = row->n;
    if (vet_two_sided(own->limiter.law)) {
        edges_slope_sides(own, n, below, above, lower, upper);
        if (rise[0]) edges_slope_lift_held(n, row->p, rise[0], rise[1], lower, upper);
        else edges_slope_lift(n, row->p, lower, upper);
        return;
    }
    own->limiter.law->slope(own->limiter.self, n, below, above, own->slope);
    if (rise[0]) edges_slope_hold(n, row->p, own->slope, rise[0], rise[1], lower, upper);
    else edges_slope_draw(n, row->p, own->slope, lower, upper);
}

/* Given differences, less what forces hold. */
static BULLA_KERNEL void edges_slope_less(size_t n, const double *restrict lean, const double *restrict above,
                                          const double *restrict below, double *restrict d)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) d[i] = lean[i] - (above[i] + below[i]);
}

/* Where each cell has its own view of the differences to the cells before and behind. */
static void edges_slope_lean(const struct edges_slope *own, const struct edges_pressure *row)
{
    size_t n = row->n, step = row->step;
    const double *const *rise = row->rise;
    if (!rise[0]) {
        edges_slope_drawn(own, row, row->lean[0], row->lean[1]);
        return;
    }
    edges_slope_less(n, row->lean[0], rise[1] - step, rise[0], own->below);
    edges_slope_less(n, row->lean[1], rise[1], rise[0] + step, own->above);
    edges_slope_drawn(own, row, own->below, own->above);
}

void edges_slope_press(const struct edges_slope *own, const struct edges_pressure *row)
{
    size_t n = row->n, step = row->step;
    double *difference = own->difference;
    if (row->lean[0]) {
        edges_slope_lean(own, row);
        return;
    }
    if (row->rise[0])
        edges_slope_differ_held(n + step, row->p - step, row->p, row->rise[1] - step, row->rise[0], difference);
    else edges_slope_differ(n + step, row->p - step, row->p, difference);
    edges_slope_drawn(own, row, difference, difference + step);
}
