/* viscous_heat.c - see viscous_heat.h. */
#include "scheme/viscous_heat.h"

#include "phys/coefficient.h"
#include "phys/mix.h"
#include "scheme/swell.h"

/* The hoop stress pulls inwards: as divergence.h does with the pressure. */
static void viscous_heat_hoop(const struct term_tile *tile, const struct viscous_lines *lines, const double *tau)
{
    const struct metric *metric = tile->metric;
    double *rate = tile->rates + tile->model->i_u * tile->n_cell + lines->first * lines->length;
    for (size_t k = 0; k < lines->n; k++)
        for (size_t i = 0; i < lines->length; i++)
            rate[k * lines->length + i] -=
                tau[k * lines->length + i] * (metric->area[i + 1] - metric->area[i]) / metric->volume[i];
}

/* Is there a cell with two materials? */
static bool viscous_heat_is_mixed(const struct model *path, size_t n, size_t stride, const double *w)
{
    for (unsigned l = 0; l < path->n_alpha; l++) {
        const double *alpha = w + (path->i_alpha + l) * stride;
        for (size_t i = 0; i < n; i++)
            if (alpha[i] > MIX_ABSENT && alpha[i] < 1.0 - MIX_ABSENT) return true;
    }
    return false;
}

/* S += alpha/(rho c^2) of a material that is there. */
static BULLA_KERNEL void viscous_heat_soften(size_t n, const double *restrict alpha, const double *restrict rho_c2,
                                             double *restrict compliance)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], K = rho_c2[i], s = compliance[i], part = a / K;
        compliance[i] = s + (((a > MIX_ABSENT) & (K > 0.0)) ? part : 0.0);
    }
}

/* d_l/div u = 1/(rho_l c_l^2 S) */
static BULLA_KERNEL void viscous_heat_share(size_t n, const double *restrict rho_c2, const double *restrict compliance,
                                            double *restrict r)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double K = rho_c2[i], s = compliance[i], share = 1.0 / (K * s);
        r[i] = ((K > 0.0) & (s > 0.0)) ? share : 1.0;
    }
}

/* 2 mu |dev D_l|^2 + zeta d_l^2 */
static BULLA_KERNEL void viscous_heat_warm(size_t n, const double *restrict mu, const double *restrict zeta,
                                           const double *restrict dev2, const double *restrict dilatation,
                                           double *restrict heat)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double d = dilatation[i];
        heat[i] = 2.0 * mu[i] * dev2[i] + zeta[i] * (d * d);
    }
}

/* Heat of each material moves volume. Rows of w begin at cell `from`. */
static void viscous_heat_swell(const struct term_tile *tile, size_t from, const struct viscous_strain *strain)
{
    static const double none[STRAIN_POINTS];
    const struct model *path = tile->model;
    const double *w = tile->w + from, *p = w + path->i_E * tile->n_cell;
    size_t n = strain->n;
    double rho_c2[SCENE_MATERIALS][STRAIN_POINTS], S[STRAIN_POINTS] = {0}, r[STRAIN_POINTS], heat[STRAIN_POINTS];
    double rate[STRAIN_POINTS], dev2[STRAIN_POINTS], dilatation[STRAIN_POINTS], mu[STRAIN_POINTS], zeta[STRAIN_POINTS];
    struct swell swell; /* large: filled as far as it is used */
    viscous_strain_rate(strain, rate);
    for (unsigned l = 0; l < path->n_material; l++) {
        const struct model_eos *eos = &path->eos[l];
        eos->law->state(eos->self, n, w + (path->i_m + l) * tile->n_cell, p, heat, rho_c2[l]);
        viscous_heat_soften(n, w + (path->i_alpha + l) * tile->n_cell, rho_c2[l], S);
    }
    swell_begin(&swell, path, n);
    for (unsigned l = 0; l < path->n_material; l++) {
        const double *rho = w + (path->i_m + l) * tile->n_cell;
        const struct coefficient_points points = {n, rate, p, rho};
        viscous_heat_share(n, rho_c2[l], S, r);
        viscous_strain_own(strain, r, dev2, dilatation);
        coefficient_viscosities(&path->viscosity[l], &path->eos[l], &points, mu, zeta);
        viscous_heat_warm(n, mu, zeta, dev2, dilatation, heat);
        swell_material(&swell, l, w + (path->i_alpha + l) * tile->n_cell, rho, p, rho_c2[l], heat, none);
    }
    swell_share(&swell, tile, from);
}

static void viscous_heat_lines(const struct term_tile *tile, const struct viscous_slopes *slopes,
                               const struct viscous_lines *lines, struct viscous_strain *strain,
                               struct viscous_mix *mix)
{
    const struct model *path = tile->model;
    size_t from = lines->first * lines->length, n = lines->n * lines->length;
    bool mixed = path->kapila && viscous_heat_is_mixed(path, n, tile->n_cell, tile->w + from);
    if (!mixed && !path->beta) return;
    viscous_slopes_cells(slopes, lines, strain);
    if (path->beta) {
        const struct viscous_sides sides = {tile->w + from, tile->n_cell, 0};
        double tau[STRAIN_POINTS];
        viscous_mix_make(strain, &sides, mix);
        viscous_mix_hoop(strain, mix, tau);
        viscous_heat_hoop(tile, lines, tau);
    }
    if (mixed) viscous_heat_swell(tile, from, strain);
}

void viscous_heat_cells(const struct term_tile *tile, const struct viscous_slopes *slopes,
                        struct viscous_strain *strain, struct viscous_mix *mix)
{
    if (!tile->model->beta && !tile->model->kapila) return;
    size_t length = (size_t)tile->mesh->n[0], all = tile->n_cell / length, most = STRAIN_POINTS / length;
    for (size_t first = 0; first < all; first += most) {
        const struct viscous_lines lines = {first, all - first < most ? all - first : most, length};
        viscous_heat_lines(tile, slopes, &lines, strain, mix);
    }
}
