/* modified_tait.h - point physics of the modified Tait liquid (modified_tait.c).
 *
 *     p = B(T) ((rho/(rho0 f(T)))^n - 1),   B = A (300 K/T)^s,   f = 1 - b tanh((T - T1)/T2)
 * with a specific heat C(T) along p = 0 follows from one potential,
 *     a(rho, T) = B y/((n - 1) rho) + B/rho [- n/(n - 1) B/(rho0 f)] + H(T) - T S(T),   y = (rho/(rho0 f))^n,
 * H and S the integrals of C and C/T from 273.16 K; the term in brackets with `reduced` (V of the Gibbs
 * potential vanishes at p = 0). All else are derivatives of a; L1, L2 and M1, M2 are the first two of
 * ln(B f^-n) and ln(B/f) in T.
 *
 * (rho, p) -> T is a Newton iteration, as p grows with T in the rectangle of densities and temperatures
 * that `open` has checked; beyond it the rules of continuation.h hold. */
#ifndef MODIFIED_TAIT_H
#define MODIFIED_TAIT_H

#include "shared/continuation.h"

#define MODIFIED_TAIT_START 273.16

/* What depends on T alone or enters with y. */
struct modified_tait_heat {
    double B, y, L1, L2, M1, M2, W;
};

struct modified_tait {
    double A, s, n, rho0, b, T1, T2, C[4], reduced, h0, s0;
    double T_min, T_max, T_dense; /* T_max falls to T_dense over the last 15 % of densities */
    double rho_min, rho_max;
    struct continuation_ends ends;
    struct modified_tait_heat cold; /* at T_min and rho0 */
};

ELEMENTARY_INLINE struct modified_tait_heat modified_tait_heat(const struct modified_tait *par, double log_x, double T)
{
    double t = elementary_tanh((T - par->T1) / par->T2), d = (1.0 - t * t) / par->T2;
    double f = 1.0 - par->b * t, per_f = 1.0 / f, per_T = 1.0 / T;
    double q1 = -par->b * d * per_f, q2 = 2.0 * par->b * t * d / par->T2 * per_f - q1 * q1;
    double B = par->A * elementary_exp(par->s * elementary_log(300.0 * per_T));
    double y = elementary_exp(par->n * (log_x - elementary_log(f)));
    double L1 = -par->s * per_T - par->n * q1, L2 = par->s * per_T * per_T - par->n * q2;
    double M1 = -par->s * per_T - q1, M2 = par->s * per_T * per_T - q2;
    double W = -par->reduced * par->n / (par->n - 1.0) * B / par->rho0 * per_f;
    return (struct modified_tait_heat){B, y, L1, L2, M1, M2, W};
}

/* The same at T_min for less. */
ELEMENTARY_INLINE struct modified_tait_heat modified_tait_cold(const struct modified_tait *par, double log_x)
{
    struct modified_tait_heat heat = par->cold;
    heat.y *= elementary_exp(par->n * log_x);
    return heat;
}

ELEMENTARY_INLINE double modified_tait_pressure(struct modified_tait_heat heat)
{
    return heat.B * (heat.y - 1.0);
}

/* dp/dT at constant rho */
ELEMENTARY_INLINE double modified_tait_p_T(const struct modified_tait *par, struct modified_tait_heat heat, double T)
{
    return heat.B * (heat.L1 * heat.y + par->s / T);
}

/* The heat C along p = 0 and its integrals. */
ELEMENTARY_INLINE double modified_tait_C(const struct modified_tait *par, double T)
{
    double t = T - 300.0;
    return par->C[0] + t * (par->C[1] + t * (par->C[2] + t * par->C[3]));
}

ELEMENTARY_INLINE double modified_tait_H(const struct modified_tait *par, double T)
{
    double t = T - 300.0, z = MODIFIED_TAIT_START - 300.0;
    double high = t * (par->C[0] + t * (par->C[1] / 2.0 + t * (par->C[2] / 3.0 + t * par->C[3] / 4.0)));
    double low = z * (par->C[0] + z * (par->C[1] / 2.0 + z * (par->C[2] / 3.0 + z * par->C[3] / 4.0)));
    return high - low;
}

/* C as a polynomial in T first, then term by term. */
ELEMENTARY_INLINE double modified_tait_S(const struct modified_tait *par, double T)
{
    const double *C = par->C, m = -300.0, z = MODIFIED_TAIT_START;
    double a0 = C[0] + m * (C[1] + m * (C[2] + m * C[3])), a1 = C[1] + m * (2.0 * C[2] + m * 3.0 * C[3]);
    double a2 = C[2] + 3.0 * m * C[3], a3 = C[3];
    double high = T * (a1 + T * (a2 / 2.0 + T * a3 / 3.0)), low = z * (a1 + z * (a2 / 2.0 + z * a3 / 3.0));
    return a0 * elementary_log(T / z) + (high - low);
}

ELEMENTARY_INLINE double modified_tait_potential_entropy(const struct modified_tait *par,
                                                         struct modified_tait_heat heat, double rho, double T)
{
    double work = heat.B * (heat.y * heat.L1 / (par->n - 1.0) - par->s / T) / rho + heat.W * heat.M1;
    return modified_tait_S(par, T) + par->s0 - work;
}

ELEMENTARY_INLINE struct continuation_point modified_tait_point(const struct modified_tait *par,
                                                                struct modified_tait_heat heat, double rho, double T)
{
    double n1 = par->n - 1.0, cold = heat.B * heat.y / (n1 * rho), rest = heat.B / rho;
    double L = heat.L1 * heat.L1 + heat.L2, M = heat.M1 * heat.M1 + heat.M2, s = par->s;
    double e = cold * (1.0 - T * heat.L1) + rest * (1.0 + s) + heat.W * (1.0 - T * heat.M1);
    double cv = modified_tait_C(par, T) - (cold * L + heat.W * M) * T - rest * s * (s + 1.0) / T;
    double p_T = modified_tait_p_T(par, heat, T), G = p_T / (rho * cv);
    double p_rho = par->n * heat.B * heat.y / rho;
    double steeper = par->n * heat.B * heat.L1 * heat.y / p_T;
    double lazier = (cold * n1 * L * T - rest * s * (s + 1.0) / T) / cv; /* -dln cv/dln rho */
    return (struct continuation_point){.p = modified_tait_pressure(heat),
                                       .e = e + modified_tait_H(par, T) + par->h0,
                                       .cv = cv,
                                       .G = G,
                                       .c2 = p_rho + T * p_T * p_T / (rho * rho * cv),
                                       .stiffening = G + steeper + lazier};
}

/* dlnG/dT at constant rho, from the third derivatives of ln(B f^-n) and ln(B/f). */
ELEMENTARY_INLINE double modified_tait_G_T(const struct modified_tait *par, struct modified_tait_heat heat,
                                           struct continuation_point at, double rho, double T)
{
    double t = elementary_tanh((T - par->T1) / par->T2), per_T = 1.0 / T, s = par->s, warm = T - 300.0;
    double q1 = -s * per_T - heat.M1, q2 = s * per_T * per_T - heat.M2;
    double q3 = -q1 * (2.0 / (par->T2 * par->T2) * (1.0 - 3.0 * t * t) + 3.0 * q2 + q1 * q1);
    double third = -2.0 * s * per_T * per_T * per_T, L3 = third - par->n * q3, M3 = third - q3;
    double cold = heat.B * heat.y / ((par->n - 1.0) * rho), rest = heat.B / rho, bend = s * (s + 1.0) * per_T * per_T;
    double L = heat.L1 * heat.L1 + heat.L2, M = heat.M1 * heat.M1 + heat.M2;
    double L_T = heat.L1 * L + 2.0 * heat.L1 * heat.L2 + L3, M_T = heat.M1 * M + 2.0 * heat.M1 * heat.M2 + M3;
    double C_T = par->C[1] + warm * (2.0 * par->C[2] + warm * 3.0 * par->C[3]);
    double cv_T = C_T - (cold * (L + T * L_T) + heat.W * (M + T * M_T)) + rest * bend * (s + 1.0);
    return heat.B * (heat.y * L - bend) / modified_tait_p_T(par, heat, T) - cv_T / at.cv;
}

/* The upper end of T at a density. */
ELEMENTARY_INLINE double modified_tait_T_max(const struct modified_tait *par, double rho)
{
    double reach = (par->rho_max - rho) * (1.0 / (0.15 * par->rho_max));
    double T = par->T_dense + (par->T_max - par->T_dense) * reach;
    return T < par->T_max ? T : par->T_max;
}

/* A point for continuations: on the upper end of T, which falls with rho, G changes along it. */
ELEMENTARY_INLINE struct continuation_point modified_tait_edge(const struct modified_tait *par,
                                                               struct modified_tait_heat heat, double rho, double T)
{
    struct continuation_point at = modified_tait_point(par, heat, rho, T);
    double T_max = modified_tait_T_max(par, rho), falls = (par->T_dense - par->T_max) / (0.15 * par->rho_max);
    double along = rho * falls * modified_tait_G_T(par, heat, at, rho, T);
    along = T < T_max ? 0.0 : along;
    at.stiffening += T_max < par->T_max ? along : 0.0;
    return at;
}

#endif
