/* viscous_heat.c - see viscous_heat.h. */
#include "scheme/viscous_heat.h"

#include "phys/mix.h"
#include "phys/row.h"
#include "scheme/swell.h"

#include <string.h>

/* Lines of cells that are looked at together for mixed cells. */
enum { VISCOUS_HEAT_LINES = 4 };

/* The hoop stress pulls inwards: as divergence.h does with the pressure. */
static void viscous_heat_hoop(const struct term_tile *tile, const struct viscous_block *block, const double *tau)
{
    const struct metric *metric = tile->metric;
    double *rate = tile->rates + tile->model->i_u * tile->n_cell + block->face;
    for (size_t k = 0; k < block->rows; k++)
        for (size_t i = 0; i < block->n; i++)
            rate[k * block->n + i] -=
                tau[k * block->n + i] * (metric->area[i + 1] - metric->area[i]) / metric->volume[i];
}

/* At how many cells a material is there and not alone. */
static BULLA_KERNEL double viscous_heat_count(size_t n, const double *restrict alpha)
{
    double found = 0.0;
#pragma omp simd reduction(+ : found)
    for (size_t i = 0; i < n; i++) found += ((alpha[i] > MIX_ABSENT) & (alpha[i] < 1.0 - MIX_ABSENT)) ? 1.0 : 0.0;
    return found;
}

/* Is there a cell with two materials? */
static bool viscous_heat_is_mixed(const struct model *path, size_t n, size_t stride, const double *w)
{
    for (unsigned l = 0; l < path->n_alpha; l++)
        if (viscous_heat_count(n, w + (path->i_alpha + l) * stride) > 0.0) return true;
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

/* Less of a cell than this strains more and more as the mixture does: a trace of gas near vacuum would take all of div
 * u, and the square of 1/alpha times that as heat. */
#define VISCOUS_HEAT_TRACE 1e-4

/* d_l/div u = 1/(rho_l c_l^2 S) */
static BULLA_KERNEL void viscous_heat_share(size_t n, const double *restrict alpha, const double *restrict rho_c2,
                                            const double *restrict compliance, double *restrict r)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double K = rho_c2[i], s = compliance[i], a = alpha[i] / VISCOUS_HEAT_TRACE, share = 1.0 / (K * s);
        share = 1.0 + (a < 1.0 ? a : 1.0) * (share - 1.0);
        r[i] = ((K > 0.0) & (s > 0.0)) ? share : 1.0;
    }
}

/* 2 mu |dev D|^2 + zeta d^2, with D:D = square and d = div u */
static BULLA_KERNEL void viscous_heat_warm(size_t n, const struct viscous_mix_rows *rows, const double *restrict square,
                                           const double *restrict dilatation, double *restrict heat)
{
    const double *restrict mu = rows->mu, *restrict zeta = rows->zeta;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double d = dilatation[i], dev = square[i] - d * d / 3.0, dev2 = dev > 0.0 ? dev : 0.0;
        heat[i] = 2.0 * mu[i] * dev2 + zeta[i] * (d * d);
    }
}

/* A batch of cells. */
struct viscous_heat {
    const struct term_tile *tile;
    struct viscous_strain *strain;
    const struct viscous_mix *mix;
    size_t from;
    double rate[STRAIN_POINTS], square[STRAIN_POINTS], compliance[STRAIN_POINTS];
};

static const double *viscous_heat_row(const struct viscous_heat *heat, unsigned q)
{
    return heat->tile->w + q * heat->tile->n_cell + heat->from;
}

static const double *viscous_heat_stiffness(const struct viscous_heat *heat, unsigned l)
{
    return heat->tile->rho_c2 + l * heat->tile->n_cell + heat->from;
}

/* Viscosities of material l. */
static struct viscous_mix_rows viscous_heat_ask(const struct viscous_heat *at, unsigned l,
                                                struct viscous_mix_number *room)
{
    const struct model *path = at->tile->model;
    const struct coefficient_points points = {at->strain->n, at->rate, viscous_heat_row(at, path->i_E),
                                              viscous_heat_row(at, path->i_m + l)};
    return viscous_mix_ask(at->mix, path, l, &points, room);
}

/* Heat per own volume of material l: of its own strain where there is an interface. */
static void viscous_heat_own(const struct viscous_heat *at, unsigned l, const struct viscous_mix_rows *rows,
                             double *heat)
{
    const struct viscous_strain *strain = at->strain;
    size_t n = strain->n;
    double r[STRAIN_POINTS], square[STRAIN_POINTS], dilatation[STRAIN_POINTS];
    if (!strain->interface || !at->tile->model->kapila) {
        viscous_heat_warm(n, rows, at->square, strain->div, heat);
        return;
    }
    viscous_heat_share(n, viscous_heat_row(at, at->tile->model->i_alpha + l), viscous_heat_stiffness(at, l),
                       at->compliance, r);
    viscous_strain_own(strain, at->square, r, square, dilatation);
    viscous_heat_warm(n, rows, square, dilatation, heat);
}

/* What all materials need. */
static void viscous_heat_begin(struct viscous_heat *at)
{
    struct viscous_strain *strain = at->strain;
    const struct model *path = at->tile->model;
    viscous_strain_square(strain, at->square);
    if (viscous_mix_sees_rate(path)) viscous_strain_rate(strain, at->square, at->rate);
    if (!strain->interface || !path->kapila) return;
    viscous_strain_across(strain);
    memset(at->compliance, 0, strain->n * sizeof *at->compliance);
    for (unsigned l = 0; l < path->n_material; l++)
        viscous_heat_soften(strain->n, viscous_heat_row(at, path->i_alpha + l), viscous_heat_stiffness(at, l),
                            at->compliance);
}

/* What each material gets, for warm.h. */
static void viscous_heat_tell(const struct viscous_heat *at)
{
    const struct term_tile *tile = at->tile;
    const struct model *path = tile->model;
    double heat[STRAIN_POINTS];
    struct viscous_mix_number room;
    for (unsigned l = 0; l < path->n_material; l++) {
        const struct viscous_mix_rows rows = viscous_heat_ask(at, l, &room);
        viscous_heat_own(at, l, &rows, heat);
        row_add_product(at->strain->n, viscous_heat_row(at, path->i_alpha + l), heat,
                        tile->rates + (path->i_alpha + l) * tile->n_cell + at->from);
    }
}

/* Heat of each material moves volume. */
static void viscous_heat_swell(struct viscous_heat *at)
{
    const struct model *path = at->tile->model;
    double heat[STRAIN_POINTS];
    struct swell swell; /* large: filled as far as it is used */
    struct viscous_mix_number room;
    viscous_heat_begin(at);
    if (swell_waits(at->tile)) {
        viscous_heat_tell(at);
        return;
    }
    swell_begin(&swell, path, at->strain->n);
    for (unsigned l = 0; l < path->n_material; l++) {
        const struct viscous_mix_rows rows = viscous_heat_ask(at, l, &room);
        viscous_heat_own(at, l, &rows, heat);
        swell_material(&swell, l, viscous_heat_row(at, path->i_alpha + l), viscous_heat_row(at, path->i_m + l),
                       viscous_heat_row(at, path->i_E), viscous_heat_stiffness(at, l), heat, NULL);
    }
    swell_share(&swell, at->tile, at->from);
}

static void viscous_heat_block(const struct term_tile *tile, const struct viscous_slopes *slopes,
                               const struct viscous_block *block, struct viscous_strain *strain,
                               struct viscous_mix *mix, const struct viscous_film *film)
{
    const struct model *path = tile->model;
    size_t n = block->rows * block->n;
    bool mixed = path->kapila && viscous_heat_is_mixed(path, n, tile->n_cell, tile->w + block->face);
    if (!mixed && !path->beta) return;
    viscous_slopes_strain(slopes, block, strain);
    if (path->beta) {
        const struct viscous_sides sides = {tile->w + block->face, tile->n_cell, 0, block->rows, block->n, block->n};
        double tau[STRAIN_POINTS];
        viscous_mix_make(strain, &sides, mix);
        viscous_mix_hoop(strain, mix, tau);
        viscous_film_cells(film, block, tau);
        viscous_heat_hoop(tile, block, tau);
    }
    if (mixed) {
        struct viscous_heat at; /* large: filled as far as it is used */
        at.tile = tile, at.strain = strain, at.mix = mix, at.from = block->face;
        viscous_heat_swell(&at);
    }
}

void viscous_heat_cells(const struct term_tile *tile, const struct viscous_slopes *slopes,
                        struct viscous_strain *strain, struct viscous_mix *mix, const struct viscous_film *film)
{
    size_t length = (size_t)tile->mesh->n[0], all = tile->n_cell / length, most = STRAIN_POINTS / length;
    if (!tile->model->beta && !tile->model->kapila) return;
    if (!tile->model->beta && most > VISCOUS_HEAT_LINES) most = VISCOUS_HEAT_LINES; /* many hold one material */
    for (size_t first = 0; first < all;) {
        const struct viscous_block block = viscous_slopes_cells(slopes, first, most);
        viscous_heat_block(tile, slopes, &block, strain, mix, film);
        first += block.rows;
    }
}

static void viscous_heat_sum(struct viscous_heat *at, double *sum)
{
    const struct model *path = at->tile->model;
    size_t n = at->strain->n;
    double heat[STRAIN_POINTS];
    struct viscous_mix_number room;
    viscous_heat_begin(at);
    memset(sum, 0, n * sizeof *sum);
    for (unsigned l = 0; l < path->n_material; l++) {
        const struct viscous_mix_rows rows = viscous_heat_ask(at, l, &room);
        viscous_heat_own(at, l, &rows, heat);
        if (path->n_alpha) row_add_product(n, viscous_heat_row(at, path->i_alpha + l), heat, sum);
        else row_add(n, heat, sum);
    }
}

void viscous_heat_field(const struct term_tile *tile, const struct viscous_slopes *slopes,
                        struct viscous_strain *strain, const struct viscous_mix *mix, double *sum)
{
    size_t length = (size_t)tile->mesh->n[0], all = tile->n_cell / length;
    for (size_t first = 0; first < all;) {
        const struct viscous_block block = viscous_slopes_cells(slopes, first, STRAIN_POINTS / length);
        struct viscous_heat at; /* large: filled as far as it is used */
        at.tile = tile, at.strain = strain, at.mix = mix, at.from = block.face;
        viscous_slopes_strain(slopes, &block, strain);
        viscous_heat_sum(&at, sum + block.face);
        first += block.rows;
    }
}
