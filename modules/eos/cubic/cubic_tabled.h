/* cubic_tabled.h - the functions of kind "eos" for a cubic law with `eval: analytic | table`.
 *
 * With a table energies, temperatures and sound speeds come from cubic_table.h, which `open` makes and which says how
 * good it is; outside of it, and for entropies and densities, the law itself is asked. Rows are done in blocks of 16
 * points, each step for some blocks before the next: where they lie, then what is asked for. A block whose points all
 * lie in one cell fetches its nodes once, one that lies well inside the table asks the law for nothing; that never
 * shows in the bits.
 *
 * The including module defines CUBIC_ATTRACTION as for cubic_rows.h, puts CUBIC_TABLED_PARAMS behind its own
 * parameters, opens with cubic_tabled_open and lists CUBIC_TABLED_FUNCTIONS. */
#ifndef CUBIC_TABLED_H
#define CUBIC_TABLED_H

#include "cubic_table.h"

#include <string.h>

struct cubic_tabled {
    struct cubic law;
    struct cubic_table table;
};

/* What depends on density and pressure alone, within the densities of the table. */
struct cubic_spot {
    double v, w, per_w, q, pressure; /* pressure: p + ac q */
};

ELEMENTARY_INLINE struct cubic_spot cubic_spot(const struct cubic *par, double rho, double p)
{
    double v = 1.0 / rho, w = v - par->b, Q = (v + par->d1 * par->b) * (v + par->d2 * par->b);
    double per = 1.0 / (Q * w), q = w * per;
    return (struct cubic_spot){v, w, Q * per, q, p + par->ac * q};
}

/* A block on its way. */
struct cubic_block {
    double x[PATCH_BLOCK], y[PATCH_BLOCK]; /* parts of the cells i, j */
    double weight[PATCH_BLOCK];            /* of the table; the rest is the law's */
    int i[PATCH_BLOCK], j[PATCH_BLOCK];
    int one, inside, none; /* all in one cell? the law is not needed? the table is not? */
};

/* The table as loops need it. */
struct cubic_frame {
    double u0, u1, y0, y1, per_u, per_y, last;
    const double *node;
    int row; /* numbers of a row of nodes */
};

static struct cubic_frame cubic_tabled_frame(const struct cubic_table *table)
{
    double parts = (double)(table->n - 1);
    return (struct cubic_frame){.u0 = table->u0,
                                .u1 = table->u0 + parts * table->du,
                                .y0 = table->y0,
                                .y1 = table->y0 + parts * table->dy,
                                .per_u = 1.0 / table->du,
                                .per_y = 1.0 / table->dy,
                                .last = parts - 1.0,
                                .node = table->node,
                                .row = (int)(table->n * cubic_table_values(table->bicubic))};
}

/* Places and weights. A NaN, and what has none, is left to the law. */
ELEMENTARY_INLINE void cubic_tabled_place(const struct cubic *law, const struct cubic_frame *frame,
                                          const double *BULLA_RESTRICT rho, const double *BULLA_RESTRICT p,
                                          int *BULLA_RESTRICT i, int *BULLA_RESTRICT j, double *BULLA_RESTRICT x,
                                          double *BULLA_RESTRICT y, double *BULLA_RESTRICT weights)
{
    const struct cubic par = *law;
    const struct cubic_frame to = *frame;
    const double per_b = 1.0 / par.b, per_R = par.b / par.R;
#pragma omp simd
    for (size_t k = 0; k < PATCH_BLOCK; k++) {
        struct cubic_spot spot = cubic_spot(&par, rho[k], p[k]);
        double u = -elementary_log(spot.w * per_b), level = elementary_log(spot.pressure * per_R) - u;
        double weight = (level - to.y0) * (1.0 / CUBIC_TABLE_BAND), down = (to.y1 - level) * (1.0 / CUBIC_TABLE_BAND);
        weight = weight < down ? weight : down;
        weight = weight > 1.0 ? 1.0 : weight;
        weight = weight > 0.0 ? weight : 0.0;
        weight = u >= to.u0 ? weight : 0.0;
        weight = u <= to.u1 ? weight : 0.0;
        double at_u = (u - to.u0) * to.per_u, at_y = (level - to.y0) * to.per_y;
        int cell_u = patch_cell(at_u, to.last), cell_y = patch_cell(at_y, to.last);
        i[k] = cell_u;
        j[k] = cell_y;
        x[k] = at_u - cell_u;
        y[k] = at_y - cell_y;
        weights[k] = weight;
    }
}

/* The weight of the table's `value` beside the law's: where one has none, it may be anything. */
ELEMENTARY_INLINE double cubic_tabled_blend(double weight, double value, double law)
{
    double most = weight > 0.0 ? value : 0.0, least = weight < 1.0 ? law : 0.0;
    return weight * most + (1.0 - weight) * least;
}

/* What rows are asked for; a constant in loops. */
enum cubic_want { CUBIC_STATE, CUBIC_DERIVATIVES, CUBIC_ENERGY, CUBIC_WARM, CUBIC_WANTS };

/* rho e and rho c^2; d(rho e)/dp and d(rho e)/drho; rho e and d(rho e)/dp; T and nothing of use. */
struct cubic_pair {
    double a, b;
};

/* What the table says. With E = e/(R theta) and E_y, E_u: de/dp = w (E + E_y); at constant p, y changes with v by
 * 1/w - ac (-q')/(p + ac q), u by -1/w. */
ELEMENTARY_INLINE struct cubic_pair cubic_tabled_pair(const struct cubic *par, const struct cubic_frame *frame,
                                                      const int bicubic, const enum cubic_want want, int at, double x,
                                                      double y, double rho, double p)
{
    const int up = at + frame->row;
    struct patch_weights u = patch_weights(bicubic, x), l = patch_weights(bicubic, y);
    struct patch E = cubic_table_field(frame->node, bicubic, CUBIC_E, at, up, &u, &l);
    struct patch C = cubic_table_field(frame->node, bicubic, CUBIC_C, at, up, &u, &l);
    struct patch T = cubic_table_field(frame->node, bicubic, CUBIC_T, at, up, &u, &l);
    struct cubic_spot spot = cubic_spot(par, rho, p);
    double E_u = E.f_x * frame->per_u, E_y = E.f_y * frame->per_y, scale = spot.pressure * spot.w;
    double sum = par->d1 + par->d2, dq = spot.q * spot.q * (2.0 * spot.v + sum * par->b); /* -q' */
    double widen = spot.per_w - par->ac * dq / spot.pressure;
    double e_v = scale * ((E.f + E_y) * widen - E_u * spot.per_w);
    double rho_e = scale * rho * E.f, e_p = rho * spot.w * (E.f + E_y);
    double stiffness = p > 0.0 ? spot.pressure * spot.v * spot.per_w * C.f : p;
    double warm = scale / par->R * T.f;
    if (want == CUBIC_STATE) return (struct cubic_pair){rho_e, stiffness};
    if (want == CUBIC_DERIVATIVES) return (struct cubic_pair){e_p, scale * E.f - spot.v * e_v};
    if (want == CUBIC_ENERGY) return (struct cubic_pair){rho_e, e_p};
    return (struct cubic_pair){warm, warm};
}

/* What is asked for at the points of a block. `one`: all in one cell, `inside`: without the law, which else has filled
 * a and b before. */
ELEMENTARY_INLINE void cubic_tabled_ask(const struct cubic *law, const struct cubic_frame *frame, const int bicubic,
                                        const enum cubic_want want, const int one, const int inside,
                                        const struct cubic_block *BULLA_RESTRICT block,
                                        const double *BULLA_RESTRICT rho, const double *BULLA_RESTRICT p,
                                        double *BULLA_RESTRICT a, double *BULLA_RESTRICT b)
{
    const struct cubic par = *law;
    const struct cubic_frame from = *frame;
    const int size = CUBIC_FIELDS * (bicubic ? 4 : 1), first = block->i[0] * from.row + block->j[0] * size;
#pragma omp simd
    for (size_t k = 0; k < PATCH_BLOCK; k++) {
        int at = one ? first : block->i[k] * from.row + block->j[k] * size;
        struct cubic_pair pair =
            cubic_tabled_pair(&par, &from, bicubic, want, at, block->x[k], block->y[k], rho[k], p[k]);
        double weight = block->weight[k];
        a[k] = inside ? pair.a : cubic_tabled_blend(weight, pair.a, a[k]);
        b[k] = inside ? pair.b : cubic_tabled_blend(weight, pair.b, b[k]);
    }
}

/* By the law itself. */
static void cubic_tabled_law(const struct cubic *law, enum cubic_want want, size_t n, const double *const in[2],
                             double *const out[2])
{
    static void (*const rows[])(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                const double *BULLA_RESTRICT p, double *BULLA_RESTRICT a,
                                double *BULLA_RESTRICT b) = {cubic_rows_state, cubic_rows_derivatives,
                                                             cubic_rows_energy};
    if (want == CUBIC_WARM) cubic_rows_temperature(law, n, in[0], in[1], out[0]);
    else rows[want](law, n, in[0], in[1], out[0], out[1]);
}

/* At most PATCH_BLOCKS blocks, step by step; `most`: of the points of a block, those that are wanted. */
ELEMENTARY_INLINE void cubic_tabled_blocks(const struct cubic_tabled *self, const struct cubic_frame *frame,
                                           const int bicubic, const enum cubic_want want, size_t n, size_t most,
                                           const double *rho, const double *p, double *a, double *b)
{
    struct cubic_block blocks[PATCH_BLOCKS];
    for (size_t k = 0; k < n; k++) {
        struct cubic_block *at = &blocks[k];
        size_t from = k * PATCH_BLOCK;
        cubic_tabled_place(&self->law, frame, rho + from, p + from, at->i, at->j, at->x, at->y, at->weight);
        at->one = patch_same(at->i) && patch_same(at->j);
        at->inside = patch_all_within(at->weight, 1.0, 1.0);
        at->none = patch_all_within(at->weight, 0.0, 0.0);
    }
    for (size_t k = 0; k < n; k++) {
        const struct cubic_block *at = &blocks[k];
        const double *const in[2] = {rho + k * PATCH_BLOCK, p + k * PATCH_BLOCK};
        double *const out[2] = {a + k * PATCH_BLOCK, b + k * PATCH_BLOCK};
        if (!at->inside) cubic_tabled_law(&self->law, want, most, in, out);
        if (at->none) continue;
        if (!at->inside) cubic_tabled_ask(&self->law, frame, bicubic, want, 0, 0, at, in[0], in[1], out[0], out[1]);
        else if (at->one) cubic_tabled_ask(&self->law, frame, bicubic, want, 1, 1, at, in[0], in[1], out[0], out[1]);
        else cubic_tabled_ask(&self->law, frame, bicubic, want, 0, 1, at, in[0], in[1], out[0], out[1]);
    }
}

/* A row by the table; in its last block the last point stands in for those that are not there. */
ELEMENTARY_INLINE void cubic_tabled_row(const struct cubic_tabled *self, const int bicubic, const enum cubic_want want,
                                        size_t n, const double *const in[2], double *const out[2])
{
    const struct cubic_frame frame = cubic_tabled_frame(&self->table);
    const size_t some = (size_t)PATCH_BLOCKS * PATCH_BLOCK, whole = n - n % PATCH_BLOCK;
    for (size_t at = 0; at < whole; at += some) {
        size_t left = whole - at < some ? whole - at : some;
        cubic_tabled_blocks(self, &frame, bicubic, want, left / PATCH_BLOCK, PATCH_BLOCK, in[0] + at, in[1] + at,
                            out[0] + at, out[1] + at);
    }
    if (whole == n) return;
    double rho[PATCH_BLOCK], p[PATCH_BLOCK], a[PATCH_BLOCK] = {0}, b[PATCH_BLOCK] = {0};
    for (size_t k = 0; k < PATCH_BLOCK; k++) {
        rho[k] = in[0][whole + k < n ? whole + k : n - 1];
        p[k] = in[1][whole + k < n ? whole + k : n - 1];
    }
    cubic_tabled_blocks(self, &frame, bicubic, want, 1, n - whole, rho, p, a, b);
    memcpy(out[0] + whole, a, (n - whole) * sizeof *a);
    memcpy(out[1] + whole, b, (n - whole) * sizeof *b);
}

/* One function per interpolation and want: what the compiler makes several variants of. */
#define CUBIC_TABLED_KERNEL(name, bicubic, want)                                                        \
    BULLA_KERNEL static void name(const struct cubic_tabled *self, size_t n, const double *const in[2], \
                                  double *const out[2])                                                 \
    {                                                                                                   \
        cubic_tabled_row(self, bicubic, want, n, in, out);                                              \
    }

CUBIC_TABLED_KERNEL(cubic_linear_state, 0, CUBIC_STATE)
CUBIC_TABLED_KERNEL(cubic_linear_derivatives, 0, CUBIC_DERIVATIVES)
CUBIC_TABLED_KERNEL(cubic_linear_energy, 0, CUBIC_ENERGY)
CUBIC_TABLED_KERNEL(cubic_linear_warm, 0, CUBIC_WARM)
CUBIC_TABLED_KERNEL(cubic_cubic_state, 1, CUBIC_STATE)
CUBIC_TABLED_KERNEL(cubic_cubic_derivatives, 1, CUBIC_DERIVATIVES)
CUBIC_TABLED_KERNEL(cubic_cubic_energy, 1, CUBIC_ENERGY)
CUBIC_TABLED_KERNEL(cubic_cubic_warm, 1, CUBIC_WARM)

static void cubic_tabled_do(const void *instance, enum cubic_want want, size_t n, const double *const in[2],
                            double *const out[2])
{
    static void (*const kernel[2][CUBIC_WANTS])(const struct cubic_tabled *self, size_t n, const double *const in[2],
                                                double *const out[2]) = {{cubic_linear_state, cubic_linear_derivatives,
                                                                          cubic_linear_energy, cubic_linear_warm},
                                                                         {cubic_cubic_state, cubic_cubic_derivatives,
                                                                          cubic_cubic_energy, cubic_cubic_warm}};
    const struct cubic_tabled *self = instance;
    if (self->table.n) kernel[self->table.bicubic][want](self, n, in, out);
    else cubic_tabled_law(&self->law, want, n, in, out);
}

static void cubic_tabled_state(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                               const double *BULLA_RESTRICT p, double *BULLA_RESTRICT rho_e,
                               double *BULLA_RESTRICT rho_c2)
{
    cubic_tabled_do(self, CUBIC_STATE, n, (const double *const[2]){rho, p}, (double *const[2]){rho_e, rho_c2});
}

static void cubic_tabled_derivatives(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                     const double *BULLA_RESTRICT p, double *BULLA_RESTRICT de_dp,
                                     double *BULLA_RESTRICT de_drho)
{
    cubic_tabled_do(self, CUBIC_DERIVATIVES, n, (const double *const[2]){rho, p}, (double *const[2]){de_dp, de_drho});
}

static void cubic_tabled_energy(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                const double *BULLA_RESTRICT p, double *BULLA_RESTRICT rho_e,
                                double *BULLA_RESTRICT de_dp)
{
    cubic_tabled_do(self, CUBIC_ENERGY, n, (const double *const[2]){rho, p}, (double *const[2]){rho_e, de_dp});
}

static void cubic_tabled_temperature(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                     const double *BULLA_RESTRICT p, double *BULLA_RESTRICT T)
{
    double spare[CUBIC_BLOCK] = {0};
    for (size_t i = 0; i < n; i += CUBIC_BLOCK)
        cubic_tabled_do(self, CUBIC_WARM, n - i < CUBIC_BLOCK ? n - i : CUBIC_BLOCK,
                        (const double *const[2]){rho + i, p + i}, (double *const[2]){T + i, spare});
}

/* The law's, moved until the table gives the temperature asked for. */
static void cubic_tabled_density(const void *instance, size_t n, const double *BULLA_RESTRICT p,
                                 const double *BULLA_RESTRICT T, double *BULLA_RESTRICT rho)
{
    const struct cubic_tabled *self = instance;
    cubic_rows_density(self, n, p, T, rho);
    for (size_t i = 0; i < n && self->table.n; i++) {
        double sought = T[i], got;
        for (int k = 0; k < 6; k++) {
            cubic_tabled_temperature(self, 1, &rho[i], &p[i], &got);
            sought += T[i] - got;
            rho[i] = cubic_rows_density_at(&self->law, p[i], sought);
        }
    }
}

#endif
