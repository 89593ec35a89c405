/* stiffening.h - laws e^s(I1) that stiffen without bound, continued before they do.
 *
 * With J = I1 - 3, a law is a function E(J) with E', E'' > 0. Beyond an edge J_c its second derivative is held:
 *     x = min(J, J_c),  d = J - x:   e = E(x) + d (E'(x) + d/2 E''(x)),  e_1 = E'(x) + d E''(x),  e_11 = E''(x),
 * which is E itself below the edge, twice continuously differentiable, finite for every I1, and needs no branch. The
 * including module defines STIFFENING_POINT(par, x), which gives the three at x, and opens with stiffening_open. */
#ifndef STIFFENING_H
#define STIFFENING_H

#include "law.h"

struct stiffening {
    struct law law;
    double edge; /* J_c */
};

struct stiffening_point {
    double e, e_1, e_11;
};

static inline struct stiffening_point STIFFENING_POINT(const struct stiffening *par, double x);

BULLA_KERNEL static void stiffening_energy(const void *self, size_t n, const double *BULLA_RESTRICT I1,
                                           const double *BULLA_RESTRICT I2, double *BULLA_RESTRICT e,
                                           double *BULLA_RESTRICT e_1, double *BULLA_RESTRICT e_2)
{
    const struct stiffening par = *(const struct stiffening *)self;
    (void)I2;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double J = I1[i] - 3.0, x = J < par.edge ? J : par.edge, d = J - x;
        struct stiffening_point at = STIFFENING_POINT(&par, x);
        e[i] = at.e + d * (at.e_1 + 0.5 * d * at.e_11);
        e_1[i] = at.e_1 + d * at.e_11;
        e_2[i] = 0.0;
    }
}

BULLA_KERNEL static void stiffening_second(const void *self, size_t n, const double *BULLA_RESTRICT I1,
                                           const double *BULLA_RESTRICT I2, double *BULLA_RESTRICT e_11,
                                           double *BULLA_RESTRICT e_12, double *BULLA_RESTRICT e_22)
{
    const struct stiffening par = *(const struct stiffening *)self;
    (void)I2;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double J = I1[i] - 3.0, x = J < par.edge ? J : par.edge;
        e_11[i] = STIFFENING_POINT(&par, x).e_11 + (J - x) * 0.0; /* NaN stays NaN */
        e_12[i] = 0.0;
        e_22[i] = 0.0;
    }
}

static void stiffening_range(const void *self, struct bulla_constitutive_range *ret_range)
{
    const struct stiffening *par = self;
    *ret_range = (struct bulla_constitutive_range){.I1_max = 3.0 + par->edge, .I2_max = (double)INFINITY};
}

static int stiffening_open(const struct bulla_host *host, const struct bulla_value *values, double edge,
                           void **ret_self)
{
    struct stiffening par = {law_make(values, values[LAW_OWN].number), edge};
    return law_keep(host, &par, sizeof par, ret_self);
}

static const struct bulla_constitutive stiffening_table = {.size = sizeof(struct bulla_constitutive),
                                                           .energy = stiffening_energy,
                                                           .second = stiffening_second,
                                                           .range = stiffening_range,
                                                           .first_only = 1};

#endif
