/* shear.h - what acts along the face of solids: two slow waves between the fast ones, as in HLLD (Miyoshi & Kusano, J.
 * Comput. Phys. 208 (2005) 315; Barton, J. Comput. Phys. 390 (2019) 25). Fluids come out bitwise as without it.
 *
 * A fast wave leaves u_t and s_nt as they are. A slow one runs through side K with the mass impedance Z_K and takes
 * them to common values u**, s**, on the left by s** - s_L = Z_L (u** - u_L), on the right by s** - s_R = -Z_R (u** -
 * u_R): u** = (Z_L u_L + Z_R u_R + s_R - s_L)/(Z_L + Z_R),   s** = (Z_L s_R + Z_R s_L + Z_L Z_R (u_R - u_L))/(Z_L +
 * Z_R). A fluid has Z = 0 and s = 0: then s** = 0, the solid's u** is that of a free surface, and the fluid keeps its
 * u_t. Both are written around the means of the sides, exact where nothing jumps and mirroring exactly.
 *
 * With q the mass flux through the face and K the side upwind, the slow wave of K has passed the face if |q| < Z_K.
 * Then, with w = |q|/Z_K, from the jumps of momentum and energy across that wave (q = rho* u*, Z = rho* c_S*):
 *     momentum  q u** - s**,      energy  (that of the contact) - [(1 - w) s** u** + w s_K u_K];
 * else, always where soft matter flows faster than its shear waves, those of side K: q u_K - s_K and - s_K u_K.
 * The two agree at w = 1. The stretch V of K is carried upwind from outside the slow wave, V_nt = V_ntK; what its jump
 * V_nn (u** - u_K)/(-+c_S*) would add to V_nt u* - V_nn u_t is the same as taking for u_t
 *     (1 - w) u** + w u_K.
 *
 * Z_K: with CONTACT_SLOW that of the shear wave in the matter behind the fast one. A compression chi = rho*_K/rho_K
 * shortens row n of V by chi and a factor chi^(1/3) keeps det V = 1, so B_nn goes as chi^(-4/3); G/rho does not change;
 * hence rho* c_S* = rho c_S chi^(1/3), of which (1 + 2 chi)/(2 + chi) is the Pade form, right to second order in chi -
 * 1 and within [1/2, 2]. A slow wave never outruns the fast one: Z_K <= rho |S_K - u_K|. Without CONTACT_SLOW it is
 * that bound itself: shear is smeared as far as the fast waves run.
 *
 * The including module defines CONTACT_SPEEDS (wave.h) and CONTACT_SLOW, 1 or 0. */
#ifndef SHEAR_H
#define SHEAR_H

#include "wave.h"

#include <float.h>

/* One side of one face, along one tangent; z is its impedance. */
struct shear_side {
    double u, s, z;
};

/* Velocity and traction between the slow waves. */
struct shear_middle {
    double u, s;
};

/* What goes through the face along one tangent, and its velocity as each side sees it. */
struct shear_face {
    double momentum, work, slide_left, slide_right;
};

/* `fast`: |S_K - u_K|, `gap`: |S_K - u*|; their quotient is chi. */
static inline double shear_impedance_of(double rho, double c_s, double fast, double gap)
{
    double slow = c_s * ((gap + 2.0 * fast) / (2.0 * gap + fast));
    double speed = CONTACT_SLOW ? wave_least(slow, fast) : fast;
    return c_s > 0.0 ? rho * speed : 0.0;
}

/* Impedances of both sides. The face velocities must have been written. */
BULLA_KERNEL static void shear_impedance(const struct bulla_faces *faces, double *restrict z_left,
                                         double *restrict z_right)
{
    const double *restrict rho_l = faces->left.rho, *restrict rho_r = faces->right.rho;
    const double *restrict u_l = faces->left.u[0], *restrict u_r = faces->right.u[0];
    const double *restrict c_l = faces->left.c, *restrict c_r = faces->right.c;
    const double *restrict shear_l = faces->shear_left.c_s, *restrict shear_r = faces->shear_right.c_s;
    const double *restrict u = faces->flux.u;
    const size_t n = faces->n;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        struct wave_side left = {.rho = rho_l[i], .u = u_l[i], .c = c_l[i]};
        struct wave_side right = {.rho = rho_r[i], .u = u_r[i], .c = c_r[i]};
        struct wave wave = CONTACT_SPEEDS(left, right);
        double face = u[i], slow_l = shear_l[i], slow_r = shear_r[i];
        z_left[i] = shear_impedance_of(left.rho, slow_l, fabs(wave.s_left - left.u), fabs(wave.s_left - face));
        z_right[i] = shear_impedance_of(right.rho, slow_r, fabs(wave.s_right - right.u), fabs(wave.s_right - face));
    }
}

static inline struct shear_middle shear_between(struct shear_side left, struct shear_side right)
{
    double total = left.z + right.z, inverse = 1.0 / (total > DBL_MIN ? total : 1.0);
    double du = right.u - left.u, ds = right.s - left.s, half = 0.5 * (left.z - right.z);
    double welded = 0.5 * (left.s + right.s) + (half * ds + left.z * right.z * du) * inverse;
    double slipped = left.z > 0.0 ? right.s : left.s;
    int both = (left.z > 0.0) & (right.z > 0.0);
    return (struct shear_middle){.u = 0.5 * (left.u + right.u) + (ds - half * du) * inverse,
                                 .s = both ? welded : slipped};
}

/* mass: the mass flux; from_left: the left side is upwind. */
static inline struct shear_face shear_at(struct shear_side left, struct shear_side right, double mass, int from_left)
{
    struct shear_middle middle = shear_between(left, right);
    double u = from_left ? left.u : right.u, s = from_left ? left.s : right.s, z = from_left ? left.z : right.z;
    double flow = fabs(mass);
    int passed = flow < z;
    double w = flow / (passed ? z : 1.0), outer = s * u, inner = middle.s * middle.u;
    double outside = z > 0.0 ? u : middle.u; /* a fluid upwind: what a solid downwind sees is its own surface */
    double slide = passed ? middle.u + w * (u - middle.u) : outside;
    return (struct shear_face){.momentum = mass * (passed ? middle.u : u) - (passed ? middle.s : s),
                               .work = passed ? inner + w * (outer - inner) : outer,
                               .slide_left = left.z > 0.0 ? slide : left.u,
                               .slide_right = right.z > 0.0 ? slide : right.u};
}

#endif
