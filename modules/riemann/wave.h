/* wave.h - signal speeds and the contact of one face, shared by all Riemann solvers.
 *
 * Two signal speeds S_L, S_R bound the waves; between them the flow has one velocity S_M and one
 * pressure p* on both sides of the contact (Toro 2009, 10.37 and 10.36), with the impedances
 * a_L = rho_L (S_L - u_L) < 0 < a_R = rho_R (S_R - u_R):
 *     S_M = (p_R - p_L + a_L u_L - a_R u_R)/(a_L - a_R),   p* = p_K + a_K (S_M - u_K).
 * S_M is written around the mean velocity: it is exactly u where u and p do not jump, hence
 * exactly 0 in a fluid at rest, and changes sign exactly when the sides are mirrored. p* is the
 * mean of its two equal forms for the same reason. */
#ifndef WAVE_H
#define WAVE_H

#include "bulla/riemann.h"

#include <math.h>

/* One side of one face; u is normal to the face. */
struct wave_side {
    double rho, u, p, c, rho_E;
};

struct wave {
    double s_left, s_right, s_contact, p_star;
};

static inline double wave_least(double a, double b)
{
    return a < b ? a : b;
}

static inline double wave_most(double a, double b)
{
    return a > b ? a : b;
}

/* S_L = min(u - c), S_R = max(u + c) over both sides (Davis, SIAM J. Sci. Stat. Comput. 9 (1988) 445). */
static inline struct wave wave_davis(struct wave_side left, struct wave_side right)
{
    return (struct wave){.s_left = wave_least(left.u - left.c, right.u - right.c),
                         .s_right = wave_most(left.u + left.c, right.u + right.c)};
}

/* S_R = -S_L = the largest |u| + c (Rusanov, USSR Comput. Math. Math. Phys. 1 (1961) 304). */
static inline struct wave wave_rusanov(struct wave_side left, struct wave_side right)
{
    double s = wave_most(fabs(left.u) + left.c, fabs(right.u) + right.c);
    return (struct wave){.s_left = -s, .s_right = s};
}

/* How slow the signal of a rarefaction may get, in the speed of sound. */
#define WAVE_RELEASED 0.5

/* Signals of a face between unlike mixtures, `alien` from 0 (alike) to 1. A side that lets go of pressure keeps the
 * jump conditions of its signal, and those of speed c are not met by any state of its material: its pressure by density
 * and energy is far from p*. They are met by the "rarefaction shock" of speed c - k (u_K - u*) along the Hugoniot,
 * which strong rarefactions follow closely in density, velocity and energy. k = (gamma + 1)/4 for weak waves, 0.6 in
 * air and 1.35 in water; 1 is taken for all (docs/decisions/cut-cells.md). u* is that of the two impedances, three
 * times. Sides that are compressed keep their signals, to the bit. */
static inline struct wave wave_release(struct wave wave, struct wave_side left, struct wave_side right, double alien)
{
    double c_left = left.c, c_right = right.c;
    for (int round = 0; round < 3; round++) {
        double z_left = left.rho * c_left, z_right = right.rho * c_right;
        double u = (z_left * left.u + z_right * right.u + (left.p - right.p)) / (z_left + z_right);
        c_left = wave_most(left.c + (left.u - u), WAVE_RELEASED * left.c);
        c_right = wave_most(right.c + (u - right.u), WAVE_RELEASED * right.c);
    }
    double q_left = 1.0 - alien * (1.0 - c_left / left.c), q_right = 1.0 - alien * (1.0 - c_right / right.c);
    double s_left = left.u - (left.u - wave.s_left) * q_left, s_right = right.u + (wave.s_right - right.u) * q_right;
    wave.s_left = q_left < 1.0 ? s_left : wave.s_left;
    wave.s_right = q_right < 1.0 ? s_right : wave.s_right;
    return wave;
}

/* Adds velocity and pressure between the signals. */
static inline struct wave wave_contact(struct wave wave, struct wave_side left, struct wave_side right)
{
    double a_left = left.rho * (wave.s_left - left.u), a_right = right.rho * (wave.s_right - right.u);
    double half = 0.5 * (right.u - left.u);
    double excess = ((right.p - left.p) - half * (a_left + a_right)) / (a_left - a_right);
    wave.s_contact = 0.5 * (left.u + right.u) + excess;
    wave.p_star =
        0.5 * ((left.p + a_left * (wave.s_contact - left.u)) + (right.p + a_right * (wave.s_contact - right.u)));
    return wave;
}

/* Velocity at the face itself. */
static inline double wave_face_velocity(struct wave wave, struct wave_side left, struct wave_side right)
{
    double inner = wave.s_right <= 0.0 ? right.u : wave.s_contact;
    return wave.s_left >= 0.0 ? left.u : inner;
}

/* Diffusion speed of the two-wave average at the face: -S_L S_R/(S_R - S_L), 0 where supersonic. */
static inline double wave_spread(struct wave wave)
{
    double s_left = wave_least(wave.s_left, 0.0), s_right = wave_most(wave.s_right, 0.0);
    return -s_left * s_right / (s_right - s_left);
}

#endif
