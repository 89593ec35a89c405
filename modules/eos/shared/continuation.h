/* continuation.h - how laws that are good between two densities and two temperatures go on beyond.
 *
 * Inside, a law gives a point of a potential at (rho, T). Where T ends, what p asks for beyond goes linearly at
 * constant density, e = e_b + (p - p_b)/(rho G_b),   T = T_b + (e - e_b)/cv_b,   c^2 = c_b^2 + (p - p_b)/rho (1 + G_b +
 * dlnG_b/dln rho), and so does the residual of an iteration for T. Beyond a density rho_b the law is that of a
 * stiffened gas put on its isochore, e(v, p) = e(v_b, p) + k (v - v_b)(p + P),   c^2 = v^2 ((1 + k) p + k P)/(de/dp).
 * On the dense side k is at most the least 1/G there, so that de/dp > 0; P makes c continuous at one state. */
#ifndef CONTINUATION_H
#define CONTINUATION_H

#include "elementary.h"

#define CONTINUATION_COLDEST 1.0 /* K: where the linear rule would fall below */
#define CONTINUATION_LEAST 0.2   /* least 1 + G + dlnG/dln rho below p_b, so that c^2 ends at some pressure */

/* Beyond one end of the densities. */
struct continuation_end {
    double rho, v, k, P;
};

struct continuation_ends {
    struct continuation_end thin, dense;
};

/* A state of the potential; `stiffening` is 1 + G + dlnG/dln rho at constant T. */
struct continuation_point {
    double p, e, cv, G, c2, stiffening;
};

/* A state anywhere, per mass; e_p = de/dp, de_drho = d(rho e)/drho. */
struct continuation_state {
    double e, e_p, c2, de_drho, T;
};

ELEMENTARY_INLINE double continuation_inside(const struct continuation_ends *ends, double rho)
{
    double high = rho > ends->dense.rho ? ends->dense.rho : rho;
    return high < ends->thin.rho ? ends->thin.rho : high;
}

/* The state at (rho, p) from the point at (continuation_inside(rho), T). */
ELEMENTARY_INLINE struct continuation_state
continuation_state(const struct continuation_ends *ends, struct continuation_point at, double rho, double p, double T)
{
    double inside = continuation_inside(ends, rho), v = 1.0 / rho;
    double beyond = p - at.p, slope = 1.0 / (inside * at.G), least = beyond < 0.0 ? CONTINUATION_LEAST : 0.0;
    double stiffening = at.stiffening < least ? least : at.stiffening;
    double e = at.e + beyond * slope, c2 = at.c2 + beyond / inside * stiffening;
    double e_c2 = at.c2 + beyond / inside * at.stiffening; /* what this e says, positive or not */
    int thin = rho < inside, within = rho == inside;
    double k = thin ? ends->thin.k : ends->dense.k, P = thin ? ends->thin.P : ends->dense.P;
    double away = v - (thin ? ends->thin.v : ends->dense.v), e_p = slope + k * away, e_v = k * (p + P);
    double far_c2 = v * v * (e_v + p) / e_p, far_e = e + away * e_v;
    double warm = (T + beyond * slope / at.cv) * (within ? 1.0 : e_p / slope);
    warm = warm < CONTINUATION_COLDEST ? CONTINUATION_COLDEST : warm;
    double de_drho = within ? e + p * v - e_c2 / at.G : far_e - v * e_v;
    return (struct continuation_state){within ? e : far_e, within ? slope : e_p, within ? c2 : far_c2, de_drho, warm};
}

/* Where c^2 ends, from the point at the coldest temperature of this density (or of the last). */
ELEMENTARY_INLINE double continuation_p_min(const struct continuation_ends *ends, struct continuation_point cold,
                                            double rho)
{
    double inside = continuation_inside(ends, rho);
    double stiffening = cold.stiffening < CONTINUATION_LEAST ? CONTINUATION_LEAST : cold.stiffening;
    double low = cold.p - inside * cold.c2 / stiffening;
    double thin = -ends->thin.k * ends->thin.P / (1.0 + ends->thin.k);
    double dense = -ends->dense.k * ends->dense.P / (1.0 + ends->dense.k);
    low = rho < inside ? thin : low;
    return rho > inside ? dense : low;
}

/* The end at `rho` with slope k; c is continuous at the point `at`, or where the linear rule takes it to `least_p`. */
static inline struct continuation_end continuation_end(struct continuation_point at, double rho, double k,
                                                       double least_p)
{
    double p = at.p < least_p ? least_p : at.p, stiffening = at.stiffening > 0.0 ? at.stiffening : 0.0;
    double c2 = at.c2 + (p - at.p) / rho * stiffening, P = (rho * c2 / at.G - (1.0 + k) * p) / k;
    return (struct continuation_end){rho, 1.0 / rho, k, P > 0.0 ? P : 0.0};
}

#endif
