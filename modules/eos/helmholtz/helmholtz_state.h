/* helmholtz_state.h - from the Helmholtz energy at one (rho, l) to what kind "eos" asks for at one (rho, p).
 *
 * Inside the domain l = ln T is the root of p(rho, l) = p up to a small rest d = p - p(rho, l), which is taken up by
 *     e = e(rho, l) + d W,   W = (de/dp)_rho = e_l/p_l,   T(1 + d/p_l).
 * On its edge l_b(rho) the same formulas are the continuation: linear in p, at fixed rho, with the e, W and T of the
 * edge, so e, de/dp, T and c^2 are continuous there and de/dp > 0 at any p. There the slope in rho is (de/drho)_p =
 * (e_r - p_r W) + d (W_r + W_l l_b').
 *
 * Beyond the densities of the domain, v = 1/rho, subscript 0 at the last density:
 *   thin:   e = e(v0, p) + (v - v0)(p + g P)/(g - 1),                      as a stiffened gas expands;
 *   dense:  e = e_ref(v) + (v/v0)(e(v0, p - p_ref + p_0) - e_0),           Mie-Grueneisen on a Murnaghan curve
 *           p_ref = p_0 + K/4 ((rho/rho0)^4 - 1), e_ref its integral, K = rho c^2 at the cold end of the domain. */
#ifndef HELMHOLTZ_STATE_H
#define HELMHOLTZ_STATE_H

#include "helmholtz.h"
#include "shared/patch.h"

#define HELMHOLTZ_LEAST_C2 0.05 /* of that on the edge: what is left of c^2 far out in a continuation */

/* The Helmholtz energy and its derivatives at (rho, l), all that is needed. */
struct helmholtz_spot {
    double l, T, a, a_l, a_ll, a_lll, a_r, a_rl, a_rll, a_rr, a_rrl;
    double side;  /* where a trial ended: -1 on the lower edge with p below it, 1 on the upper with p above, 0 inside */
    double slope; /* l_b' of the lower edge */
};

struct helmholtz_answer {
    double e, e_p, e_r; /* energy per mass, its derivatives in p and in rho */
    double c2;
    double rise, cv; /* d/p_l, by how much T lies above that of the spot, relative; e_l = T cv */
};

/* Constants of the two ends in density. */
struct helmholtz_ends {
    double thin, gamma, pull;                    /* density below which the thin rule holds, g, P */
    double dense, p, e, stiffness, p_min, T_min; /* density of the dense rule, p_0, e_0, K; lowest p and T */
};

/* RT ln delta comes to what a table or a sum of terms gives. */
PATCH_INLINE struct helmholtz_spot helmholtz_with_gas(struct helmholtz_spot spot, double per_rho, double RT)
{
    double once = RT * per_rho, twice = once * per_rho;
    spot.a_r += once;
    spot.a_rl += once;
    spot.a_rll += once;
    spot.a_rr -= twice;
    spot.a_rrl -= twice;
    return spot;
}

/* The formulas themselves at (rho, l). */
static inline struct helmholtz_spot helmholtz_exact(const struct helmholtz_fluid *fluid, const int gas, double rho,
                                                    double l)
{
    double a[HELMHOLTZ_R][HELMHOLTZ_L], T = exp(l), RT = fluid->R * T;
    helmholtz_potential(fluid, rho, l, a);
    double lift = gas ? 0.0 : RT * log(rho / fluid->rho_c);
    struct helmholtz_spot spot = {.l = l,
                                  .T = T,
                                  .a = a[0][0] + lift,
                                  .a_l = a[0][1] + lift,
                                  .a_ll = a[0][2] + lift,
                                  .a_lll = a[0][3] + lift,
                                  .a_r = a[1][0],
                                  .a_rl = a[1][1],
                                  .a_rll = a[1][2],
                                  .a_rr = a[2][0],
                                  .a_rrl = a[2][1]};
    return helmholtz_with_gas(spot, 1.0 / rho, RT);
}

/* `inside` (a constant in loops): the spot is no edge. */
PATCH_INLINE struct helmholtz_answer helmholtz_answer(struct helmholtz_spot at, const int inside, double rho,
                                                      double per_rho, double p)
{
    double square = rho * rho, p_r = 2.0 * rho * at.a_r + square * at.a_rr, p_l = square * at.a_rl;
    double e_l = at.a_l - at.a_ll, per = 1.0 / (p_l * e_l), per_p_l = e_l * per, W = e_l * per_p_l;
    double per_W = p_l * per * p_l, d = p - square * at.a_r, bend = 0.0, c2 = p_r + at.a_rl * per_W;
    if (!inside) {
        double p_ll = square * at.a_rll, p_rl = 2.0 * rho * at.a_rl + square * at.a_rrl;
        double e_ll = at.a_ll - at.a_lll, e_rl = at.a_rl - at.a_rll;
        double W_l = (e_ll - W * p_ll) * per_p_l, W_r = (e_rl - W * p_rl) * per_p_l;
        double slope = at.side < 0.0 ? at.slope : 0.0, least = HELMHOLTZ_LEAST_C2 * c2;
        bend = at.side == 0.0 ? 0.0 : d * (W_r + W_l * slope);
        double far = c2 + (d * per_rho * per_rho - bend) * per_W;
        far = far > least ? far : least;
        c2 = at.side == 0.0 ? c2 : far;
    }
    return (struct helmholtz_answer){
        .e = at.a - at.a_l + d * W,
        .e_p = W,
        .e_r = at.a_r - at.a_rl - p_r * W + bend,
        .c2 = c2,
        .rise = d * per_p_l,
        .cv = e_l,
    };
}

/* p at which the domain's last density is asked, for a density beyond it. */
PATCH_INLINE double helmholtz_dense_p(const struct helmholtz_ends *ends, double rho, double p)
{
    double x = rho / ends->dense, beyond = x > 1.0 ? x * x * x * x - 1.0 : 0.0;
    return p - 0.25 * ends->stiffness * beyond;
}

PATCH_INLINE struct helmholtz_answer helmholtz_dense(const struct helmholtz_ends *ends, struct helmholtz_answer at,
                                                     double rho, double p)
{
    double x = rho > ends->dense ? rho / ends->dense : 1.0, square = x * x, cube = square * x;
    double part = 0.25 * ends->stiffness, p_ref = ends->p + part * (cube * x - 1.0), per_rho = 1.0 / ends->dense;
    double e_ref = ends->e + per_rho * ((ends->p - part) * (1.0 - 1.0 / x) + part * (cube - 1.0) / 3.0);
    double above = (at.e - ends->e) / x, e_p = at.e_p / x, drag = e_p * ends->stiffness * cube * per_rho;
    double c2 = ((p - p_ref) / (rho * rho) + above / rho + drag) / e_p, least = HELMHOLTZ_LEAST_C2 * at.c2;
    c2 = c2 > least ? c2 : least;
    at.e = rho > ends->dense ? e_ref + above : at.e;
    at.e_p = rho > ends->dense ? e_p : at.e_p;
    at.e_r = rho > ends->dense ? p_ref / (rho * rho) - above / rho - drag : at.e_r;
    at.c2 = rho > ends->dense ? c2 : at.c2;
    return at;
}

PATCH_INLINE struct helmholtz_answer helmholtz_thin(const struct helmholtz_ends *ends, struct helmholtz_answer at,
                                                    double rho, double p)
{
    double per = 1.0 / (ends->gamma - 1.0), more = 1.0 / rho - 1.0 / ends->thin;
    double push = (p + ends->gamma * ends->pull) * per, square = rho * rho;
    double e = at.e + more * push, e_p = at.e_p + more * per;
    at.e = rho < ends->thin ? e : at.e;
    at.e_p = rho < ends->thin ? e_p : at.e_p;
    at.e_r = rho < ends->thin ? -push / square : at.e_r;
    at.c2 = rho < ends->thin ? ends->gamma * (p + ends->pull) * per / (square * e_p) : at.c2;
    return at;
}

#endif
