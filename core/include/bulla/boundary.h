/* bulla/boundary.h - functions of a module of kind "boundary".
 *
 * What lies behind a face of the domain: the state of the cells there, made of the cells inside, of place and time.
 * Core puts it beside the faces and solves their Riemann problems as everywhere; a boundary writes no fluxes. Every
 * call is a batch of n faces that lie side by side: [any thread; pure; no allocation; n >= 1; arrays do not overlap;
 * unit stride; SI units]. What is written for a face must not depend on its place in the row or on n. There is no
 * memory from call to call: a wall with a mass or a spring, whose state is more than that of the fluid beside it, is
 * none.
 *
 * The outputs hold what is inside when `fill` is called: what a boundary leaves alone is a copy. A solid's stretch and
 * other fields follow by themselves: copied, mirrored (BULLA_BEHIND_MIRRORS) or unstretched (BULLA_BEHIND_BRINGS).
 *
 * Well-posed means: finite for any state inside that core can have: rho > 0, alpha from 0 to 1 with sum 1, any u, and
 * any p that the materials bear; fractions with sum 1.
 */
#ifndef BULLA_BOUNDARY_H
#define BULLA_BOUNDARY_H

#include "bulla/module.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What a boundary is, for others: bits of `traits`. What it does not say it must not do; `bulla module check` asks. */
enum bulla_behind_trait {
    /* Is asked for layer after layer, with the cell inside that lies as far from the face; else once for all layers,
     * with the cell next to the face. */
    BULLA_BEHIND_MIRRORS = 1,
    /* What rests inside, u = 0 at any pressure, stands unchanged behind it: tiles at rest beside it need no work. */
    BULLA_BEHIND_RESTS = 2,
    /* May bring materials, or other fractions of them than inside. */
    BULLA_BEHIND_BRINGS = 4,
    /* Looks at p_start and u_start. */
    BULLA_BEHIND_REFERS = 8,
    /* May move what would stay as it is: without it, where p and u are p_start and u_start (and u = 0, without REFERS)
     * the copy is left alone. The time step asks for what it brings. */
    BULLA_BEHIND_DRIVES = 16,
    /* Fluid goes through. */
    BULLA_BEHIND_OPEN = 32,
    /* Leaves rho alone: core takes the densities along each material's isentrope from the pressure inside to the one
     * that was written, and fractions with them, so that mass fractions stay. */
    BULLA_BEHIND_ISENTROPIC = 64,
};

/* A batch of faces. */
struct bulla_behind {
    uint32_t size;                   /* sizeof(struct bulla_behind) of core */
    uint32_t n_material, n_velocity; /* n_velocity: 1 to 3 */
    uint32_t first;                  /* of the scene's materials: those from here on may be there, the others are not */
    uint32_t axis, side;             /* of the face: 0 to 2; 0 is the lower end, 1 the upper */
    size_t n;                        /* faces */
    double t;                        /* [s] */
    double depth;                    /* from the face to the centres of the cells that are asked for, outwards [m] */
    const double *x[3];              /* centres of the faces [m]; 0 beyond the dimension */

    /* Inside. u[0] is along the outward normal, the others along the other axes in their order. */
    const double *const *alpha, *const *rho, *const *u, *p; /* [n_material], [n_material], [n_velocity] rows */
    const double *Z;                                        /* rho c of the mixture, c that of its waves [Pa s/m] */
    const double *p_start, *u_start; /* p and u[0] next to the face at the start of the run; NULL without REFERS */

    /* Behind: to be written, and holding what is inside. */
    double *const *alpha_behind, *const *rho_behind, *const *u_behind, *p_behind;
};

struct bulla_boundary {
    uint32_t size;   /* sizeof(struct bulla_boundary) */
    uint32_t traits; /* enum bulla_behind_trait, added up */

    /* The hot call: once per tile, face and stage (or layer). */
    void (*fill)(const void *self, const struct bulla_behind *faces);
};

#ifdef __cplusplus
}
#endif
#endif
