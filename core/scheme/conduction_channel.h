/* conduction_channel.h - how the materials of two cells touch through the face between them, and what heat goes that
 * way.
 *
 * Each cell has fractions of several materials, each with a temperature. Of the face, the part
 *     A_ll = min(alpha_lL, alpha_lR)
 * joins material l with itself. What is left on both sides, e_lL = alpha_lL - A_ll and e_mR likewise, joins l in the
 * left cell with another material m in the right one: A_lm = e_lL e_mR / sum_k e_k,   l != m. All channels together are
 * the face, sum A = 1: over an interface of any width the resistance is that of one sharp interface. Half a cell of
 * each material lies in series, so that a channel lets through q_lm = A_lm k_lm (T_lL - T_mR)/d,   k_lm = 2 k_lL
 * k_mR/(k_lL + k_mR),   d the distance of the cells. It goes out of l in the left cell into m in the right one. A
 * mirror changes the sign and nothing else (docs/decisions/heat-channels.md). */
#ifndef CONDUCTION_CHANNEL_H
#define CONDUCTION_CHANNEL_H

#include <stddef.h>

/* A material on one side of a row of faces. */
struct conduction_channel_side {
    const double *part; /* its fraction, 0 where it is not felt */
    const double *sets; /* the same where it sets the time step, else 0 (heed.h); for the bound */
    const double *T;    /* [K] */
    const double *k;    /* conductivity [W/(m K)] */
    const double *c;    /* rho cv, capacity of its own volume [J/(m3 K)]; for the bound */
};

/* A_ll of one material at n faces, what is left of it on both sides, and (both sides' mean) added to the sum of
 * that. */
void conduction_channel_own(size_t n, const double *left, const double *right, double *own, double *left_rest,
                            double *right_rest, double *rest);

/* A_lm from what is left of l on the left, of m on the right, and of all. */
void conduction_channel_cross(size_t n, const double *left_rest, const double *right_rest, const double *rest,
                              double *cross);

/* k_lm. */
void conduction_channel_series(size_t n, const struct conduction_channel_side *left,
                               const struct conduction_channel_side *right, double *k);

/* How much a liquid and its vapour (or a gas of both), l and m, share one temperature in the cells on one side: 1 where
 * they do, 0 where they differ by a thousandth or one is not there. wet: n numbers. */
void conduction_channel_wet(size_t n, const struct conduction_channel_side *l, const struct conduction_channel_side *m,
                            double *wet);

/* k_lm between liquid and vapour: a cell that holds both at one temperature is a surface at that temperature, so that
 * only the half cell on the other side resists. The larger of both where both are; as conduction_channel_series where
 * neither is. */
void conduction_channel_surface(size_t n, const struct conduction_channel_side *left,
                                const struct conduction_channel_side *right, const double *wet_left,
                                const double *wet_right, double *k);

/* k_lm where a side does not set the time step: at most `most` c_l c_m/(c_l + c_m), most in m2/s, so that both come no
 * further than to their mean. Where T differs by more than the colder one, less by that: no trace is warmed to many
 * times its temperature in one step, and swells as often. Values at the face alone decide. */
void conduction_channel_bound(size_t n, double most, const struct conduction_channel_side *left,
                              const struct conduction_channel_side *right, double *k);

/* q_lm [W/m2], positive to the right; exactly 0 where the channel has no width. per_d: 1/d of each face. */
void conduction_channel_flow(size_t n, const double *width, const double *k, const double *per_d, const double *T_left,
                             const double *T_right, double *q);

#endif
