/* flow_relax.h - a Maxwell branch relaxes: dV/dt = -dev B V/(2 tau) on batches of points, at constant mass, momentum
 * and total energy; what elastic energy is lost is heat.
 *
 * For a neo-Hookean spring Dp = s'/(2 eta) with eta = G tau is dev B/(2 tau), whatever its modulus, and B follows the
 * curve of flow.h. With r = 1/(1 + x), J1 = I1 - 3 and J2 = I2 - 3 of B0, B(r) = [1 + r^2 (B0 - 1) + r (1 - r) (J2 1 -
 * (B0^-1 - 1))]/g^2,   g^3 = 1 + r (1 - r) [r J1 + (1 - r) J2], dr/dt = -r g/tau, so r = exp(-t/tau) at small
 * strain. */
#ifndef FLOW_RELAX_H
#define FLOW_RELAX_H

#include "phys/model.h"

#include <stdbool.h>
#include <stddef.h>

/* How a step of `time` relaxation times is split: it relaxes by `ends`, moves by half, relaxes by `middle`, moves by
 * the other half, relaxes by `ends`. A sixth and two thirds are of second order without the error that is of second
 * degree in the motion, the large one where a fluid is sheared by more than 1 in its relaxation time (McLachlan, SIAM
 * J. Sci. Comput. 16 (1995) 151-168; Chin, Phys. Lett. A 226 (1997) 344-348). In short steps that error is below what
 * the others leave in steps five times as long, so halves at both ends do (Strang, SIAM J. Numer. Anal. 5 (1968)
 * 506-517), for less. */
struct flow_relax_parts {
    double ends, middle;
};

#define FLOW_RELAX_SPLIT (1.0 / 256.0)

static inline struct flow_relax_parts flow_relax_split(double time)
{
    bool split = time > FLOW_RELAX_SPLIT;
    return (struct flow_relax_parts){.ends = split ? time / 6.0 : 0.5 * time, .middle = split ? time / 1.5 : 0.0};
}

/* Lets one stretch of n points relax for `part` of its relaxation time, in place: exactly at small strain, by
 * fourth-order steps of at most an eighth of that time else. V: [n_stretch] rows, det V = 1. The identity keeps its
 * bits. */
void flow_relax(const struct model *model, size_t n, size_t stride, double part, double *V);

#endif
