/* rate_law.h - the shape of laws that look at the rate of shear alone: the including module defines RATE_LAW_POINT, the
 * name of an inline function of its numbers and a rate, and fills `most`. */
#ifndef RATE_LAW_H
#define RATE_LAW_H

#include "law.h"

enum { RATE_LAW_NUMBERS = 6 };

/* One liquid. */
struct rate_law {
    double number[RATE_LAW_NUMBERS]; /* as in the parameter table, zeta apart */
    double most, zeta;
};

static inline double RATE_LAW_POINT(const struct rate_law *par, double rate);

static void rate_law_mu(const void *self, size_t n, const double *BULLA_RESTRICT rate, const double *BULLA_RESTRICT T,
                        const double *BULLA_RESTRICT p, const double *BULLA_RESTRICT rho, double *BULLA_RESTRICT mu)
{
    (void)T, (void)p, (void)rho;
    for (size_t i = 0; i < n; i++) mu[i] = RATE_LAW_POINT(self, rate[i]);
}

static double rate_law_most(const void *self)
{
    return ((const struct rate_law *)self)->most;
}

static void rate_law_zeta(const void *self, size_t n, const double *BULLA_RESTRICT T, const double *BULLA_RESTRICT p,
                          const double *BULLA_RESTRICT rho, double *BULLA_RESTRICT zeta)
{
    (void)T, (void)p, (void)rho;
    law_fill(n, ((const struct rate_law *)self)->zeta, zeta);
}

/* Takes over the first `count` values and, behind them, zeta. */
static inline struct rate_law rate_law_make(const struct bulla_value *values, int count)
{
    struct rate_law par = {.zeta = values[count].number};
    for (int i = 0; i < count; i++) par.number[i] = values[i].number;
    return par;
}

static const struct bulla_viscosity rate_law_table = {.mu = {.size = sizeof(struct bulla_viscosity),
                                                             .needs = BULLA_NEEDS_RATE,
                                                             .value = rate_law_mu,
                                                             .most = rate_law_most},
                                                      .zeta = rate_law_zeta};

#endif
