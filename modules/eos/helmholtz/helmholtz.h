/* helmholtz.h - a fluid by its Helmholtz energy, as reference equations of state give it.
 *
 *     a(rho, T)/(R T) = phi(delta, tau) = ln delta + ideal(tau) + sum of terms,  delta = rho/rho_c, tau = T_c/T.
 * Every term but the two critical ones of water is a product n f(delta) g(tau):
 *     f = delta^d exp(-delta^c)                  or  delta^d exp(-alpha (delta - epsilon)^2),
 *     g = tau^t                                  or  tau^t exp(-beta (tau - gamma)^2),
 * so derivatives of any order are products too and need no differences. The thermal coordinate is
 * l = ln T: with T d/dT = d/dl all thermodynamics is free of T (a is the energy per mass, v = 1/rho)
 *     p = rho^2 a_r,   e = a - a_l,   e_l = T cv = a_l - a_ll,   s = -a_l/T,
 *     (de/dp)_rho = e_l/p_l,   c^2 = p_r + p_l^2/(rho^2 e_l).
 * The part ln delta is kept apart (`gas`): in a table only what is left can be interpolated at small rho. */
#ifndef HELMHOLTZ_H
#define HELMHOLTZ_H

#include <math.h>
#include <string.h>

enum { HELMHOLTZ_R = 3, HELMHOLTZ_L = 4 }; /* derivatives kept: rho 0..2, l 0..3 */

struct helmholtz_term {
    double n;
    int d;
    double t;
    int c;                              /* 0: no exp(-delta^c) */
    double alpha, beta, gamma, epsilon; /* alpha = 0: no bell */
};

enum helmholtz_kind { HELMHOLTZ_POWER, HELMHOLTZ_LOG, HELMHOLTZ_EINSTEIN, HELMHOLTZ_MIXED };

/* n tau^t, n ln tau, n ln(1 - exp(-t tau)), n ln(2/3 + exp(t tau)) */
struct helmholtz_ideal {
    enum helmholtz_kind kind;
    double n, t;
};

struct helmholtz_fluid {
    double R, rho_c, T_c;
    const struct helmholtz_term *terms;
    const struct helmholtz_ideal *ideals;
    int n_term, n_ideal;
    /* Terms that are no product: adds their derivatives in delta and theta = ln tau; NULL: none. */
    void (*critical)(double delta, double theta, double phi[HELMHOLTZ_R][HELMHOLTZ_L]);
};

static inline double helmholtz_power(double base, int exponent)
{
    double power = 1.0;
    for (int k = exponent < 0 ? -exponent : exponent; k > 0; k >>= 1, base *= base)
        if (k & 1) power *= base;
    return exponent < 0 ? 1.0 / power : power;
}

/* n f, n f', n f'': with w = delta (ln exp part)', f' = delta^(d-1) (d - w) exp(..), and so on. */
static inline void helmholtz_density_part(const struct helmholtz_term *term, double delta, double f[HELMHOLTZ_R])
{
    double off = delta - term->epsilon, x = term->c ? helmholtz_power(delta, term->c) : 0.0;
    double w = term->alpha > 0.0 ? 2.0 * term->alpha * delta * off : term->c * x;
    double w_slope = term->alpha > 0.0 ? 2.0 * term->alpha * delta * (delta + off) : (double)(term->c * term->c) * x;
    double fade = term->alpha > 0.0 ? exp(-term->alpha * off * off) : term->c ? exp(-x) : 1.0;
    double size = term->n * fade, d = term->d;
    f[0] = size * helmholtz_power(delta, term->d);
    f[1] = size * helmholtz_power(delta, term->d - 1) * (d - w);
    f[2] = size * helmholtz_power(delta, term->d - 2) * ((d - 1.0 - w) * (d - w) - w_slope);
}

/* g and its derivatives in theta = ln tau, from u = ln g: u1 = u', ... */
static inline void helmholtz_thermal_part(const struct helmholtz_term *term, double theta, double g[HELMHOLTZ_L])
{
    double u = term->t * theta, u1 = term->t, u2 = 0.0, u3 = 0.0;
    if (term->alpha > 0.0) {
        double tau = exp(theta), off = tau - term->gamma, two = 2.0 * term->beta * tau;
        u -= term->beta * off * off;
        u1 -= two * off;
        u2 = -two * (tau + off);
        u3 = -two * (3.0 * tau + off);
    }
    g[0] = exp(u);
    g[1] = g[0] * u1;
    g[2] = g[0] * (u1 * u1 + u2);
    g[3] = g[0] * (u1 * u1 * u1 + 3.0 * u1 * u2 + u3);
}

/* One term of the ideal part and its derivatives in theta; z = t tau, dz/dtheta = z. */
static inline void helmholtz_ideal_term(const struct helmholtz_ideal *term, double theta, double g[HELMHOLTZ_L])
{
    double n = term->n, t = term->t, z = t * exp(theta), fall = exp(-z);
    if (term->kind == HELMHOLTZ_POWER) {
        double power = n * exp(t * theta);
        for (int k = 0; k < HELMHOLTZ_L; k++, power *= t) g[k] = power;
    } else if (term->kind == HELMHOLTZ_LOG) {
        memcpy(g, (double[HELMHOLTZ_L]){n * theta, n, 0.0, 0.0}, HELMHOLTZ_L * sizeof *g);
    } else if (term->kind == HELMHOLTZ_EINSTEIN) {
        double rest = -expm1(-z), b = z * fall / rest, heat = b * z / rest;
        memcpy(g,
               (double[HELMHOLTZ_L]){n * log(rest), n * b, n * (b - heat), n * (b - heat * (3.0 + z - 2.0 * z / rest))},
               HELMHOLTZ_L * sizeof *g);
    } else {
        double S = 1.0 / (1.0 + 2.0 / 3.0 * fall), zS = z * S, zz = z * zS * (1.0 - S);
        memcpy(g,
               (double[HELMHOLTZ_L]){n * (z + log1p(2.0 / 3.0 * fall)), n * zS, n * (zS + zz),
                                     n * (zS + 3.0 * zz + z * zz * (1.0 - 2.0 * S))},
               HELMHOLTZ_L * sizeof *g);
    }
}

static inline void helmholtz_ideal_part(const struct helmholtz_fluid *fluid, double theta, double g[HELMHOLTZ_L])
{
    memset(g, 0, HELMHOLTZ_L * sizeof *g);
    for (int i = 0; i < fluid->n_ideal; i++) {
        double part[HELMHOLTZ_L];
        helmholtz_ideal_term(&fluid->ideals[i], theta, part);
        for (int k = 0; k < HELMHOLTZ_L; k++) g[k] += part[k];
    }
}

/* phi without ln delta -> a without R T ln delta: T (d/dl)^k phi(theta = const - l) = T (1 - d/dtheta)^k phi. */
static inline void helmholtz_energy(const struct helmholtz_fluid *fluid, double l,
                                    const double phi[HELMHOLTZ_R][HELMHOLTZ_L], double a[HELMHOLTZ_R][HELMHOLTZ_L])
{
    double size = fluid->R * exp(l);
    for (int i = 0; i < HELMHOLTZ_R; i++, size /= fluid->rho_c) {
        const double *f = phi[i];
        a[i][0] = size * f[0];
        a[i][1] = size * (f[0] - f[1]);
        a[i][2] = size * (f[0] - 2.0 * f[1] + f[2]);
        a[i][3] = size * (f[0] - 3.0 * (f[1] - f[2]) - f[3]);
    }
}

/* a[i][k]: derivatives of the Helmholtz energy, i times in rho, k times in l, without R T ln delta. */
static inline void helmholtz_potential(const struct helmholtz_fluid *fluid, double rho, double l,
                                       double a[HELMHOLTZ_R][HELMHOLTZ_L])
{
    double delta = rho / fluid->rho_c, theta = log(fluid->T_c) - l, phi[HELMHOLTZ_R][HELMHOLTZ_L] = {{0}};
    helmholtz_ideal_part(fluid, theta, phi[0]);
    for (int m = 0; m < fluid->n_term; m++) {
        double f[HELMHOLTZ_R], g[HELMHOLTZ_L];
        helmholtz_density_part(&fluid->terms[m], delta, f);
        helmholtz_thermal_part(&fluid->terms[m], theta, g);
        for (int i = 0; i < HELMHOLTZ_R; i++)
            for (int k = 0; k < HELMHOLTZ_L; k++) phi[i][k] += f[i] * g[k];
    }
    if (fluid->critical) fluid->critical(delta, theta, phi);
    helmholtz_energy(fluid, l, phi, a);
}

#endif
