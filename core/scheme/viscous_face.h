/* viscous_face.h - faces in thick liquids: how much of a jump of pressure the Riemann problem gets to see.
 *
 * A solver answers a jump of pressure with a velocity of (p_L - p_R)/(Z_L + Z_R), Z = rho c: what a fluid of inertia
 * alone would do. Where h rho c is less than the viscosity, half a cell is held by that: beside a bubble in 1 Pa s the
 * jump of pressure balances the stress at its wall, and is no reason for anything to move. The impedance of half a cell
 * of viscous fluid is some N = (4/3 mu + zeta)/(h/2), with layers of materials in series. The pressures of both sides
 * are drawn together so that whatever solver answers as one with Z + N would,
 *     p_L += N_L (p_R - p_L)/(Z_L + N_L + Z_R + N_R),  p_R -= N_R (p_R - p_L)/(Z_L + N_L + Z_R + N_R).
 * Both sides have energies of these pressures. N has a factor of VISCOUS_FACE_HOLD, as waves of the length of a cell
 * are all that this resistance is for; where N is less than VISCOUS_FACE_THIN of Z the jumps stay, and up to twice that
 * less of them is drawn (docs/decisions/viscous-faces.md). All this within two cells of a mixture: elsewhere pressures
 * jump in shocks alone. Faces of troubled cells and of those beside boundaries that waves cross keep their jumps, as in
 * low_mach.h.
 *
 * Left out: scenes with solids, whose traction has jumps of its own. What is thinner than MODEL_THICK, and a viscosity
 * that follows the rate of shear, which the faces do not know, count as none: layers in series with them hold nothing.
 * What a face does may not depend on the path: tiles on both sides have to find the same. */
#ifndef VISCOUS_FACE_H
#define VISCOUS_FACE_H

#include "phys/model.h"

#include <stddef.h>

/* Of the impedance of half a cell, and the least of it beside rho c. */
#define VISCOUS_FACE_HOLD 4.0
#define VISCOUS_FACE_THIN 0.02

/* Does a path draw pressures? */
bool viscous_face_wanted(const struct model *path);

/* Edges of a row and the faces between them, as in low_mach.h. */
struct viscous_face {
    size_t n, right, step;
    size_t edges, pitch;         /* row l of alpha and rho_l is `pitch` numbers further each, */
    size_t room;                 /* that of cells `room` */
    double per_h;                /* 1/h across the faces [1/m] */
    const double *cells;         /* fractions of the cells */
    const double *alpha, *rho_l; /* at the edges */
    const double *rho, *rho_c2;  /* there; rho_c2: of the mixture, frozen */
    const double *mask;          /* of the cells; 1: its faces keep their jump; or NULL */
    double *N, *part, *mixed;    /* work space: [edges], [n], [n + 3 step] */
};

/* Draws the pressures `p` at the edges together; false: at no face, they are as they were. Equal ones keep their bits;
 * mirror images give mirror images. */
bool viscous_face_draw(const struct model *path, const struct viscous_face *faces, double *p);

#endif
