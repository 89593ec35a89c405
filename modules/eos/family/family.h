/* family.h - point physics of one family: ideal gas, stiffened gas, NASG, MNASG.
 *
 * One set of formulas with the parameters (gamma, p_inf, b, q, cv); v = 1/rho:
 *     rho e = (p + p_inf) rho w/(gamma - 1) + p_inf (1 - b rho) + q rho,
 *     T = w (p + p_inf)/((gamma - 1) cv),     c^2 = v^2 (p + p_inf)(gamma - 1 + w')/w,
 * where w(v) is the free volume v - b (Le Metayer & Saurel, Phys. Fluids 28 (2016) 046102).
 * No state exists for v <= b, yet a solver gets there, so w is continued below vx = b/0.98 by
 *     w = d/(1 + x),  x = (vx - v)/d,  d = vx - b,  w' = dw/dv = 1/(1 + x)^2.
 * This derives from a potential like the rest, so the thermodynamics stay exact; p is
 * continuously differentiable, c^2 > 0 for every density, and all is still linear in p.
 * Formulas use r = b rho, never v, so that b = 0 and small densities lose no digits. */
#ifndef FAMILY_H
#define FAMILY_H

#include "shared/elementary.h"

#include <math.h>

#define FAMILY_EDGE 0.98                            /* b/vx */
#define FAMILY_D (1.0 / FAMILY_EDGE - 1.0)          /* d/b */
#define FAMILY_REACH (FAMILY_D + 1.0 / FAMILY_EDGE) /* (d + vx)/b */

struct family {
    double gamma, p_inf, b, q, cv;
    double q_s;     /* zero of the entropy, q' */
    double inverse; /* 1/(gamma - 1) */
};

/* How much volume is free at one density. */
struct family_room {
    double free;  /* 1 - b rho */
    double w;     /* rho w: `free` up to the edge */
    double slope; /* w': 1 up to the edge */
};

/* All of it: no co-volume. */
static inline struct family_room family_room_all(const struct family *par, double rho)
{
    (void)par, (void)rho;
    return (struct family_room){1.0, 1.0, 1.0};
}

/* What a co-volume leaves. Beyond the edge 1 + x = y/t with t = d rho, y = (d + vx) rho - 1. */
static inline struct family_room family_room_left(const struct family *par, double rho)
{
    double r = par->b * rho, free = 1.0 - r;
    double t = FAMILY_D * r, y = FAMILY_REACH * r - 1.0;
    int inside = r <= FAMILY_EDGE;
    double ratio = t / (inside ? 1.0 : y);
    return (struct family_room){free, inside ? free : t * ratio, inside ? 1.0 : ratio * ratio};
}

/* rho e = a p + b: the slope a = d(rho e)/dp = rho w/(gamma - 1) ... */
static inline double family_slope(const struct family *par, struct family_room room)
{
    return room.w * par->inverse;
}

/* ... and the rest: b = p_inf (a + 1 - b rho) + q rho. */
static inline double family_rest(const struct family *par, struct family_room room, double rho)
{
    return par->p_inf * (room.w * par->inverse + room.free) + par->q * rho;
}

/* rho c^2 = (p + p_inf)(gamma - 1 + w')/(rho w) */
static inline double family_stiffness(const struct family *par, struct family_room room, double p)
{
    return (p + par->p_inf) * (par->gamma - (1.0 - room.slope)) / room.w;
}

/* d(rho e)/drho at constant p, with d(rho w)/drho = (rho w - w')/rho, which is -b up to the edge. */
static inline double family_de_drho(const struct family *par, struct family_room room, double rho, double p)
{
    double widening = room.slope < 1.0 ? (room.w - room.slope) / rho : -par->b;
    return (p + par->p_inf) * par->inverse * widening - par->p_inf * par->b + par->q;
}

/* T = w (p + p_inf)/((gamma - 1) cv) */
static inline double family_temperature(const struct family *par, struct family_room room, double rho, double p)
{
    return room.w * par->inverse * (p + par->p_inf) / (rho * par->cv);
}

/* s = cv (ln T + (gamma - 1)(integral of dv/w - ln((gamma - 1) cv))): the constant makes it
 * cv ln(T^gamma/(p + p_inf)^(gamma - 1)) + q' up to the edge; beyond, the integral is ln d - x - x^2/2. */
static inline double family_entropy(const struct family *par, struct family_room room, double rho, double p)
{
    double T = family_temperature(par, room, rho, p), scale = par->cv / par->inverse;
    double x = 1.0 / sqrt(room.slope) - 1.0;
    double volume = room.slope < 1.0 ? FAMILY_D * par->b : room.w / rho;
    return par->cv * (log(T) + (log(volume / scale) - x * (1.0 + 0.5 * x)) / par->inverse) + par->q_s;
}

/* rho(p, T) from w = (gamma - 1) cv T/(p + p_inf): v = w + b, beyond the edge v = vx + d - d^2/w. */
static inline double family_density(const struct family *par, double p, double T)
{
    double w = par->cv * T / (par->inverse * (p + par->p_inf)), d = FAMILY_D * par->b;
    double v = w >= d ? w + par->b : FAMILY_REACH * par->b - d * d / w;
    return 1.0 / v;
}

/* All there is to know at (p, T). */
struct family_thermal {
    double v, h, s, v_T, v_p, c_p;
};

/* With P = p + p_inf, w = (gamma - 1) cv T/P and v - b = w, beyond the edge d (2 - d/w), of slope f = (d/w)^2:
 *     h = cv T + P (v - b) + p b + q,     s = cv (ln T + (gamma - 1) ln(T/P)) + q',     v_T = f w/T,     v_p = -f w/P,
 * and c_p = cv + P v_T. Beyond the edge the second logarithm is that at w = d, less x + x^2/2 with x = d/w - 1. */
static inline __attribute__((always_inline)) struct family_thermal family_thermal(const struct family *par, double p,
                                                                                  double T)
{
    double P = p + par->p_inf, R = par->cv / par->inverse, w = R * T / P, d = FAMILY_D * par->b;
    double ratio = d / w, beyond = ratio > 1.0 ? ratio : 1.0, f = ratio > 1.0 ? ratio * ratio : 1.0;
    double free = ratio > 1.0 ? d * (2.0 - ratio) : w, x = beyond - 1.0;
    double log_T = elementary_log(T), log_P = elementary_log(P), crowd = elementary_log(beyond) - x * (1.0 + 0.5 * x);
    return (struct family_thermal){.v = free + par->b,
                                   .h = par->cv * T + P * free + p * par->b + par->q,
                                   .s = par->cv * log_T + R * (log_T - log_P + crowd) + par->q_s,
                                   .v_T = f * w / T,
                                   .v_p = -f * w / P,
                                   .c_p = par->cv + f * R};
}

#endif
