/* bulla/riemann.h - functions of a module of kind "riemann".
 *
 * A Riemann solver gets the states left and right of n faces, completed by core, in a frame
 * whose first velocity component is normal to the face, and returns the fluxes through the
 * faces and the two face values that the non-conservative terms need.
 * [any thread; pure; no allocation; n >= 1; arrays do not overlap; unit stride; SI units]
 *
 * Contract. alpha is advected: its flux, formed by core, is alpha* u*, with the u* that also
 * stands in div u; so a solver returns alpha* (bounded by the two sides, summing to 1) and u*.
 * c is the frozen sound speed of the mixture, c_f^2 = sum_l Y_l c_l^2: alpha is frozen across
 * the acoustic waves, and Wood's speed here makes water-air flows fail.
 * In a scene with a solid the sides carry stress s = -p I + s': then `p` is the normal traction -s_nn, `c` the fastest
 * elastic signal, and `solid` is set with what acts along the face. All formulas of fluids hold with that p and c; what
 * is added is the traction s_nt, which goes into the momentum and (with u_t) energy fluxes, and u*_t. A side with
 * c_s = 0 is a fluid and slips. Where both are fluids the fluxes must be those of a scene without solids, bitwise.
 * At uniform p and u on both sides the momentum flux must be (rho u) u + p, u* = u and the
 * energy flux u (rho E* + p), each to round-off, for any jump of alpha and densities.
 */
#ifndef BULLA_RIEMANN_H
#define BULLA_RIEMANN_H

#include "bulla/module.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One side of the faces. Arrays of n doubles. */
struct bulla_side {
    const double *rho;          /* mixture density, sum of m_l */
    const double *p;            /* pressure; with a solid the normal traction -s_nn */
    const double *rho_E;        /* total energy per volume */
    const double *c;            /* frozen sound speed; with a solid the fastest elastic signal */
    const double *const *u;     /* [n_velocity] velocity; u[0] is normal to the face */
    const double *const *m;     /* [n_material] partial densities alpha_l rho_l */
    const double *const *alpha; /* [n_alpha] volume fractions */
};

/* What goes through the faces. Arrays of n doubles, written by the solver. */
struct bulla_flux {
    double *const *m;        /* [n_material] mass fluxes */
    double *const *momentum; /* [n_velocity] momentum fluxes, [0] normal (with pressure) */
    double *rho_E;           /* energy flux */
    double *u;               /* face velocity u*_n */
    double *const *alpha;    /* [n_alpha] face volume fractions alpha* */
};

/* What one side carries along the face, in scenes with a solid. Arrays of n doubles. */
struct bulla_shear {
    const double *c_s;      /* shear wave speed; 0: this side is a fluid */
    const double *const *s; /* [n_velocity - 1] tractions s_nt along tangents 1, 2 */
};

struct bulla_faces {
    size_t n;
    unsigned n_material; /* >= 1 */
    unsigned n_alpha;    /* n_material, or 0 when there is one material */
    unsigned n_velocity; /* 1, 2 or 3 */
    struct bulla_side left, right;
    struct bulla_flux flux;
    double *work[4]; /* scratch of n doubles each */
    unsigned mixed;  /* the scene has several materials. Where only one is present on both sides core may list it
                        alone (n_material = 1, n_alpha = 0); the fluxes must be those of the full list, bitwise */

    /* Scenes with a solid; all unset (0, NULL) else. */
    unsigned solid;
    struct bulla_shear shear_left, shear_right;
    /* [n_velocity - 1] tangential face velocity u*_t, written by the solver, as the cell on the left and the one on the
     * right see it: they differ where the sides slip. The stretch of each cell follows its own. */
    double *const *slide_left, *const *slide_right;
};

struct bulla_riemann {
    uint32_t size; /* sizeof(struct bulla_riemann) */
    void (*solve)(const void *self, const struct bulla_faces *faces);
    uint32_t solids;  /* 1: understands `solid`; a solver without is refused in scenes with a solid */
    uint32_t resists; /* 1: diffuses jumps of u_t between fluids as fast as sound. In slow flow core then draws u_t
                         together at the faces as it does u_n (`scheme.low-mach`) */
};

#ifdef __cplusplus
}
#endif
#endif
