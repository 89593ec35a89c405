/* coefficient.c - see coefficient.h. */
#include "phys/coefficient.h"

static void coefficient_fill(size_t n, double number, double *value)
{
    for (size_t i = 0; i < n; i++) value[i] = number;
}

static BULLA_KERNEL void coefficient_temper_row(size_t n, const double *restrict T, double *restrict tempered)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double t = T[i], low = t < COEFFICIENT_COLDEST ? COEFFICIENT_COLDEST : t;
        tempered[i] = low > COEFFICIENT_HOTTEST ? COEFFICIENT_HOTTEST : low;
    }
}

void coefficient_temper(size_t n, const double *T, double *tempered)
{
    coefficient_temper_row(n, T, tempered);
}

/* The rows that a law has asked for. */
struct coefficient_rows {
    const double *T, *p, *rho;
};

static struct coefficient_rows coefficient_rows(const struct bulla_coefficient *law, const struct model_eos *eos,
                                                const struct coefficient_points *points, double *T)
{
    struct coefficient_rows rows = {NULL, NULL, NULL};
    double own[COEFFICIENT_BATCH];
    if (law->needs & BULLA_NEEDS_TEMPERATURE) {
        eos->law->temperature(eos->self, points->n, points->rho, points->p, own);
        coefficient_temper(points->n, own, T);
        rows.T = T;
    }
    if (law->needs & BULLA_NEEDS_PRESSURE) rows.p = points->p;
    if (law->needs & BULLA_NEEDS_DENSITY) rows.rho = points->rho;
    return rows;
}

void coefficient_values(const struct model_coefficient *coefficient, const struct model_eos *eos,
                        const struct coefficient_points *points, double *value)
{
    const struct bulla_coefficient *law = coefficient->law;
    double T[COEFFICIENT_BATCH];
    if (!law || !law->needs) {
        coefficient_fill(points->n, coefficient->number, value);
        return;
    }
    const struct coefficient_rows rows = coefficient_rows(law, eos, points, T);
    const double *rate = law->needs & BULLA_NEEDS_RATE ? points->rate : NULL;
    law->value(coefficient->self, points->n, rate, rows.T, rows.p, rows.rho, value);
}

static void coefficient_zeta(const struct model_viscosity *viscosity, const struct model_eos *eos,
                             const struct coefficient_points *points, double *zeta)
{
    double T[COEFFICIENT_BATCH];
    if (!viscosity->law || !viscosity->law->zeta || !coefficient_sees_state(&viscosity->mu)) {
        coefficient_fill(points->n, viscosity->zeta, zeta);
        return;
    }
    const struct coefficient_rows rows = coefficient_rows(viscosity->mu.law, eos, points, T);
    viscosity->law->zeta(viscosity->mu.self, points->n, rows.T, rows.p, rows.rho, zeta);
}

void coefficient_viscosities(const struct model_viscosity *viscosity, const struct model_eos *eos,
                             const struct coefficient_points *points, double *mu, double *zeta)
{
    coefficient_values(&viscosity->mu, eos, points, mu);
    coefficient_zeta(viscosity, eos, points, zeta);
}

void coefficient_viscosities_most(const struct model_viscosity *viscosity, const struct model_eos *eos,
                                  const struct coefficient_points *points, double *mu, double *zeta)
{
    if (coefficient_sees_rate(&viscosity->mu)) coefficient_fill(points->n, viscosity->mu.number, mu);
    else coefficient_values(&viscosity->mu, eos, points, mu);
    coefficient_zeta(viscosity, eos, points, zeta);
}
