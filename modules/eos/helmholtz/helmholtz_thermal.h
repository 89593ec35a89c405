/* helmholtz_thermal.h - everything from pressure and temperature, for phase change: (p, l) -> rho, l = ln T.
 *
 * At fixed l the root of rho^2 a_r = p by Newton's method; p is convex in the density of a liquid and nearly straight
 * in that of a gas, so a start on the dense side of a liquid's root (the thin side of a gas's) runs to it. Then, with
 * p_l = rho^2 a_rl and p_r = (dp/drho)_T, v_p = -1/(rho^2 p_r),   v_T = p_l/(T rho^2 p_r),   c_p = e_l/T + p_l^2/(T
 * rho^2 p_r),   h = a - a_l + p/rho,   s = -a_l/T. A vapour's start may lie beyond its spinodal, in the dome or among
 * liquids: what comes from there does not count, and the search begins once more from the ideal gas, which is thinner
 * than any real one: p is concave from there on. Close to the root, at P = rho^2 a_r, Taylor's series in p - P gives
 * the same as another look at the potential: g = a + P/rho + v (p - P) + v_p (p - P)^2/2,   s = -a_l/T - v_T (p - P),
 * h = g + T s. All of one potential: the table's, with `eval: analytic` the formulas'. Beyond the edges of the domain
 * there is no state, only NaN: continuations in p are no potentials. */
#ifndef HELMHOLTZ_THERMAL_H
#define HELMHOLTZ_THERMAL_H

#include "helmholtz_point.h"

enum { HELMHOLTZ_THERMAL_ROUNDS = 60 };

#define HELMHOLTZ_THERMAL_HELD 0.64   /* of the last density: a start for liquids, beyond all but compressed ones */
#define HELMHOLTZ_THERMAL_NEAR 1e-9   /* relative step of rho whose square is nothing */
#define HELMHOLTZ_THERMAL_BESIDE 1e-3 /* of T beyond an edge that is still the domain */

/* One isotherm: a and its first two derivatives in l over the density within one cell, as polynomials. A search stays
 * in a cell or two. */
struct helmholtz_isotherm {
    double l, RT;
    int i; /* row of the cell, -1: none yet */
    struct helmholtz_six a, l1, l2;
};

static inline void helmholtz_isotherm_row(const struct helmholtz_grid *grid, int i, struct helmholtz_isotherm *line)
{
    struct helmholtz_start start = helmholtz_start(grid, (line->l - grid->l_0) * grid->per_l);
    const double *cell = grid->cell + helmholtz_grid_cell(grid, i, start.j);
    double f[3][6];
    for (int m = 0; m < 6; m++) {
        const double *c = cell + 6 * m;
        struct helmholtz_jet jet = helmholtz_jet((struct helmholtz_six){c[0], c[1], c[2], c[3], c[4], c[5]}, start.z);
        f[0][m] = jet.f0;
        f[1][m] = jet.f1 * grid->per_l;
        f[2][m] = 2.0 * jet.f2 * grid->per_l * grid->per_l;
    }
    line->i = i;
    line->a = (struct helmholtz_six){f[0][0], f[0][1], f[0][2], f[0][3], f[0][4], f[0][5]};
    line->l1 = (struct helmholtz_six){f[1][0], f[1][1], f[1][2], f[1][3], f[1][4], f[1][5]};
    line->l2 = (struct helmholtz_six){f[2][0], f[2][1], f[2][2], f[2][3], f[2][4], f[2][5]};
}

/* The potential at a density of the isotherm, without third derivatives; a, a_l and a_ll of a gas without R T
 * ln(rho/rho_c), which only the root is asked for. */
static inline struct helmholtz_spot helmholtz_thermal_spot(const struct helmholtz *self,
                                                           struct helmholtz_isotherm *line, double rho)
{
    struct helmholtz_spot spot;
    if (self->analytic) {
        spot = helmholtz_exact(self->law->fluid, HELMHOLTZ_GAS, rho, line->l);
    } else {
        struct helmholtz_row row = helmholtz_band_row(&self->grid.band, rho);
        double per_rho = 1.0 / rho, per = helmholtz_band_per(&self->grid.band, per_rho);
        double fall = helmholtz_band_fall(per_rho);
        if (row.i != line->i) helmholtz_isotherm_row(&self->grid, row.i, line);
        struct helmholtz_jet a = helmholtz_jet(line->a, row.x), l1 = helmholtz_jet(line->l1, row.x);
        spot = (struct helmholtz_spot){.a = a.f0,
                                       .a_l = l1.f0,
                                       .a_ll = helmholtz_jet(line->l2, row.x).f0,
                                       .a_r = a.f1 * per,
                                       .a_rl = l1.f1 * per,
                                       .a_rr = 2.0 * a.f2 * per * per - fall * per * a.f1};
        spot = HELMHOLTZ_GAS ? helmholtz_with_gas(spot, per_rho, line->RT) : spot;
    }
    return spot;
}

static inline double helmholtz_thermal_stiff(const struct helmholtz_spot *spot, double rho)
{
    return rho * (2.0 * spot->a_r + rho * spot->a_rr);
}

/* The potential close to a root, which lies `step` further; rho NaN: none found. */
struct helmholtz_root {
    double rho, step, stiff;
    struct helmholtz_spot spot;
};

/* The root at p of the isotherm from a guess, or from where a Newton iteration is safe. */
static inline struct helmholtz_root helmholtz_thermal_root(const struct helmholtz *self,
                                                           struct helmholtz_isotherm *line, double p, double guess)
{
    const struct helmholtz_root none = {.rho = (double)NAN};
    double low = self->ends.thin, high = self->ends.dense, thin = p / line->RT;
    double held = HELMHOLTZ_GAS ? thin < 0.9 * high ? thin : 0.9 * high : HELMHOLTZ_THERMAL_HELD * high;
    double rho = guess > low && guess < high ? guess : held;
    for (int round = 0; round < HELMHOLTZ_THERMAL_ROUNDS; round++) {
        struct helmholtz_spot spot = helmholtz_thermal_spot(self, line, rho);
        double stiff = helmholtz_thermal_stiff(&spot, rho), step = (p - rho * rho * spot.a_r) / stiff;
        if (!(stiff > 0.0)) { /* beyond the spinodal: once more from the safe side, if that is not where it came from */
            if (HELMHOLTZ_GAS || !(rho < held) || !(guess > 0.0)) return none;
            rho = held;
            guess = 0.0;
            continue;
        }
        double next = rho + step;
        if (fabs(step) <= HELMHOLTZ_THERMAL_NEAR * rho) return (struct helmholtz_root){rho, step, stiff, spot};
        next = next < high ? next : 0.5 * (rho + high);
        rho = next > low ? next : 0.5 * (rho + low);
    }
    return none;
}

/* Does the domain hold (rho, l)? */
static inline int helmholtz_thermal_holds(const struct helmholtz *self, double rho, double l)
{
    double unused, low = helmholtz_cold(&self->grid, rho, &unused);
    return l >= low - HELMHOLTZ_THERMAL_BESIDE && l <= self->grid.l_high + HELMHOLTZ_THERMAL_BESIDE;
}

/* The same, within the domain. */
static inline struct helmholtz_root helmholtz_thermal_find(const struct helmholtz *self,
                                                           struct helmholtz_isotherm *line, double p, double guess)
{
    struct helmholtz_root root = helmholtz_thermal_root(self, line, p, guess);
    if (helmholtz_thermal_holds(self, root.rho, line->l)) return root;
    root.rho = (double)NAN;
    if (HELMHOLTZ_FLAT || !HELMHOLTZ_GAS || !(guess > 0.0)) return root;
    root = helmholtz_thermal_root(self, line, p, 0.0);
    if (!helmholtz_thermal_holds(self, root.rho, line->l)) root.rho = (double)NAN;
    return root;
}

static void helmholtz_thermal(const void *instance, size_t n, const double *BULLA_RESTRICT p,
                              const double *BULLA_RESTRICT T, double *BULLA_RESTRICT rho, double *BULLA_RESTRICT v,
                              double *BULLA_RESTRICT h, double *BULLA_RESTRICT s, double *BULLA_RESTRICT v_T,
                              double *BULLA_RESTRICT v_p, double *BULLA_RESTRICT c_p)
{
    const struct helmholtz *self = instance;
    for (size_t i = 0; i < n; i++) {
        struct helmholtz_isotherm line = {.l = log(T[i]), .RT = self->grid.R * T[i], .i = -1};
        struct helmholtz_root root = helmholtz_thermal_find(self, &line, p[i], rho[i]);
        double at = root.rho, per_T = 1.0 / T[i];
        rho[i] = v[i] = h[i] = s[i] = v_T[i] = v_p[i] = c_p[i] = at;
        if (!(at > 0.0)) continue;
        double square = at * at, p_l = square * root.spot.a_rl, soft = 1.0 / (square * root.stiff);
        double lift = HELMHOLTZ_GAS ? line.RT * log(at / self->law->fluid->rho_c) : 0.0;
        double grows = p_l * soft * per_T, over = p[i] - square * root.spot.a_r;
        double warm = root.spot.a_l + lift; /* a_l, whole */
        rho[i] = at + root.step;
        v[i] = 1.0 / rho[i];
        v_T[i] = grows;
        v_p[i] = -soft;
        h[i] = root.spot.a - root.spot.a_l + at * root.spot.a_r + over * (1.0 / at - T[i] * grows - 0.5 * over * soft);
        s[i] = -warm * per_T - grows * over;
        c_p[i] = (root.spot.a_l - root.spot.a_ll + p_l * p_l * soft) * per_T;
    }
}

static double helmholtz_gas_constant(const void *instance)
{
    const struct helmholtz *self = instance;
    return HELMHOLTZ_GAS ? self->grid.R : 0.0;
}

#endif
