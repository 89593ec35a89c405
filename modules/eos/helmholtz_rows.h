/* helmholtz_rows.h - the functions of kind "eos" for a fluid given by its Helmholtz energy.
 *
 * The including module first defines HELMHOLTZ_GAS: 1 keeps R T ln rho out of the table, so that densities may go
 * to zero. It opens its instances with helmholtz_open of helmholtz_open.h and fills its table with HELMHOLTZ_TABLE.
 *
 * With `eval: table` every row is a vector loop. With `eval: analytic` the table gives where to start, and Newton steps
 * on the sum of all terms end it: the same root, with the formulas' own numbers. */
#ifndef HELMHOLTZ_ROWS_H
#define HELMHOLTZ_ROWS_H

#include "bulla/eos.h"
#include "helmholtz_find.h"

struct helmholtz {
    struct helmholtz_grid grid; /* a copy: its arrays belong to the shared table */
    struct helmholtz_ends ends;
    const struct helmholtz_law *law;
    int analytic;
};

/* One point: the density and pressure at which the potential is asked, and what it says. */
struct helmholtz_point {
    double rho, p;
    struct helmholtz_spot spot;
    struct helmholtz_answer answer;
};

/* What the table is asked for at (rho, p): held to the densities of the domain. `inside` (a constant in loops): it
 * lies there. */
HELMHOLTZ_INLINE struct helmholtz_point helmholtz_asked(const struct helmholtz *self, const int inside, double rho,
                                                        double p)
{
    if (inside) return (struct helmholtz_point){.rho = rho, .p = p};
    double held = rho > self->ends.thin ? rho : self->ends.thin, asked = helmholtz_dense_p(&self->ends, rho, p);
    held = held < self->ends.dense ? held : self->ends.dense;
    return (struct helmholtz_point){.rho = held, .p = asked};
}

HELMHOLTZ_INLINE struct helmholtz_point helmholtz_table_point(const struct helmholtz *self, double rho, double p)
{
    struct helmholtz_point point = helmholtz_asked(self, 0, rho, p);
    struct helmholtz_place place = helmholtz_place(&self->grid, HELMHOLTZ_GAS, point.rho, point.p);
    point.spot = helmholtz_find(&self->grid, HELMHOLTZ_GAS, point.rho, point.p, place);
    return point;
}

/* The formulas at (rho, l). */
static inline struct helmholtz_spot helmholtz_exact(const struct helmholtz_fluid *fluid, double rho, double l)
{
    double a[HELMHOLTZ_R][HELMHOLTZ_L], T = exp(l), RT = fluid->R * T;
    helmholtz_potential(fluid, rho, l, a);
    double lift = HELMHOLTZ_GAS ? 0.0 : RT * log(rho / fluid->rho_c);
    struct helmholtz_spot spot = {.l = l, .T = T};
    spot.a = a[0][0] + lift;
    spot.a_l = a[0][1] + lift;
    spot.a_ll = a[0][2] + lift;
    spot.a_lll = a[0][3] + lift;
    spot.a_r = a[1][0];
    spot.a_rl = a[1][1];
    spot.a_rll = a[1][2];
    spot.a_rr = a[2][0];
    spot.a_rrl = a[2][1];
    return helmholtz_with_gas(spot, rho, RT);
}

/* From the root in the table to that of the formulas, held in the domain; a NaN ends the search. */
static inline struct helmholtz_point helmholtz_exact_point(const struct helmholtz *self, double rho, double p)
{
    struct helmholtz_point point = helmholtz_table_point(self, rho, p);
    double unused, square = point.rho * point.rho, high = self->grid.l_high;
    double low = HELMHOLTZ_GAS ? self->grid.l_low : helmholtz_edge(&self->grid, point.rho, &unused);
    double l = point.spot.l > low ? point.spot.l : low, slope = point.spot.slope;
    l = l < high ? l : high;
    for (int round = 0; round < 12; round++) {
        point.spot = helmholtz_exact(self->law->fluid, point.rho, l);
        double next = l - (square * point.spot.a_r - point.p) / (square * point.spot.a_rl);
        next = next > low ? next : low;
        next = next < high ? next : high;
        if (!(fabs(next - l) > 1e-14)) break;
        l = next;
    }
    double here = square * point.spot.a_r;
    point.spot.slope = slope;
    point.spot.side = l <= low && point.p < here ? -1.0 : l >= high && point.p > here ? 1.0 : 0.0;
    return point;
}

/* At p_min and below the stiffness says so. */
HELMHOLTZ_INLINE double helmholtz_stiffness(const struct helmholtz *self, double c2, double rho, double p)
{
    return p > self->ends.p_min ? rho * c2 : p - self->ends.p_min;
}

HELMHOLTZ_INLINE double helmholtz_T(const struct helmholtz *self, struct helmholtz_point point)
{
    double T = point.spot.T * (1.0 + point.answer.excess / point.answer.p_l);
    return T > self->ends.T_min ? T : self->ends.T_min;
}

/* On from the trial at constant rho with its cv; for the thin rule at constant p with the T of its last density. */
static inline double helmholtz_s(const struct helmholtz *self, struct helmholtz_point point, double rho, double p)
{
    double start = point.spot.T, T = helmholtz_T(self, point), g = self->ends.gamma;
    double s = (point.answer.cv * log(T / start) - point.spot.a_l) / start;
    if (HELMHOLTZ_GAS) return s - self->grid.R * log(point.rho / self->law->fluid->rho_c);
    double more = rho < self->ends.thin ? 1.0 / rho - 1.0 / self->ends.thin : 0.0;
    return s + more * g / (g - 1.0) * (p + self->ends.pull) / T;
}

/* What the potential says at `point`, and beyond the densities of the domain. */
HELMHOLTZ_INLINE struct helmholtz_point helmholtz_complete(const struct helmholtz *self, const int inside,
                                                           struct helmholtz_point point, double rho, double p)
{
    struct helmholtz_answer answer = helmholtz_answer(point.spot, point.rho, point.p);
    answer = inside ? answer : helmholtz_dense(&self->ends, answer, rho, p);
    answer = inside || HELMHOLTZ_GAS ? answer : helmholtz_thin(&self->ends, answer, rho, p);
    return (struct helmholtz_point){point.rho, point.p, point.spot, answer};
}

/* All of it at one point of the caller's coordinates, by one of the two ways. */
static inline struct helmholtz_point helmholtz_at(const struct helmholtz *self, int exact, double rho, double p)
{
    struct helmholtz_point point = exact ? helmholtz_exact_point(self, rho, p) : helmholtz_table_point(self, rho, p);
    return helmholtz_complete(self, 0, point, rho, p);
}

/* What rows are asked for; a constant in loops. */
enum helmholtz_want { HELMHOLTZ_STATE, HELMHOLTZ_DERIVATIVES, HELMHOLTZ_ENERGY, HELMHOLTZ_THERMAL };

/* Two numbers: rho e and rho c^2; d(rho e)/dp and d(rho e)/drho; rho e and d(rho e)/dp; T and where the trial ended, 0
 * within the formulas. */
struct helmholtz_pair {
    double a, b;
};

HELMHOLTZ_INLINE struct helmholtz_pair helmholtz_pair(const struct helmholtz *self, const enum helmholtz_want want,
                                                      struct helmholtz_point point, double rho, double p)
{
    struct helmholtz_answer at = point.answer;
    if (want == HELMHOLTZ_STATE) return (struct helmholtz_pair){rho * at.e, helmholtz_stiffness(self, at.c2, rho, p)};
    if (want == HELMHOLTZ_DERIVATIVES) return (struct helmholtz_pair){rho * at.e_p, at.e + rho * at.e_r};
    if (want == HELMHOLTZ_ENERGY) return (struct helmholtz_pair){rho * at.e, rho * at.e_p};
    return (struct helmholtz_pair){helmholtz_T(self, point), point.spot.side};
}

enum { HELMHOLTZ_BLOCK = 16 };

/* A block of points: what is asked, where it lies in the table, what comes out. The last point stands in for those that
 * a row has not got, so that loops have one length. */
struct helmholtz_block {
    double rho[HELMHOLTZ_BLOCK], p[HELMHOLTZ_BLOCK];
    int i[HELMHOLTZ_BLOCK], j[HELMHOLTZ_BLOCK];
    double x[HELMHOLTZ_BLOCK], l[HELMHOLTZ_BLOCK], low[HELMHOLTZ_BLOCK], slope[HELMHOLTZ_BLOCK];
    double a[HELMHOLTZ_BLOCK], b[HELMHOLTZ_BLOCK];
};

/* Fills a block; true if all densities are those of the domain. */
HELMHOLTZ_INLINE int helmholtz_block_fill(const struct helmholtz *self, size_t n, const double *rho, const double *p,
                                          struct helmholtz_block *ret_block)
{
    int outside = 0;
    for (size_t k = 0; k < HELMHOLTZ_BLOCK; k++) {
        double density = rho[k < n ? k : n - 1];
        ret_block->rho[k] = density;
        ret_block->p[k] = p[k < n ? k : n - 1];
        outside |= !(density >= self->ends.thin) | !(density <= self->ends.dense);
    }
    return !outside;
}

/* Places of the points of a block. */
HELMHOLTZ_INLINE void helmholtz_block_place(const struct helmholtz *self, const int inside,
                                            const double *BULLA_RESTRICT rho, const double *BULLA_RESTRICT p,
                                            int *BULLA_RESTRICT i, int *BULLA_RESTRICT j, double *BULLA_RESTRICT x,
                                            double *BULLA_RESTRICT l, double *BULLA_RESTRICT low,
                                            double *BULLA_RESTRICT slope)
{
#pragma omp simd
    for (size_t k = 0; k < HELMHOLTZ_BLOCK; k++) {
        struct helmholtz_point point = helmholtz_asked(self, inside, rho[k], p[k]);
        struct helmholtz_place place = helmholtz_place(&self->grid, HELMHOLTZ_GAS, point.rho, point.p);
        i[k] = place.i;
        j[k] = place.j;
        x[k] = place.x;
        l[k] = place.l;
        low[k] = place.low;
        slope[k] = place.slope;
    }
}

/* Finds the places of a block; true if all lie in one cell of the table. */
HELMHOLTZ_INLINE int helmholtz_block_find(const struct helmholtz *self, const int inside, struct helmholtz_block *block)
{
    int apart = 0;
    helmholtz_block_place(self, inside, block->rho, block->p, block->i, block->j, block->x, block->l, block->low,
                          block->slope);
    for (size_t k = 1; k < HELMHOLTZ_BLOCK; k++) apart |= (block->i[k] ^ block->i[0]) | (block->j[k] ^ block->j[0]);
    return !apart;
}

/* Answers at the points of a block. `one` and `inside` are constants where this is inlined. With `one` all points lie in
 * one cell, whose numbers are fetched once. The same operations on the same numbers give the same bits. */
HELMHOLTZ_INLINE void helmholtz_block_ask(const struct helmholtz *self, const enum helmholtz_want want, const int one,
                                          const int inside, struct helmholtz_block *BULLA_RESTRICT block)
{
    const int i = block->i[0], j = block->j[0];
#pragma omp simd
    for (size_t k = 0; k < HELMHOLTZ_BLOCK; k++) {
        double rho = block->rho[k], p = block->p[k];
        struct helmholtz_place place = {one ? i : block->i[k], one ? j : block->j[k], block->x[k],
                                        block->l[k],           block->low[k],         block->slope[k]};
        struct helmholtz_point point = helmholtz_asked(self, inside, rho, p);
        point.spot = helmholtz_find(&self->grid, HELMHOLTZ_GAS, point.rho, point.p, place);
        point = helmholtz_complete(self, inside, point, rho, p);
        struct helmholtz_pair pair = helmholtz_pair(self, want, point, rho, p);
        block->a[k] = pair.a;
        block->b[k] = pair.b;
    }
}

/* A row in blocks: neighbours mostly lie inside the domain, and in one cell of the table. */
HELMHOLTZ_INLINE void helmholtz_table_row(const void *instance, const enum helmholtz_want want, size_t n,
                                          const double *const in[2], double *const out[2])
{
    const struct helmholtz self = *(const struct helmholtz *)instance;
    for (size_t at = 0; at < n; at += HELMHOLTZ_BLOCK) {
        struct helmholtz_block block;
        size_t m = n - at < HELMHOLTZ_BLOCK ? n - at : HELMHOLTZ_BLOCK;
        if (!helmholtz_block_fill(&self, m, in[0] + at, in[1] + at, &block)) {
            helmholtz_block_find(&self, 0, &block);
            helmholtz_block_ask(&self, want, 0, 0, &block);
        } else if (helmholtz_block_find(&self, 1, &block)) {
            helmholtz_block_ask(&self, want, 1, 1, &block);
        } else {
            helmholtz_block_ask(&self, want, 0, 1, &block);
        }
        memcpy(out[0] + at, block.a, m * sizeof *block.a);
        memcpy(out[1] + at, block.b, m * sizeof *block.b);
    }
}

BULLA_KERNEL static void helmholtz_table_state(const void *instance, size_t n, const double *const in[2],
                                               double *const out[2])
{
    helmholtz_table_row(instance, HELMHOLTZ_STATE, n, in, out);
}

BULLA_KERNEL static void helmholtz_table_derivatives(const void *instance, size_t n, const double *const in[2],
                                                     double *const out[2])
{
    helmholtz_table_row(instance, HELMHOLTZ_DERIVATIVES, n, in, out);
}

BULLA_KERNEL static void helmholtz_table_energy(const void *instance, size_t n, const double *const in[2],
                                                double *const out[2])
{
    helmholtz_table_row(instance, HELMHOLTZ_ENERGY, n, in, out);
}

BULLA_KERNEL static void helmholtz_table_thermal(const void *instance, size_t n, const double *const in[2],
                                                 double *const out[2])
{
    helmholtz_table_row(instance, HELMHOLTZ_THERMAL, n, in, out);
}

/* By the formulas, or by the table. */
static void helmholtz_ask(const void *instance, enum helmholtz_want want, size_t n, const double *const in[2],
                          double *const out[2])
{
    static void (*const table[])(const void *instance, size_t n, const double *const in[2],
                                 double *const out[2]) = {helmholtz_table_state, helmholtz_table_derivatives,
                                                          helmholtz_table_energy, helmholtz_table_thermal};
    const struct helmholtz *self = instance;
    if (!self->analytic) table[want](instance, n, in, out);
    for (size_t i = 0; i < n && self->analytic; i++) {
        double rho = in[0][i], p = in[1][i];
        struct helmholtz_pair pair = helmholtz_pair(self, want, helmholtz_at(self, 1, rho, p), rho, p);
        out[0][i] = pair.a;
        out[1][i] = pair.b;
    }
}

static void helmholtz_state(const void *instance, size_t n, const double *BULLA_RESTRICT rho,
                            const double *BULLA_RESTRICT p, double *BULLA_RESTRICT rho_e, double *BULLA_RESTRICT rho_c2)
{
    helmholtz_ask(instance, HELMHOLTZ_STATE, n, (const double *const[2]){rho, p}, (double *const[2]){rho_e, rho_c2});
}

static void helmholtz_derivatives(const void *instance, size_t n, const double *BULLA_RESTRICT rho,
                                  const double *BULLA_RESTRICT p, double *BULLA_RESTRICT de_dp,
                                  double *BULLA_RESTRICT de_drho)
{
    helmholtz_ask(instance, HELMHOLTZ_DERIVATIVES, n, (const double *const[2]){rho, p},
                  (double *const[2]){de_dp, de_drho});
}

static void helmholtz_energy_slope(const void *instance, size_t n, const double *BULLA_RESTRICT rho,
                                   const double *BULLA_RESTRICT p, double *BULLA_RESTRICT rho_e,
                                   double *BULLA_RESTRICT de_dp)
{
    helmholtz_ask(instance, HELMHOLTZ_ENERGY, n, (const double *const[2]){rho, p}, (double *const[2]){rho_e, de_dp});
}

enum { HELMHOLTZ_SIDES = 128 };

static void helmholtz_temperature(const void *instance, size_t n, const double *BULLA_RESTRICT rho,
                                  const double *BULLA_RESTRICT p, double *BULLA_RESTRICT T)
{
    double side[HELMHOLTZ_SIDES];
    for (size_t i = 0; i < n; i += HELMHOLTZ_SIDES)
        helmholtz_ask(instance, HELMHOLTZ_THERMAL, n - i < HELMHOLTZ_SIDES ? n - i : HELMHOLTZ_SIDES,
                      (const double *const[2]){rho + i, p + i}, (double *const[2]){T + i, side});
}

/* log is no vector function without leave to change values, so this row stays scalar. */
static void helmholtz_entropy(const void *instance, size_t n, const double *BULLA_RESTRICT rho,
                              const double *BULLA_RESTRICT p, double *BULLA_RESTRICT s)
{
    const struct helmholtz *self = instance;
    for (size_t i = 0; i < n; i++) {
        struct helmholtz_point point = helmholtz_at(self, self->analytic, rho[i], p[i]);
        s[i] = helmholtz_s(self, point, rho[i], p[i]);
    }
}

/* rho with temperature(rho, p) = T: T falls when rho grows, so there is a bracket. Inside the domain Newton's method with
 * dT/drho = -T p_r/p_l, else halving. */
static double helmholtz_density_at(const struct helmholtz *self, double p, double T)
{
    double low = self->ends.thin, high = 3.0 * self->ends.dense, rho = HELMHOLTZ_GAS ? p / (self->grid.R * T) : 1000.0;
    for (int round = 0; round < 200 && high - low > 2e-16 * high; round++) {
        if (!(rho > low && rho < high)) rho = low > 1e-3 * high ? 0.5 * (low + high) : sqrt(low * high);
        struct helmholtz_point point = helmholtz_at(self, self->analytic, rho, p);
        double off = helmholtz_T(self, point) - T, square = rho * rho;
        double slope = -point.spot.T * (2.0 * rho * point.spot.a_r + square * point.spot.a_rr) / point.answer.p_l;
        int inside = point.rho == rho && point.spot.side == 0.0;
        double next = inside ? rho - off / slope : 0.0;
        if (inside && !(fabs(next - rho) > 2e-16 * rho)) break;
        if (off > 0.0) low = rho;
        else high = rho;
        rho = next;
    }
    return rho > low && rho < high ? rho : 0.5 * (low + high); /* the bracket closes on the edge of the domain */
}

static void helmholtz_density(const void *instance, size_t n, const double *BULLA_RESTRICT p,
                              const double *BULLA_RESTRICT T, double *BULLA_RESTRICT rho)
{
    for (size_t i = 0; i < n; i++) rho[i] = helmholtz_density_at(instance, p[i], T[i]);
}

static void helmholtz_p_min(const void *instance, size_t n, const double *BULLA_RESTRICT rho, double *BULLA_RESTRICT p)
{
    const struct helmholtz *self = instance;
    (void)rho;
    for (size_t i = 0; i < n; i++) p[i] = self->ends.p_min;
}

static size_t helmholtz_count_outside(const void *instance, size_t n, const double *BULLA_RESTRICT rho,
                                      const double *BULLA_RESTRICT p)
{
    const struct helmholtz *self = instance;
    double T[HELMHOLTZ_SIDES], side[HELMHOLTZ_SIDES];
    size_t count = 0;
    for (size_t i = 0; i < n; i += HELMHOLTZ_SIDES) {
        size_t m = n - i < HELMHOLTZ_SIDES ? n - i : HELMHOLTZ_SIDES;
        helmholtz_table_thermal(instance, m, (const double *const[2]){rho + i, p + i}, (double *const[2]){T, side});
        for (size_t k = 0; k < m; k++)
            count += !(rho[i + k] >= self->ends.thin && rho[i + k] <= self->ends.dense && side[k] == 0.0);
    }
    return count;
}

#define HELMHOLTZ_TABLE(range_function)                                                                   \
    {                                                                                                     \
        .size = sizeof(struct bulla_eos), .state = helmholtz_state, .derivatives = helmholtz_derivatives, \
        .temperature = helmholtz_temperature, .entropy = helmholtz_entropy, .density = helmholtz_density, \
        .p_min = helmholtz_p_min, .range = (range_function), .energy = helmholtz_energy_slope,            \
        .count_outside = helmholtz_count_outside                                                          \
    }

#endif
