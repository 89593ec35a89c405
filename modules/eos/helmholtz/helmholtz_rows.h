/* helmholtz_rows.h - the functions of kind "eos" for a fluid given by its Helmholtz energy.
 *
 * The including module opens its instances with helmholtz_open of helmholtz_open.h and fills its table with
 * HELMHOLTZ_TABLE.
 *
 * With `eval: table` every row is a vector loop (helmholtz_blocks.h). With `eval: analytic` the table gives where to
 * start, and Newton steps on the sum of all terms end it: the same root, with the formulas' own numbers. */
#ifndef HELMHOLTZ_ROWS_H
#define HELMHOLTZ_ROWS_H

#include "helmholtz_blocks.h"
#include "helmholtz_thermal.h"

/* By the formulas, or by the table. */
static void helmholtz_ask(const void *instance, enum helmholtz_want want, size_t n, const double *const in[2],
                          double *const out[2])
{
    const struct helmholtz *self = instance;
    if (!self->analytic) helmholtz_blocks_ask(self, want, n, in, out);
    for (size_t i = 0; i < n && self->analytic; i++) {
        double rho = in[0][i], p = in[1][i];
        struct helmholtz_point point = helmholtz_at(self, 1, rho, p);
        struct helmholtz_pair pair = helmholtz_pair(self, want, point.answer, rho, p);
        if (want == HELMHOLTZ_THERMAL)
            pair = (struct helmholtz_pair){helmholtz_T(self, point.spot, point.answer), point.spot.side};
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

/* rho with temperature(rho, p) = T: T falls when rho grows, so there is a bracket. Inside the domain Newton's method
 * with dT/drho = -T p_r/p_l of the potential, else halving. */
static double helmholtz_density_at(const struct helmholtz *self, double p, double T)
{
    double low = self->ends.thin, high = 3.0 * self->ends.dense, rho = HELMHOLTZ_GAS ? p / (self->grid.R * T) : 1000.0;
    for (int round = 0; round < 200 && high - low > 2e-16 * high; round++) {
        if (!(rho > low && rho < high)) rho = low > 1e-3 * high ? 0.5 * (low + high) : sqrt(low * high);
        struct helmholtz_point point = helmholtz_at(self, self->analytic, rho, p);
        double found = helmholtz_T(self, point.spot, point.answer), square = rho * rho;
        if (self->way != HELMHOLTZ_BIQUINTIC) helmholtz_temperature(self, 1, &rho, &p, &found);
        double p_r = 2.0 * rho * point.spot.a_r + square * point.spot.a_rr, off = found - T;
        int inside = point.rho == rho && point.spot.side == 0.0;
        double next = inside ? rho + off * square * point.spot.a_rl / (point.spot.T * p_r) : 0.0;
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
        helmholtz_blocks_ask(self, HELMHOLTZ_THERMAL, m, (const double *const[2]){rho + i, p + i},
                             (double *const[2]){T, side});
        for (size_t k = 0; k < m; k++)
            count += !(rho[i + k] >= self->ends.thin && rho[i + k] <= self->ends.dense && side[k] == 0.0);
    }
    return count;
}

#define HELMHOLTZ_TABLE(range_function)                                                                                \
    {                                                                                                                  \
        .size = sizeof(struct bulla_eos), .state = helmholtz_state, .derivatives = helmholtz_derivatives,              \
        .temperature = helmholtz_temperature, .entropy = helmholtz_entropy, .density = helmholtz_density,              \
        .p_min = helmholtz_p_min, .range = (range_function), .energy = helmholtz_energy_slope,                         \
        .count_outside = helmholtz_count_outside, .thermal = helmholtz_thermal, .gas_constant = helmholtz_gas_constant \
    }

#endif
