/* prolong_slope.h - the slopes of ghosts made from a coarser level: strips of faces (prolong.c) and pieces with edges
 * and corners (prolong_rim.c) have the same. */
#ifndef PROLONG_SLOPE_H
#define PROLONG_SLOPE_H

#include <stddef.h>

static inline double prolong_slope_minmod(double a, double b)
{
    double x = a < 0.0 ? -a : a, y = b < 0.0 ? -b : b, least = x < y ? a : b;
    return a * b > 0.0 ? least : 0.0;
}

/* What a child lies beside its coarse cell along an axis: a quarter of the limited slope. */
static inline double prolong_slope(const double *w, size_t stride)
{
    return 0.25 * prolong_slope_minmod(w[0] - *(w - stride), w[stride] - w[0]);
}

/* Fractions of three or more materials, limited one by one, need not add up to 1. alpha: [n_alpha][n]. */
static inline void prolong_slope_normalise(size_t n, unsigned n_alpha, double *alpha)
{
    for (size_t i = 0; i < n; i++) {
        double sum = 0.0;
        for (unsigned l = 0; l < n_alpha; l++) sum += alpha[l * n + i];
        for (unsigned l = 0; l < n_alpha; l++) alpha[l * n + i] /= sum;
    }
}

#endif
