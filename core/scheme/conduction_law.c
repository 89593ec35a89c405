/* conduction_law.c - see conduction_law.h. */
#include "scheme/conduction_law.h"

#include "phys/coefficient.h"

#include <float.h>

/* A difference of pressure, against rho c^2, over which a law tells its rho cv. */
#define CONDUCTION_LAW_NEAR 1e-4

void conduction_law_ask(const struct model *path, unsigned l, size_t n, const double *T, const double *p,
                        const double *rho, double *k)
{
    const struct model_conductivity *conductivity = &path->conductivity[l];
    uint32_t needs = conductivity->law->needs;
    double tempered[CONDUCTION_LAW_BATCH];
    for (size_t i = 0; !needs && i < n; i++) k[i] = conductivity->k;
    for (size_t from = 0; needs && from < n; from += CONDUCTION_LAW_BATCH) {
        size_t some = n - from < CONDUCTION_LAW_BATCH ? n - from : CONDUCTION_LAW_BATCH;
        if (needs & BULLA_NEEDS_TEMPERATURE) coefficient_temper(some, T + from, tempered);
        conductivity->law->value(conductivity->self, some, NULL, needs & BULLA_NEEDS_TEMPERATURE ? tempered : NULL,
                                 needs & BULLA_NEEDS_PRESSURE ? p + from : NULL,
                                 needs & BULLA_NEEDS_DENSITY ? rho + from : NULL, k + from);
    }
}

static BULLA_KERNEL void conduction_law_nudge(size_t n, const double *restrict p, const double *restrict rho_c2,
                                              double *restrict higher)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) higher[i] = p[i] + CONDUCTION_LAW_NEAR * rho_c2[i];
}

/* rho cv = d(rho e)/dT; what is none is as good as none. */
static BULLA_KERNEL void conduction_law_quotient(size_t n, const double *restrict p, const double *restrict higher,
                                                 const double *restrict T, const double *restrict T_higher,
                                                 const double *restrict de_dp, double *restrict c)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double ratio = de_dp[i] * (higher[i] - p[i]) / (T_higher[i] - T[i]);
        c[i] = ratio > DBL_MIN ? ratio : DBL_MIN;
    }
}

void conduction_law_capacity(const struct model_eos *eos, size_t n, const double *rho, const double *p, double *T,
                             double *c)
{
    double e[CONDUCTION_LAW_BATCH], rho_c2[CONDUCTION_LAW_BATCH], higher[CONDUCTION_LAW_BATCH],
        T_higher[CONDUCTION_LAW_BATCH], de_dp[CONDUCTION_LAW_BATCH];
    eos->law->state(eos->self, n, rho, p, e, rho_c2);
    conduction_law_nudge(n, p, rho_c2, higher);
    eos->law->temperature(eos->self, n, rho, p, T);
    eos->law->temperature(eos->self, n, rho, higher, T_higher);
    eos->law->derivatives(eos->self, n, rho, p, de_dp, e);
    conduction_law_quotient(n, p, higher, T, T_higher, de_dp, c);
}
