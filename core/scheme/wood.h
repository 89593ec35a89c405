/* wood.h - the speed of sound that mixtures show to the Riemann solver where they expand.
 *
 * Solvers take the frozen speed of a mixture, c_f^2 = sum alpha_l rho_l c_l^2/rho, the largest there is: nothing breaks
 * with it, and waves that run far slower, as the ones of boiling do, are smeared, since a jump of velocity is answered
 * with rho c_f (u_L
 * - u_R)/2. With `scheme: {mixture-speed: wood}` the two sides of faces at which the cells move apart have Wood's speed
 * instead (A. B. Wood, A Textbook of Sound, 1930), 1/(rho c_w^2) = sum alpha_l/(rho_l c_l^2), wherever it is below
 * WOOD_FELT c_f: pure fluids keep their bits. Where mixtures are compressed the frozen speed stays; condensing shocks
 * overshoot with any other. */
#ifndef WOOD_H
#define WOOD_H

#include <stddef.h>

#define WOOD_FELT 0.9

/* Adds what material l gives way, alpha_l/(rho_l c_l^2), at n edges; the first material starts the sum. */
void wood_give(size_t n, unsigned l, const double *alpha, const double *rho_c2, double *give);

/* Edges of n faces between cells with normal velocities u, `step` places apart: the left one of face i stands at i, the
 * right one at right + i. rho, give and the speeds c are those of the edges. */
struct wood {
    size_t n, right, step;
    const double *u, *rho, *give;
};

/* Slower speeds where cells move apart. Mirror images give mirror images. */
void wood_slow(const struct wood *faces, double *c);

#endif
