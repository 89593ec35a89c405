/* helmholtz_blocks.h - the vector loops of the laws that are given by a Helmholtz energy, over blocks of 16 points.
 *
 * Neighbours in a flow are alike. So each step over a block looks whether all of its points lie in one row of
 * densities, in one interval of y, in one cell: then its numbers are fetched once, instead of once per point from
 * wherever they are. A block that lies well inside the domain skips the rules beyond it. None of this shows in the
 * bits: the same operations are done on the same numbers.
 *
 * A step is done for some blocks before the next one begins: each waits for the one before (where is the row? where
 * the interval?), and the processor has other blocks to do meanwhile. */
#ifndef PATCH_BLOCKS_H
#define PATCH_BLOCKS_H

#include "helmholtz_point.h"

/* A block on its way. */
struct helmholtz_block {
    double rho[PATCH_BLOCK], p[PATCH_BLOCK]; /* at which tables are asked, if that is elsewhere */
    double per_rho[PATCH_BLOCK], f[PATCH_BLOCK], q[PATCH_BLOCK], y[PATCH_BLOCK]; /* helmholtz_level */
    double x[PATCH_BLOCK], t[PATCH_BLOCK]; /* where in a row; where in an interval of y, or of l */
    int i[PATCH_BLOCK], j[PATCH_BLOCK];    /* which of them */
    int one_row, one_rung, inside;         /* all in the same? all well inside the domain? */
    const double *in[2], *asked[2];
    double *out[2];
};

/* Rows of densities; beyond those of the domain tables are asked elsewhere. */
PATCH_INLINE void helmholtz_block_rows(const struct helmholtz *self, const struct helmholtz_band *band,
                                       struct helmholtz_block *BULLA_RESTRICT block)
{
    const struct helmholtz_band rows = *band;
    const struct helmholtz_ends ends = self->ends;
    const double *BULLA_RESTRICT rho = block->in[0], *BULLA_RESTRICT p = block->in[1];
    block->inside = patch_all_within(rho, ends.thin, ends.dense);
    block->asked[0] = block->inside ? rho : block->rho;
    block->asked[1] = block->inside ? p : block->p;
    if (!block->inside) {
#pragma omp simd
        for (size_t k = 0; k < PATCH_BLOCK; k++) {
            block->rho[k] = helmholtz_held(&ends, rho[k]);
            block->p[k] = helmholtz_asked_p(&ends, rho[k], p[k]);
        }
    }
    const double *BULLA_RESTRICT asked = block->asked[0];
#pragma omp simd
    for (size_t k = 0; k < PATCH_BLOCK; k++) {
        struct helmholtz_row row = helmholtz_band_row(&rows, asked[k]);
        block->i[k] = row.i;
        block->x[k] = row.x;
    }
    block->one_row = patch_same(block->i);
}

/* Pressures in rows of densities; `one`: all in the same row. */
PATCH_INLINE void helmholtz_block_levels(const struct helmholtz_band *band, const int one, const int *BULLA_RESTRICT i,
                                         const double *BULLA_RESTRICT x, const double *BULLA_RESTRICT rho,
                                         const double *BULLA_RESTRICT p, double *BULLA_RESTRICT per_rho,
                                         double *BULLA_RESTRICT f, double *BULLA_RESTRICT q, double *BULLA_RESTRICT y)
{
    const struct helmholtz_band rows = *band;
    const int first = i[0];
#pragma omp simd
    for (size_t k = 0; k < PATCH_BLOCK; k++) {
        struct helmholtz_row row = {one ? first : i[k], x[k]};
        struct helmholtz_level level = helmholtz_band_level(&rows, row, rho[k], p[k]);
        per_rho[k] = level.per_rho;
        f[k] = level.f;
        q[k] = level.q;
        y[k] = level.y;
    }
}

/* Intervals of y. */
PATCH_INLINE void helmholtz_block_rungs(const struct helmholtz_steps *steps, const double *BULLA_RESTRICT y,
                                        int *BULLA_RESTRICT j, double *BULLA_RESTRICT t)
{
    const struct helmholtz_steps rungs = *steps;
#pragma omp simd
    for (size_t k = 0; k < PATCH_BLOCK; k++) {
        struct helmholtz_rung rung = helmholtz_rung(&rungs, y[k]);
        j[k] = rung.k;
        t[k] = rung.t;
    }
}

/* From intervals of y to those of l; `one`: all in the same row and interval. */
PATCH_INLINE void helmholtz_block_starts(const struct helmholtz_grid *grid, const int one, const int *BULLA_RESTRICT i,
                                         const double *BULLA_RESTRICT x, int *BULLA_RESTRICT j,
                                         double *BULLA_RESTRICT t)
{
    const struct helmholtz_grid of = *grid;
    const int first_i = i[0], first_j = j[0];
#pragma omp simd
    for (size_t k = 0; k < PATCH_BLOCK; k++) {
        struct helmholtz_row row = {one ? first_i : i[k], x[k]};
        struct helmholtz_rung rung = {one ? first_j : j[k], t[k]};
        struct helmholtz_start start = helmholtz_start(&of, helmholtz_start_at(&of, row, rung));
        j[k] = start.j;
        t[k] = start.z;
    }
}

/* A point: the caller's coordinates, and those at which tables are asked. */
struct helmholtz_asked {
    double rho, p, held, asked;
};

/* The answer at a point by one of the ways; for HELMHOLTZ_THERMAL a pair of T and side. */
PATCH_INLINE struct helmholtz_pair helmholtz_block_point(const struct helmholtz *self, const enum helmholtz_way way,
                                                         const enum helmholtz_want want, const int inside,
                                                         struct helmholtz_row row, struct helmholtz_rung rung,
                                                         struct helmholtz_level level, struct helmholtz_asked at)
{
    double rho = at.rho, p = at.p, side;
    struct helmholtz_answer answer;
    if (way != HELMHOLTZ_BIQUINTIC && want == HELMHOLTZ_THERMAL) {
        double T = helmholtz_direct_T(&self->direct, way == HELMHOLTZ_BICUBIC, row, rung, level, &side);
        return (struct helmholtz_pair){helmholtz_warm(self, T), side};
    }
    if (way == HELMHOLTZ_BIQUINTIC) {
        struct helmholtz_start start = {rung.k, rung.t};
        struct helmholtz_spot spot = helmholtz_find(&self->grid, HELMHOLTZ_GAS, inside, row, level, start, at.held);
        answer = helmholtz_answer(spot, inside, at.held, level.per_rho, at.asked);
        if (want == HELMHOLTZ_THERMAL) return (struct helmholtz_pair){helmholtz_T(self, spot, answer), spot.side};
    } else {
        answer = helmholtz_direct_answer(&self->direct, way == HELMHOLTZ_BICUBIC, inside, row, rung, level);
    }
    return helmholtz_pair(self, want, helmholtz_beyond(self, inside, answer, rho, p), rho, p);
}

/* What is asked for at the points of a block. `one`: all in one cell, `inside`: well inside the domain. */
PATCH_INLINE void helmholtz_block_ask(const struct helmholtz *self, const enum helmholtz_way way,
                                      const enum helmholtz_want want, const int one, const int inside,
                                      const struct helmholtz_block *BULLA_RESTRICT block)
{
    const double *BULLA_RESTRICT rho = block->in[0], *BULLA_RESTRICT p = block->in[1];
    const double *BULLA_RESTRICT held = block->asked[0], *BULLA_RESTRICT asked = block->asked[1];
    double *BULLA_RESTRICT a = block->out[0], *BULLA_RESTRICT b = block->out[1];
    const int i = block->i[0], j = block->j[0];
#pragma omp simd
    for (size_t k = 0; k < PATCH_BLOCK; k++) {
        struct helmholtz_asked at = {rho[k], p[k], inside ? rho[k] : held[k], inside ? p[k] : asked[k]};
        struct helmholtz_row row = {one ? i : block->i[k], block->x[k]};
        struct helmholtz_rung rung = {one ? j : block->j[k], block->t[k]};
        struct helmholtz_level level = {block->per_rho[k], block->f[k], block->q[k], block->y[k]};
        struct helmholtz_pair pair = helmholtz_block_point(self, way, want, inside, row, rung, level, at);
        a[k] = pair.a;
        b[k] = pair.b;
    }
}

/* Some blocks, step by step. */
PATCH_INLINE void helmholtz_some_blocks(const struct helmholtz *self, const enum helmholtz_way way,
                                        const enum helmholtz_want want, size_t n, struct helmholtz_block *blocks)
{
    const int quintic = way == HELMHOLTZ_BIQUINTIC;
    const struct helmholtz_band *band = quintic ? &self->grid.band : &self->direct.band;
    const struct helmholtz_steps *steps = quintic ? &self->grid.steps : &self->direct.steps;
    const double low = quintic ? HELMHOLTZ_NEAR : HELMHOLTZ_COLD, high = quintic ? HELMHOLTZ_FAR : 1.0;
    for (size_t k = 0; k < n; k++) helmholtz_block_rows(self, band, &blocks[k]);
    for (size_t k = 0; k < n; k++) {
        struct helmholtz_block *at = &blocks[k];
        if (at->one_row)
            helmholtz_block_levels(band, 1, at->i, at->x, at->asked[0], at->asked[1], at->per_rho, at->f, at->q, at->y);
        else
            helmholtz_block_levels(band, 0, at->i, at->x, at->asked[0], at->asked[1], at->per_rho, at->f, at->q, at->y);
        helmholtz_block_rungs(steps, at->y, at->j, at->t);
        at->one_rung = patch_same(at->j);
        at->inside &= patch_all_within(at->q, low, high);
    }
    for (size_t k = 0; k < n && quintic; k++) {
        struct helmholtz_block *at = &blocks[k];
        if (at->one_row && at->one_rung) helmholtz_block_starts(&self->grid, 1, at->i, at->x, at->j, at->t);
        else helmholtz_block_starts(&self->grid, 0, at->i, at->x, at->j, at->t);
        at->one_rung = patch_same(at->j);
    }
    for (size_t k = 0; k < n; k++) {
        int one = blocks[k].one_row && blocks[k].one_rung;
        if (one && blocks[k].inside) helmholtz_block_ask(self, way, want, 1, 1, &blocks[k]);
        else if (blocks[k].inside) helmholtz_block_ask(self, way, want, 0, 1, &blocks[k]);
        else helmholtz_block_ask(self, way, want, 0, 0, &blocks[k]);
    }
}

/* A row in blocks; in the last one its last point stands in for those that are not there. */
PATCH_INLINE void helmholtz_blocks_row(const void *instance, const enum helmholtz_way way,
                                       const enum helmholtz_want want, size_t n, const double *const in[2],
                                       double *const out[2])
{
    const struct helmholtz self = *(const struct helmholtz *)instance;
    const size_t whole = n - n % PATCH_BLOCK;
    struct helmholtz_block blocks[PATCH_BLOCKS];
    double last[4][PATCH_BLOCK];
    for (size_t k = 0; k < PATCH_BLOCK && whole < n; k++) {
        last[0][k] = in[0][whole + k < n ? whole + k : n - 1];
        last[1][k] = in[1][whole + k < n ? whole + k : n - 1];
    }
    for (size_t at = 0; at < n; at += PATCH_BLOCK * PATCH_BLOCKS) {
        size_t count = 0;
        for (size_t first = at; first < n && count < PATCH_BLOCKS; first += PATCH_BLOCK, count++)
            for (int l = 0; l < 2; l++) {
                blocks[count].in[l] = first < whole ? in[l] + first : last[l];
                blocks[count].out[l] = first < whole ? out[l] + first : last[2 + l];
            }
        helmholtz_some_blocks(&self, way, want, count, blocks);
    }
    for (int l = 0; l < 2; l++) memcpy(out[l] + whole, last[2 + l], (n - whole) * sizeof(double));
}

/* One function per way and want: what the compiler makes several variants of. */
#define HELMHOLTZ_KERNEL(name, way, want)                                                                      \
    BULLA_KERNEL static void name(const void *self, size_t n, const double *const in[2], double *const out[2]) \
    {                                                                                                          \
        helmholtz_blocks_row(self, way, want, n, in, out);                                                     \
    }

HELMHOLTZ_KERNEL(helmholtz_quintic_state, HELMHOLTZ_BIQUINTIC, HELMHOLTZ_STATE)
HELMHOLTZ_KERNEL(helmholtz_quintic_derivatives, HELMHOLTZ_BIQUINTIC, HELMHOLTZ_DERIVATIVES)
HELMHOLTZ_KERNEL(helmholtz_quintic_energy, HELMHOLTZ_BIQUINTIC, HELMHOLTZ_ENERGY)
HELMHOLTZ_KERNEL(helmholtz_quintic_thermal, HELMHOLTZ_BIQUINTIC, HELMHOLTZ_THERMAL)
HELMHOLTZ_KERNEL(helmholtz_cubic_state, HELMHOLTZ_BICUBIC, HELMHOLTZ_STATE)
HELMHOLTZ_KERNEL(helmholtz_cubic_derivatives, HELMHOLTZ_BICUBIC, HELMHOLTZ_DERIVATIVES)
HELMHOLTZ_KERNEL(helmholtz_cubic_energy, HELMHOLTZ_BICUBIC, HELMHOLTZ_ENERGY)
HELMHOLTZ_KERNEL(helmholtz_cubic_thermal, HELMHOLTZ_BICUBIC, HELMHOLTZ_THERMAL)
HELMHOLTZ_KERNEL(helmholtz_linear_state, HELMHOLTZ_BILINEAR, HELMHOLTZ_STATE)
HELMHOLTZ_KERNEL(helmholtz_linear_derivatives, HELMHOLTZ_BILINEAR, HELMHOLTZ_DERIVATIVES)
HELMHOLTZ_KERNEL(helmholtz_linear_energy, HELMHOLTZ_BILINEAR, HELMHOLTZ_ENERGY)
HELMHOLTZ_KERNEL(helmholtz_linear_thermal, HELMHOLTZ_BILINEAR, HELMHOLTZ_THERMAL)

/* By the table that the instance has. */
static void helmholtz_blocks_ask(const struct helmholtz *self, enum helmholtz_want want, size_t n,
                                 const double *const in[2], double *const out[2])
{
    static void (*const kernel[][HELMHOLTZ_WANTS])(const void *self, size_t n, const double *const in[2],
                                                   double *const out[2]) = {
        [HELMHOLTZ_BIQUINTIC] = {helmholtz_quintic_state, helmholtz_quintic_derivatives, helmholtz_quintic_energy,
                                 helmholtz_quintic_thermal},
        [HELMHOLTZ_BICUBIC] = {helmholtz_cubic_state, helmholtz_cubic_derivatives, helmholtz_cubic_energy,
                               helmholtz_cubic_thermal},
        [HELMHOLTZ_BILINEAR] = {helmholtz_linear_state, helmholtz_linear_derivatives, helmholtz_linear_energy,
                                helmholtz_linear_thermal},
    };
    kernel[self->way][want](self, n, in, out);
}

#endif
