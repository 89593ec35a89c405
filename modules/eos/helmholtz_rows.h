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

HELMHOLTZ_INLINE struct helmholtz_point helmholtz_table_point(const struct helmholtz *self, double rho, double p)
{
    double held = rho > self->ends.thin ? rho : self->ends.thin, asked = helmholtz_dense_p(&self->ends, rho, p);
    held = held < self->ends.dense ? held : self->ends.dense;
    return (struct helmholtz_point){.rho = held,
                                    .p = asked,
                                    .spot = helmholtz_find(&self->grid, HELMHOLTZ_GAS, held, asked)};
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

/* All of it at one point of the caller's coordinates, by one of the two ways; `exact` is a constant in loops. */
HELMHOLTZ_INLINE struct helmholtz_point helmholtz_at(const struct helmholtz *self, const int exact, double rho,
                                                     double p)
{
    struct helmholtz_point point = exact ? helmholtz_exact_point(self, rho, p) : helmholtz_table_point(self, rho, p);
    struct helmholtz_answer answer = helmholtz_answer(point.spot, point.rho, point.p);
    answer = helmholtz_dense(&self->ends, answer, rho, p);
    answer = HELMHOLTZ_GAS ? answer : helmholtz_thin(&self->ends, answer, rho, p);
    return (struct helmholtz_point){point.rho, point.p, point.spot, answer};
}

BULLA_KERNEL static void helmholtz_table_state(const void *instance, size_t n, const double *BULLA_RESTRICT rho,
                                               const double *BULLA_RESTRICT p, double *BULLA_RESTRICT rho_e,
                                               double *BULLA_RESTRICT rho_c2)
{
    const struct helmholtz self = *(const struct helmholtz *)instance;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double density = rho[i], pressure = p[i];
        struct helmholtz_point point = helmholtz_at(&self, 0, density, pressure);
        rho_e[i] = density * point.answer.e;
        rho_c2[i] = helmholtz_stiffness(&self, point.answer.c2, density, pressure);
    }
}

static void helmholtz_state(const void *instance, size_t n, const double *BULLA_RESTRICT rho,
                            const double *BULLA_RESTRICT p, double *BULLA_RESTRICT rho_e, double *BULLA_RESTRICT rho_c2)
{
    const struct helmholtz *self = instance;
    if (!self->analytic) helmholtz_table_state(instance, n, rho, p, rho_e, rho_c2);
    for (size_t i = 0; i < n && self->analytic; i++) {
        struct helmholtz_point point = helmholtz_at(self, 1, rho[i], p[i]);
        rho_e[i] = rho[i] * point.answer.e;
        rho_c2[i] = helmholtz_stiffness(self, point.answer.c2, rho[i], p[i]);
    }
}

BULLA_KERNEL static void helmholtz_table_derivatives(const void *instance, size_t n, const double *BULLA_RESTRICT rho,
                                                     const double *BULLA_RESTRICT p, double *BULLA_RESTRICT de_dp,
                                                     double *BULLA_RESTRICT de_drho)
{
    const struct helmholtz self = *(const struct helmholtz *)instance;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double density = rho[i], pressure = p[i];
        struct helmholtz_point point = helmholtz_at(&self, 0, density, pressure);
        de_dp[i] = density * point.answer.e_p;
        de_drho[i] = point.answer.e + density * point.answer.e_r;
    }
}

static void helmholtz_derivatives(const void *instance, size_t n, const double *BULLA_RESTRICT rho,
                                  const double *BULLA_RESTRICT p, double *BULLA_RESTRICT de_dp,
                                  double *BULLA_RESTRICT de_drho)
{
    const struct helmholtz *self = instance;
    if (!self->analytic) helmholtz_table_derivatives(instance, n, rho, p, de_dp, de_drho);
    for (size_t i = 0; i < n && self->analytic; i++) {
        struct helmholtz_point point = helmholtz_at(self, 1, rho[i], p[i]);
        de_dp[i] = rho[i] * point.answer.e_p;
        de_drho[i] = point.answer.e + rho[i] * point.answer.e_r;
    }
}

BULLA_KERNEL static void helmholtz_table_energy(const void *instance, size_t n, const double *BULLA_RESTRICT rho,
                                                const double *BULLA_RESTRICT p, double *BULLA_RESTRICT rho_e,
                                                double *BULLA_RESTRICT de_dp)
{
    const struct helmholtz self = *(const struct helmholtz *)instance;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double density = rho[i], pressure = p[i];
        struct helmholtz_point point = helmholtz_at(&self, 0, density, pressure);
        rho_e[i] = density * point.answer.e;
        de_dp[i] = density * point.answer.e_p;
    }
}

static void helmholtz_energy_slope(const void *instance, size_t n, const double *BULLA_RESTRICT rho,
                                   const double *BULLA_RESTRICT p, double *BULLA_RESTRICT rho_e,
                                   double *BULLA_RESTRICT de_dp)
{
    const struct helmholtz *self = instance;
    if (!self->analytic) helmholtz_table_energy(instance, n, rho, p, rho_e, de_dp);
    for (size_t i = 0; i < n && self->analytic; i++) {
        struct helmholtz_point point = helmholtz_at(self, 1, rho[i], p[i]);
        rho_e[i] = rho[i] * point.answer.e;
        de_dp[i] = rho[i] * point.answer.e_p;
    }
}

BULLA_KERNEL static void helmholtz_table_temperature(const void *instance, size_t n, const double *BULLA_RESTRICT rho,
                                                     const double *BULLA_RESTRICT p, double *BULLA_RESTRICT T)
{
    const struct helmholtz self = *(const struct helmholtz *)instance;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double density = rho[i], pressure = p[i];
        struct helmholtz_point point = helmholtz_at(&self, 0, density, pressure);
        T[i] = helmholtz_T(&self, point);
    }
}

static void helmholtz_temperature(const void *instance, size_t n, const double *BULLA_RESTRICT rho,
                                  const double *BULLA_RESTRICT p, double *BULLA_RESTRICT T)
{
    const struct helmholtz *self = instance;
    if (!self->analytic) helmholtz_table_temperature(instance, n, rho, p, T);
    for (size_t i = 0; i < n && self->analytic; i++) {
        struct helmholtz_point point = helmholtz_at(self, 1, rho[i], p[i]);
        T[i] = helmholtz_T(self, point);
    }
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
    size_t count = 0;
    for (size_t i = 0; i < n; i++) {
        struct helmholtz_point point = helmholtz_table_point(self, rho[i], p[i]);
        count += !(rho[i] >= self->ends.thin && rho[i] <= self->ends.dense && point.spot.side == 0.0);
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
