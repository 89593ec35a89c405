/* patch.h - functions of two coordinates from a rectangular table: bicubic (Hermite, from values and slopes) or
 * bilinear.
 *
 * A node has, per field, its value and if bicubic its slopes per spacing in x, in y and in both. All is inlined with
 * constants, so that what is not asked for costs nothing. Rows are done in blocks of 16 points: where all of them lie
 * in one cell its nodes are fetched once. */
#ifndef PATCH_H
#define PATCH_H

#include "bulla/module.h"

/* What stands in vector loops has to be inlined there, big as it is. */
#define PATCH_INLINE static inline __attribute__((always_inline))

enum { PATCH_BLOCK = 16, PATCH_BLOCKS = 8 }; /* points of a block; blocks that go through the steps together */

/* Whole part of `at`, within 0 .. most; NaN gives 0. `most` comes from memory on purpose: with a constant gcc knows the
 * outcome of one comparison from the other, makes branches of them and leaves the loop scalar. */
PATCH_INLINE int patch_cell(double at, double most)
{
    double held = at > 0.0 ? at : 0.0;
    held = held < most ? held : most;
    return (int)held;
}

/* Weights of the two ends of an interval at part t: of values and scaled slopes, and their derivatives. */
struct patch_weights {
    double a0, a1, s0, s1, da0, da1, ds0, ds1;
};

PATCH_INLINE struct patch_weights patch_weights(const int cubic, double t)
{
    double r = 1.0 - t, bend = 6.0 * t * r;
    if (!cubic) return (struct patch_weights){r, t, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0};
    return (struct patch_weights){.a0 = r * r * (1.0 + 2.0 * t),
                                  .a1 = t * t * (3.0 - 2.0 * t),
                                  .s0 = t * r * r,
                                  .s1 = -t * t * r,
                                  .da0 = -bend,
                                  .da1 = bend,
                                  .ds0 = r * (1.0 - 3.0 * t),
                                  .ds1 = t * (3.0 * t - 2.0)};
}

/* A field in a cell: its value, its slopes per spacing. */
struct patch {
    double f, f_x, f_y, f_xy;
};

/* A value (or slope in x) and its slope in y between a node and the next of its row. */
PATCH_INLINE struct patch patch_along(const double *node, int at, int next, const struct patch_weights *y)
{
    double a = node[at], s = node[at + 2], b = node[at + next], r = node[at + next + 2];
    return (struct patch){.f = (y->a0 * a + y->a1 * b) + (y->s0 * s + y->s1 * r),
                          .f_y = (y->da0 * a + y->da1 * b) + (y->ds0 * s + y->ds1 * r)};
}

/* From the nodes at `at` (this row) and `up` (the next) and those `next` numbers behind them. */
PATCH_INLINE struct patch patch_at(const int cubic, const double *node, int at, int up, int next,
                                   const struct patch_weights *x, const struct patch_weights *y)
{
    const struct patch_weights u = *x, v = *y;
    if (!cubic) {
        double low = node[at], rise = node[at + next] - low, high = node[up], high_rise = node[up + next] - high;
        double here = low + v.a1 * rise, there = high + v.a1 * high_rise;
        return (struct patch){here + u.a1 * (there - here), there - here, rise + u.a1 * (high_rise - rise),
                              high_rise - rise};
    }
    struct patch low = patch_along(node, at, next, y), rise = patch_along(node, at + 1, next, y);
    struct patch high = patch_along(node, up, next, y), high_rise = patch_along(node, up + 1, next, y);
    return (struct patch){
        .f = (u.a0 * low.f + u.a1 * high.f) + (u.s0 * rise.f + u.s1 * high_rise.f),
        .f_x = (u.da0 * low.f + u.da1 * high.f) + (u.ds0 * rise.f + u.ds1 * high_rise.f),
        .f_y = (u.a0 * low.f_y + u.a1 * high.f_y) + (u.s0 * rise.f_y + u.s1 * high_rise.f_y),
        .f_xy = (u.da0 * low.f_y + u.da1 * high.f_y) + (u.ds0 * rise.f_y + u.ds1 * high_rise.f_y),
    };
}

/* Are all numbers of a block the first? */
PATCH_INLINE int patch_same(const int *BULLA_RESTRICT number)
{
    const int first = number[0];
    int apart = 0;
#pragma omp simd reduction(| : apart)
    for (size_t k = 0; k < PATCH_BLOCK; k++) apart |= number[k] ^ first;
    return !apart;
}

/* Do all values of a block lie within low .. high? A NaN does not. */
PATCH_INLINE int patch_all_within(const double *BULLA_RESTRICT value, const double low, const double high)
{
    int outside = 0;
#pragma omp simd reduction(| : outside)
    for (size_t k = 0; k < PATCH_BLOCK; k++) outside |= (value[k] >= low ? 0 : 1) | (value[k] <= high ? 0 : 1);
    return !outside;
}

#endif
