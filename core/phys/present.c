/* present.c - see present.h. */
#include "phys/present.h"

#include <stdbool.h>
#include <string.h>

enum { PRESENT_BATCH = 256 };

typedef void present_call(const struct model_eos *eos, size_t n, const double *rho, const double *p, double *a,
                          double *b);

static void present_call_state(const struct model_eos *eos, size_t n, const double *rho, const double *p, double *rho_e,
                               double *rho_c2)
{
    eos->law->state(eos->self, n, rho, p, rho_e, rho_c2);
}

static void present_call_energy(const struct model_eos *eos, size_t n, const double *rho, const double *p,
                                double *rho_e, double *de_dp)
{
    double unused[PRESENT_BATCH];
    if (BULLA_EOS_HAS(eos->law, energy)) {
        eos->law->energy(eos->self, n, rho, p, rho_e, de_dp);
        return;
    }
    for (size_t i = 0; i < n; i += PRESENT_BATCH) {
        size_t m = n - i < PRESENT_BATCH ? n - i : PRESENT_BATCH;
        eos->law->state(eos->self, m, rho + i, p + i, rho_e + i, unused);
        eos->law->derivatives(eos->self, m, rho + i, p + i, de_dp + i, unused);
    }
}

/* Places of the points with a fraction other than 0 (a NaN is one). */
static size_t present_find(size_t n, const double *alpha, unsigned short *ret_at)
{
    size_t found = 0;
    for (size_t i = 0; i < n; i++) {
        ret_at[found] = (unsigned short)i;
        found += alpha[i] != 0.0;
    }
    return found;
}

/* At most PRESENT_BATCH points. */
static void present_batch(const struct model_eos *eos, const struct present *points, present_call *call, double *a,
                          double *b)
{
    unsigned short at[PRESENT_BATCH];
    double rho[PRESENT_BATCH], p[PRESENT_BATCH], some[PRESENT_BATCH], other[PRESENT_BATCH];
    size_t n = present_find(points->n, points->alpha, at);
    if (n == points->n) {
        call(eos, n, points->rho, points->p, a, b);
        return;
    }
    for (size_t k = 0; k < n; k++) {
        rho[k] = points->rho[at[k]];
        p[k] = points->p[at[k]];
    }
    if (n > 0) call(eos, n, rho, p, some, other);
    memset(a, 0, points->n * sizeof *a);
    memset(b, 0, points->n * sizeof *b);
    for (size_t k = 0; k < n; k++) {
        a[at[k]] = some[k];
        b[at[k]] = other[k];
    }
}

static void present_all(const struct model_eos *eos, const struct present *points, present_call *call, double *a,
                        double *b)
{
    if (!points->alpha || eos->law->linear) {
        call(eos, points->n, points->rho, points->p, a, b);
        return;
    }
    for (size_t i = 0; i < points->n; i += PRESENT_BATCH) {
        size_t n = points->n - i < PRESENT_BATCH ? points->n - i : PRESENT_BATCH;
        struct present part = {n, points->alpha + i, points->rho + i, points->p + i};
        present_batch(eos, &part, call, a + i, b + i);
    }
}

void present_state(const struct model_eos *eos, const struct present *points, double *rho_e, double *rho_c2)
{
    present_all(eos, points, present_call_state, rho_e, rho_c2);
}

void present_energy(const struct model_eos *eos, const struct present *points, double *rho_e, double *de_dp)
{
    present_all(eos, points, present_call_energy, rho_e, de_dp);
}
