/* bulla/inelastic.h - functions of a module of kind "inelastic".
 *
 * The strength of one solid: the stress at which it flows. Core does all tensor work: after each step it puts the
 * elastic stretch of a solid whose equivalent stress q = sqrt(3/2 s':s') is too large back to where q = Y(eps + d_eps,
 * d_eps/dt, p, T, rho), d_eps the plastic strain of the step (backward Euler, solved for exactly), along the flow dV/dt
 * = -Dp V with Dp coaxial with the stress. The work of the stress on it stays in the cell as heat. A law says Y and
 * nothing else: eps    accumulated equivalent plastic strain, >= 0 [1] rate   its rate, >= 0 [1/s]: 0 asks for the
 * static strength p, T, rho   pressure, temperature, density of the material [Pa, K, kg/m3] What `needs` does not ask
 * for comes as rows of zeros. Every call is a batch over n points: [any thread; pure; no allocation; n >= 1; arrays do
 * not overlap; unit stride; SI units]. The value at a point must not depend on its place in the row or on n.
 *
 * Well-posed means, for every eps, rate, T >= 0, rho > 0 and any p: Y finite and >= 0 (0: molten), never falling with
 * rate. Y may fall with eps or T, but slower than the elastic stress does, 3 G d_eps: then the search has one root. At
 * eps = 0 a law may rise infinitely
 * steeply. */
#ifndef BULLA_INELASTIC_H
#define BULLA_INELASTIC_H

#include "bulla/module.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What a law looks at. */
enum bulla_inelastic_needs {
    BULLA_INELASTIC_STRAIN = 1,      /* eps: core then evolves it as a field */
    BULLA_INELASTIC_RATE = 2,        /* rate */
    BULLA_INELASTIC_PRESSURE = 4,    /* p and rho */
    BULLA_INELASTIC_TEMPERATURE = 8, /* T, which the equation of state must be able to give */
    BULLA_INELASTIC_ALL = 15
};

struct bulla_inelastic {
    uint32_t size; /* sizeof(struct bulla_inelastic) */

    /* Flow stress Y [Pa]. */
    void (*strength)(const void *self, size_t n, const double *BULLA_RESTRICT eps, const double *BULLA_RESTRICT rate,
                     const double *BULLA_RESTRICT p, const double *BULLA_RESTRICT T, const double *BULLA_RESTRICT rho,
                     double *BULLA_RESTRICT Y);

    /* Bits of enum bulla_inelastic_needs: what this instance looks at. */
    uint32_t (*needs)(const void *self);
};

#ifdef __cplusplus
}
#endif
#endif
