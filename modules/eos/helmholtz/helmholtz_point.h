/* helmholtz_point.h - an instance of a law that is given by a Helmholtz energy, and one point of it: where its tables
 * or formulas are asked, what holds beyond the densities of the domain, what rows are asked for.
 *
 * The including module first defines HELMHOLTZ_GAS: 1 keeps R T ln rho out of the table, so that densities may go to
 * zero: below ends.thin it is an ideal gas, in which all depends on p/rho, asked at ends.thin; and HELMHOLTZ_SKEW of
 * helmholtz_band.h, if its rows are to be equally spaced in a logarithm. */
#ifndef HELMHOLTZ_POINT_H
#define HELMHOLTZ_POINT_H

#include "bulla/eos.h"
#include "helmholtz_direct.h"
#include "helmholtz_find.h"

#define HELMHOLTZ_NOTHING 1e-100 /* [kg/m3]: less is as much */

/* Between nodes: the potential, or e, c^2 and T themselves. */
enum helmholtz_way { HELMHOLTZ_BIQUINTIC, HELMHOLTZ_BICUBIC, HELMHOLTZ_BILINEAR };

struct helmholtz {
    struct helmholtz_grid grid; /* a copy, as `direct`: their arrays belong to the shared table */
    struct helmholtz_direct direct;
    struct helmholtz_ends ends;
    const struct helmholtz_law *law;
    int analytic;
    enum helmholtz_way way;
};

/* The density at which a table is asked ... */
PATCH_INLINE double helmholtz_held(const struct helmholtz_ends *ends, double rho)
{
    double held = rho > ends->thin ? rho : ends->thin;
    return held < ends->dense ? held : ends->dense;
}

/* How much thinner than ends.thin a gas is, down to nothing. */
PATCH_INLINE double helmholtz_rare(const struct helmholtz_ends *ends, double rho)
{
    double least = rho > HELMHOLTZ_NOTHING ? rho : HELMHOLTZ_NOTHING;
    return HELMHOLTZ_GAS && least < ends->thin ? ends->thin / least : 1.0;
}

/* ... and the pressure. */
PATCH_INLINE double helmholtz_asked_p(const struct helmholtz_ends *ends, double rho, double p)
{
    return helmholtz_dense_p(ends, rho, p) * helmholtz_rare(ends, rho);
}

/* One point: the density and pressure at which the potential is asked, and what it says. */
struct helmholtz_point {
    double rho, p;
    struct helmholtz_spot spot;
    struct helmholtz_answer answer;
};

/* The potential of the table at one point. */
static inline struct helmholtz_point helmholtz_table_point(const struct helmholtz *self, double rho, double p)
{
    const struct helmholtz_grid *grid = &self->grid;
    struct helmholtz_point point = {.rho = helmholtz_held(&self->ends, rho),
                                    .p = helmholtz_asked_p(&self->ends, rho, p)};
    struct helmholtz_row row = helmholtz_band_row(&grid->band, point.rho);
    struct helmholtz_level level = helmholtz_band_level(&grid->band, row, point.rho, point.p);
    struct helmholtz_rung rung = helmholtz_rung(&grid->steps, level.y);
    struct helmholtz_start start = helmholtz_start(grid, helmholtz_start_at(grid, row, rung));
    point.spot = helmholtz_find(grid, HELMHOLTZ_GAS, 0, row, level, start, point.rho);
    return point;
}

/* From the root in the table to that of the formulas, held in the domain; a NaN ends the search. */
static inline struct helmholtz_point helmholtz_exact_point(const struct helmholtz *self, double rho, double p)
{
    struct helmholtz_point point = helmholtz_table_point(self, rho, p);
    double slope = 0.0, square = point.rho * point.rho, high = self->grid.l_high;
    double low = helmholtz_cold(&self->grid, point.rho, &slope);
    double l = point.spot.l > low ? point.spot.l : low;
    l = l < high ? l : high;
    for (int round = 0; round < 12; round++) {
        point.spot = helmholtz_exact(self->law->fluid, HELMHOLTZ_GAS, point.rho, l);
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
PATCH_INLINE double helmholtz_stiffness(const struct helmholtz *self, double c2, double rho, double p)
{
    return p > self->ends.p_min ? rho * c2 : p - self->ends.p_min;
}

PATCH_INLINE double helmholtz_warm(const struct helmholtz *self, double T)
{
    return T > self->ends.T_min ? T : self->ends.T_min;
}

PATCH_INLINE double helmholtz_T(const struct helmholtz *self, struct helmholtz_spot spot,
                                struct helmholtz_answer answer)
{
    return helmholtz_warm(self, spot.T * (1.0 + answer.rise));
}

/* On from the spot at constant rho with its cv; for the thin rule at constant p with the T of its last density. */
static inline double helmholtz_s(const struct helmholtz *self, struct helmholtz_point point, double rho, double p)
{
    double start = point.spot.T, T = helmholtz_T(self, point.spot, point.answer), g = self->ends.gamma;
    double s = (point.answer.cv * log(T / start) - point.spot.a_l) / start;
    double held = point.rho / helmholtz_rare(&self->ends, rho);
    if (HELMHOLTZ_GAS) return s - self->grid.R * log(held / self->law->fluid->rho_c);
    double more = rho < self->ends.thin ? 1.0 / rho - 1.0 / self->ends.thin : 0.0;
    return s + more * g / (g - 1.0) * (p + self->ends.pull) / T;
}

/* Beyond the densities of the domain. `inside` (a constant in loops): not there. */
PATCH_INLINE struct helmholtz_answer helmholtz_beyond(const struct helmholtz *self, const int inside,
                                                      struct helmholtz_answer answer, double rho, double p)
{
    if (inside) return answer;
    double rare = helmholtz_rare(&self->ends, rho);
    answer = helmholtz_dense(&self->ends, answer, rho, p);
    answer.e_p *= rare;
    answer.e_r *= rare;
    return HELMHOLTZ_GAS ? answer : helmholtz_thin(&self->ends, answer, rho, p);
}

/* All that the potential says at one point of the caller's coordinates, of the table or of the formulas. */
static inline struct helmholtz_point helmholtz_at(const struct helmholtz *self, int exact, double rho, double p)
{
    struct helmholtz_point point = exact ? helmholtz_exact_point(self, rho, p) : helmholtz_table_point(self, rho, p);
    point.answer = helmholtz_answer(point.spot, 0, point.rho, 1.0 / point.rho, point.p);
    point.answer = helmholtz_beyond(self, 0, point.answer, rho, p);
    return point;
}

/* What rows are asked for; a constant in loops. */
enum helmholtz_want { HELMHOLTZ_STATE, HELMHOLTZ_DERIVATIVES, HELMHOLTZ_ENERGY, HELMHOLTZ_THERMAL, HELMHOLTZ_WANTS };

/* Two numbers: rho e and rho c^2; d(rho e)/dp and d(rho e)/drho; rho e and d(rho e)/dp; T and where the search ended, 0
 * within the formulas. */
struct helmholtz_pair {
    double a, b;
};

PATCH_INLINE struct helmholtz_pair helmholtz_pair(const struct helmholtz *self, const enum helmholtz_want want,
                                                  struct helmholtz_answer at, double rho, double p)
{
    if (want == HELMHOLTZ_STATE) return (struct helmholtz_pair){rho * at.e, helmholtz_stiffness(self, at.c2, rho, p)};
    if (want == HELMHOLTZ_DERIVATIVES) return (struct helmholtz_pair){rho * at.e_p, at.e + rho * at.e_r};
    return (struct helmholtz_pair){rho * at.e, rho * at.e_p};
}

#endif
