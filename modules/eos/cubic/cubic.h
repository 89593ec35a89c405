/* cubic.h - point physics of cubic equations of state with a real ideal-gas heat: Peng-Robinson, RKPR.
 *
 *     p = R T/w - a(T) q,   q = 1/((v + d1 b)(v + d2 b)),   w = v - b,   L = integral of q from v
 *     e = e0(T) - (a - T a') L,   s = s0(T) + R ln w + a' L,   cv = cv0 + T a'' L,
 *     cp0/R = h + sum of n_i E(theta_i/T),   E(z) = z^2 e^z/(e^z - 1)^2,
 * zero of e: ideal gas at 0 K; zero of s: ideal gas at 298.15 K and 101325 Pa. (rho, p) -> T is a Newton
 * iteration: dp/dT > 0, and from T = (p + ac q) w/R it takes three steps. An including module first
 * defines its attraction a(T) as CUBIC_ATTRACTION(par, T), see cubic_rows.h.
 *
 * No state exists for v <= b, yet a solver gets there: below vx = b/0.98 w is continued so that 1/w is
 * linear in v, w = d/(1 + x), x = (vx - v)/d, d = vx - b (as family.h does). If d2 < 0, 1/Q has a pole at
 * v = -d2 b: q goes on linearly below vx too. Both come from a potential. Colder than t-min, where
 * the liquid's spinodal would come, everything goes linearly in p at constant density:
 *     e = e_b + (p - p_b)/(rho G_b),  T = T_b + (e - e_b)/cv_b,  c^2 = c_b^2 + (p - p_b)/rho (1 + G_b + dlnG_b/dln
 * rho), as long as that is positive and p is: a gas that attracts itself would bear tension when it is cold and
 * dense. */
#ifndef CUBIC_H
#define CUBIC_H

#include "shared/elementary.h"

#define CUBIC_EDGE 0.98       /* b/vx */
#define CUBIC_COLDEST 1.0     /* K: where the linear continuation would fall below */
#define CUBIC_STIFFENING 0.2  /* least 1 + G + dlnG/dln rho of the continuation */
#define CUBIC_GAS 8.314462618 /* J/mol/K */
#define CUBIC_ZERO_T 298.15   /* K */
#define CUBIC_ZERO_P 101325.0 /* Pa */
enum { CUBIC_MODES = 3 };

struct cubic {
    double R, Tc, ac, b, d1, d2;
    double shape; /* of alpha: m of Peng-Robinson, k of RKPR */
    double heat, n[CUBIC_MODES], theta[CUBIC_MODES];
    double T_min, entropy; /* the constant of s */
    double vx, d, v_pole;  /* where w is continued; where q is, 0: nowhere */
};

/* a(T) and its derivatives. */
struct cubic_attraction {
    double a, a1, a2;
};

/* What depends on density alone. */
struct cubic_room {
    double v, per_w, dper_w; /* 1/w and -d(1/w)/dv */
    double q, dq, L;         /* dq = -dq/dv */
};

/* A state of the potential; `stiffening` is 1 + G + dlnG/dln rho at constant T. */
struct cubic_point {
    double p, e, cv, G, c2, stiffening;
};

/* L = ln(1 + u)/((d1 - d2) b) with u = (d1 - d2) b/(v + d2 b), written so that d1 = d2 and small u are exact. */
ELEMENTARY_INLINE struct cubic_room cubic_room(const struct cubic *par, double rho)
{
    double v = 1.0 / rho, x = (par->vx - v) / par->d;
    int inside = x <= 0.0;
    double per_w = inside ? 1.0 / (v - par->b) : (1.0 + x) / par->d;
    double dper_w = inside ? per_w * per_w : 1.0 / (par->d * par->d);
    int whole = v >= par->v_pole;
    double at = whole ? v : par->v_pole, near = 1.0 / (at + par->d2 * par->b), far = 1.0 / (at + par->d1 * par->b);
    double y = 1.0 + (par->d1 - par->d2) * par->b * near, over = y - 1.0;
    double some = over == 0.0 ? 1.0 : over, ratio = elementary_log(y) / some;
    double q = near * far, dq = q * (near + far), L = near * (over == 0.0 ? 1.0 : ratio);
    double missing = at - v;
    return (struct cubic_room){v, per_w, dper_w, q + missing * dq, dq, L + missing * (q + 0.5 * missing * dq)};
}

/* 1 - e^-z without loss for small z. */
ELEMENTARY_INLINE double cubic_fade(double z)
{
    double series = z * (1.0 - z * (0.5 - z * (1.0 / 6.0 - z * (1.0 / 24.0 - z * (1.0 / 120.0)))));
    double whole = 1.0 - elementary_exp(-z);
    return z < 2e-3 ? series : whole;
}

/* e0/R, cv0/R, s0/R up to a constant */
struct cubic_ideal {
    double e, cv, s;
};

/* Adds one vibration. */
ELEMENTARY_INLINE void cubic_vibrate(double n, double theta, double T, struct cubic_ideal *sum)
{
    double z = theta / T, fade = cubic_fade(z), quanta = z * (1.0 - fade) / fade;
    sum->e += n * T * quanta;
    sum->cv += n * z * quanta / fade;
    sum->s += n * (quanta - elementary_log(fade));
}

ELEMENTARY_INLINE struct cubic_ideal cubic_ideal(const struct cubic *par, double T)
{
    double heat = par->heat - 1.0;
    struct cubic_ideal sum = {heat * T, heat, heat * elementary_log(T)};
    cubic_vibrate(par->n[0], par->theta[0], T, &sum);
    cubic_vibrate(par->n[1], par->theta[1], T, &sum);
    cubic_vibrate(par->n[2], par->theta[2], T, &sum);
    return sum;
}

ELEMENTARY_INLINE double cubic_pressure(const struct cubic *par, struct cubic_room room, double a, double T)
{
    return par->R * T * room.per_w - a * room.q;
}

ELEMENTARY_INLINE double cubic_p_T(const struct cubic *par, struct cubic_room room, double a1)
{
    return par->R * room.per_w - a1 * room.q;
}

/* s; below vx, ln w is continued as the integral of 1/w: ln d - x - x^2/2. */
ELEMENTARY_INLINE double cubic_entropy(const struct cubic *par, struct cubic_room room, double a1, double T)
{
    double x = (par->vx - room.v) / par->d, over = x > 0.0 ? x : 0.0;
    double w = x > 0.0 ? par->d : room.v - par->b;
    double volume = elementary_log(w) - over * (1.0 + 0.5 * over);
    return par->R * (cubic_ideal(par, T).s + volume) + a1 * room.L + par->entropy;
}

ELEMENTARY_INLINE struct cubic_point cubic_point(const struct cubic *par, struct cubic_room room,
                                                 struct cubic_attraction pull, double T)
{
    struct cubic_ideal ideal = cubic_ideal(par, T);
    double v = room.v, p_T = cubic_p_T(par, room, pull.a1);
    double cv = par->R * ideal.cv + T * pull.a2 * room.L, G = v * p_T / cv;
    double p_rho = v * v * (par->R * T * room.dper_w - pull.a * room.dq);
    double steeper = v * (par->R * room.dper_w - pull.a1 * room.dq) / p_T;
    return (struct cubic_point){.p = cubic_pressure(par, room, pull.a, T),
                                .e = par->R * ideal.e - (pull.a - T * pull.a1) * room.L,
                                .cv = cv,
                                .G = G,
                                .c2 = p_rho + v * T * p_T * G,
                                .stiffening = G + steeper - v * T * pull.a2 * room.q / cv};
}

#endif
