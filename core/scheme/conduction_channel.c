/* conduction_channel.c - see conduction_channel.h. */
#include "scheme/conduction_channel.h"

#include "bulla/module.h"

/* Temperatures in a cell that differ by this share are two. */
#define CONDUCTION_CHANNEL_ONE 1e-3

static BULLA_KERNEL void conduction_channel_split(size_t n, const double *restrict left, const double *restrict right,
                                                  double *restrict own, double *restrict left_rest,
                                                  double *restrict right_rest, double *restrict rest)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = left[i], b = right[i], sum = rest[i], least = a < b ? a : b, over = a - least, under = b - least;
        own[i] = least;
        left_rest[i] = over;
        right_rest[i] = under;
        rest[i] = sum + 0.5 * (over + under);
    }
}

void conduction_channel_own(size_t n, const double *left, const double *right, double *own, double *left_rest,
                            double *right_rest, double *rest)
{
    conduction_channel_split(n, left, right, own, left_rest, right_rest, rest);
}

static BULLA_KERNEL void conduction_channel_share(size_t n, const double *restrict left_rest,
                                                  const double *restrict right_rest, const double *restrict rest,
                                                  double *restrict cross)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double both = left_rest[i] * right_rest[i], all = rest[i], share = both / all;
        cross[i] = both > 0.0 ? share : 0.0;
    }
}

void conduction_channel_cross(size_t n, const double *left_rest, const double *right_rest, const double *rest,
                              double *cross)
{
    conduction_channel_share(n, left_rest, right_rest, rest, cross);
}

static BULLA_KERNEL void conduction_channel_mean(size_t n, const double *restrict left, const double *restrict right,
                                                 double *restrict k)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = left[i], b = right[i], sum = a + b, series = 2.0 * (a * b) / sum;
        k[i] = sum > 0.0 ? series : 0.0;
    }
}

void conduction_channel_series(size_t n, const struct conduction_channel_side *left,
                               const struct conduction_channel_side *right, double *k)
{
    conduction_channel_mean(n, left->k, right->k, k);
}

static BULLA_KERNEL void conduction_channel_one(size_t n, const double *restrict part_l, const double *restrict T_l,
                                                const double *restrict part_m, const double *restrict T_m,
                                                double *restrict wet)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = part_l[i], b = part_m[i], T = T_l[i], apart = T > T_m[i] ? T - T_m[i] : T_m[i] - T;
        double least = a < b ? a : b, room = CONDUCTION_CHANNEL_ONE * T, share = (room - apart) / room;
        share = share > 0.0 ? share : 0.0;
        wet[i] = least > 0.0 ? share : 0.0;
    }
}

void conduction_channel_wet(size_t n, const struct conduction_channel_side *l, const struct conduction_channel_side *m,
                            double *wet)
{
    conduction_channel_one(n, l->part, l->T, m->part, m->T, wet);
}

static BULLA_KERNEL void conduction_channel_half(size_t n, const double *restrict left, const double *restrict right,
                                                 const double *restrict wet_left, const double *restrict wet_right,
                                                 double *restrict k)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double here = 2.0 * right[i] * wet_left[i], there = 2.0 * left[i] * wet_right[i], series = k[i];
        double surface = here > there ? here : there;
        k[i] = surface > series ? surface : series;
    }
}

void conduction_channel_surface(size_t n, const struct conduction_channel_side *left,
                                const struct conduction_channel_side *right, const double *wet_left,
                                const double *wet_right, double *k)
{
    conduction_channel_mean(n, left->k, right->k, k);
    conduction_channel_half(n, left->k, right->k, wet_left, wet_right, k);
}

static BULLA_KERNEL void conduction_channel_limit(size_t n, double most, const struct conduction_channel_side *left,
                                                  const struct conduction_channel_side *right, double *restrict k)
{
    const double *restrict sets_left = left->sets, *restrict sets_right = right->sets, *restrict c_left = left->c,
                           *restrict c_right = right->c, *restrict T_left = left->T, *restrict T_right = right->T;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = sets_left[i], b = sets_right[i], cl = c_left[i], cr = c_right[i], Tl = T_left[i], Tr = T_right[i];
        double wanted = k[i], least = a < b ? a : b, cold = Tl < Tr ? Tl : Tr, apart = Tl < Tr ? Tr - Tl : Tl - Tr;
        double share = cold / apart, part = share < 1.0 ? share : 1.0, bound = most * (cl * cr / (cl + cr)) * part;
        double limit = cold > 0.0 ? bound : 0.0, kept = limit < wanted ? limit : wanted;
        k[i] = least > 0.0 ? wanted : kept;
    }
}

void conduction_channel_bound(size_t n, double most, const struct conduction_channel_side *left,
                              const struct conduction_channel_side *right, double *k)
{
    conduction_channel_limit(n, most, left, right, k);
}

static BULLA_KERNEL void conduction_channel_pass(size_t n, const double *restrict width, const double *restrict k,
                                                 const double *restrict per_d, const double *restrict T_left,
                                                 const double *restrict T_right, double *restrict q)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double A = width[i], through = (A * k[i] * per_d[i]) * (T_left[i] - T_right[i]);
        q[i] = A > 0.0 ? through : 0.0;
    }
}

void conduction_channel_flow(size_t n, const double *width, const double *k, const double *per_d, const double *T_left,
                             const double *T_right, double *q)
{
    conduction_channel_pass(n, width, k, per_d, T_left, T_right, q);
}
