/* helmholtz_state.h - from the Helmholtz energy at one (rho, l) to what kind "eos" asks for at one (rho, p).
 *
 * A trial l = ln T need not be the root of p(rho, l) = p: what is left, d = p - p(rho, l), is taken up by a series,
 *     e = e(rho, l) + d W + d^2/2 W_p,   W = (de/dp)_rho = e_l/p_l,   W_p = W_l/p_l.
 * Inside the domain that is the last Newton step. On its edge l_b(rho) the same formula without W_p is the continuation:
 * linear in p, at fixed rho, with the e, W and T of the edge, so e, de/dp, T and c^2 are continuous there and
 * de/dp > 0 at any p. Both ways the slope in rho is exact,
 *     (de/drho)_p = (e_r - p_r W) + d (W_r + W_l dl/drho),   dl/drho = -p_r/p_l inside, l_b' on the edge.
 *
 * Beyond the densities of the domain, v = 1/rho, subscript 0 at the last density:
 *   thin:   e = e(v0, p) + (v - v0)(p + g P)/(g - 1),                      as a stiffened gas expands;
 *   dense:  e = e_ref(v) + (v/v0)(e(v0, p - p_ref + p_0) - e_0),           Mie-Grueneisen on a Murnaghan curve
 *           p_ref = p_0 + K/4 ((rho/rho0)^4 - 1), e_ref its integral, K = rho c^2 at the cold end of the domain. */
#ifndef HELMHOLTZ_STATE_H
#define HELMHOLTZ_STATE_H

#include "helmholtz.h"

/* What stands in vector loops has to be inlined there, big as it is. */
#define HELMHOLTZ_INLINE static inline __attribute__((always_inline))

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
    double p_l, excess, cv; /* p_l and d at the trial, T dp/dT and what is left; e_l = T cv */
};

/* Constants of the two ends in density. */
struct helmholtz_ends {
    double thin, gamma, pull;                    /* density below which the thin rule holds, g, P */
    double dense, p, e, stiffness, p_min, T_min; /* density of the dense rule, p_0, e_0, K; lowest p and T */
};

/* RT ln delta comes to what a table or a sum of terms gives. */
HELMHOLTZ_INLINE struct helmholtz_spot helmholtz_with_gas(struct helmholtz_spot spot, double rho, double RT)
{
    double once = RT / rho, twice = once / rho;
    spot.a_r += once;
    spot.a_rl += once;
    spot.a_rll += once;
    spot.a_rr -= twice;
    spot.a_rrl -= twice;
    return spot;
}

HELMHOLTZ_INLINE struct helmholtz_answer helmholtz_answer(struct helmholtz_spot at, double rho, double p)
{
    double square = rho * rho, p_r = 2.0 * rho * at.a_r + square * at.a_rr;
    double p_l = square * at.a_rl, p_ll = square * at.a_rll, p_rl = 2.0 * rho * at.a_rl + square * at.a_rrl;
    double e_l = at.a_l - at.a_ll, e_ll = at.a_ll - at.a_lll, e_rl = at.a_rl - at.a_rll;
    double per_p_l = 1.0 / p_l, W = e_l * per_p_l, d = p - square * at.a_r;
    double W_l = (e_ll - W * p_ll) * per_p_l, W_r = (e_rl - W * p_rl) * per_p_l;
    double slope = at.side < 0.0 ? at.slope : 0.0;
    slope = at.side == 0.0 ? -p_r * per_p_l : slope;
    double W_p = at.side == 0.0 ? W_l * per_p_l : 0.0;
    double bend = d * (W_r + W_l * slope), steady = at.a_rl + p_r * W, e_p = W + d * W_p;
    double c2 = (steady + d / square - bend) / e_p, least = HELMHOLTZ_LEAST_C2 * steady / W;
    return (struct helmholtz_answer){
        .e = at.a - at.a_l + d * (W + 0.5 * d * W_p),
        .e_p = e_p,
        .e_r = at.a_r - at.a_rl - p_r * W + bend,
        .c2 = c2 > least ? c2 : least,
        .p_l = p_l,
        .excess = d,
        .cv = e_l,
    };
}

/* p at which the domain's last density is asked, for a density beyond it. */
HELMHOLTZ_INLINE double helmholtz_dense_p(const struct helmholtz_ends *ends, double rho, double p)
{
    double x = rho / ends->dense, beyond = x > 1.0 ? x * x * x * x - 1.0 : 0.0;
    return p - 0.25 * ends->stiffness * beyond;
}

HELMHOLTZ_INLINE struct helmholtz_answer helmholtz_dense(const struct helmholtz_ends *ends, struct helmholtz_answer at,
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

HELMHOLTZ_INLINE struct helmholtz_answer helmholtz_thin(const struct helmholtz_ends *ends, struct helmholtz_answer at,
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
