/* swell.c - see swell.h. */
#include "scheme/swell.h"

#include "phys/mix.h"
#include "phys/row.h"
#include "phys/traction.h"
#include "scheme/exchange.h"
#include "scheme/terms.h"

#include <string.h>

void swell_begin(struct swell *swell, const struct model *path, size_t n)
{
    swell->path = path;
    swell->n = n;
    memset(swell->sum, 0, n * sizeof *swell->sum);
    memset(swell->all, 0, n * sizeof *swell->all);
}

/* What heat would give one material for a volume rate of its own, and its compliance. */
static BULLA_KERNEL void swell_own(size_t n, const double *restrict alpha, const double *restrict rho_c2,
                                   const double *restrict de_dp, const double *restrict heat, double *restrict own,
                                   double *restrict compliance)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], part = a / rho_c2[i], volume = part * heat[i] / de_dp[i];
        int acts = (a > MIX_ABSENT) & (rho_c2[i] > 0.0); /* as in mix_closure() */
        own[i] = acts ? volume : 0.0;
        compliance[i] = acts ? part : 0.0;
    }
}

/* The volume that mass brings. */
static BULLA_KERNEL void swell_mass(size_t n, const double *restrict alpha, const double *restrict rho,
                                    const double *restrict mass, double *restrict own)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double volume = own[i], more = volume + mass[i] / rho[i];
        own[i] = alpha[i] > MIX_ABSENT ? more : volume;
    }
}

void swell_material(struct swell *swell, unsigned l, const double *alpha, const double *rho, const double *p,
                    const double *rho_c2, const double *heat, const double *mass)
{
    const struct model_eos *eos = &swell->path->eos[l];
    double de_dp[SWELL_BATCH], de_drho[SWELL_BATCH];
    eos->law->derivatives(eos->self, swell->n, rho, p, de_dp, de_drho);
    swell_own(swell->n, alpha, rho_c2, de_dp, heat, swell->own[l], swell->compliance[l]);
    if (mass) swell_mass(swell->n, alpha, rho, mass, swell->own[l]);
    row_add(swell->n, swell->own[l], swell->sum);
    row_add(swell->n, swell->compliance[l], swell->all);
}

void swell_volume(struct swell *swell, unsigned l, const double *volume)
{
    row_add(swell->n, volume, swell->own[l]);
    row_add(swell->n, volume, swell->sum);
}

/* Volume moves until the pressures are one again; what the exchange sees of transport stays as it is. */
static BULLA_KERNEL void swell_move(size_t n, const double *restrict own, const double *restrict compliance,
                                    const double *restrict sum, const double *restrict all, const double *restrict p,
                                    double *restrict alpha, double *restrict carried)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double s = all[i], part = compliance[i] / s, rate = own[i] - part * sum[i], a = alpha[i], c = carried[i];
        rate = s > 0.0 ? rate : 0.0;
        alpha[i] = a + rate;
        carried[i] = c + p[i] * rate;
    }
}

void swell_share(const struct swell *swell, const struct term_tile *tile, size_t from)
{
    const struct model *path = swell->path;
    const double *w = tile->w + from;
    double *rates = tile->rates + from, p[SWELL_BATCH], mean[SWELL_BATCH];
    unsigned carried = terms_first(tile->terms, &exchange_term);
    memcpy(p, w + path->i_E * tile->n_cell, swell->n * sizeof *p);
    if (path->split) traction_mean(path, swell->n, tile->n_cell, w, mean), row_take(swell->n, mean, p);
    for (unsigned l = 0; l < path->n_alpha; l++)
        swell_move(swell->n, swell->own[l], swell->compliance[l], swell->sum, swell->all, p,
                   rates + (path->i_alpha + l) * tile->n_cell, rates + (carried + l) * tile->n_cell);
}
