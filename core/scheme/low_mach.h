/* low_mach.h - faces in slow flow: how much of a jump of velocity the Riemann problem gets to see.
 *
 * Where a fluid is slow, its velocity differs between the two sides of a face by what the reconstruction leaves out,
 * and a solver answers every such difference with a pressure of rho c (u_L - u_R)/2: a viscosity of some c h/2 that has
 * nothing to do with the flow. With `low-mach` the normal velocities at a face are drawn together first, whatever the
 * solver, each by the impedance Z = rho c of the other side,
 *
 *     u_L += (1 - z) Z_R (u_R - u_L)/(Z_L + Z_R),  u_R -= (1 - z) Z_L (u_R - u_L)/(Z_L + Z_R),
 *     z = min(1, least + max(M_L, M_R) + LOW_MACH_BEND b / max rho c^2),
 *
 * after Thornber, Mosedale, Drikakis, Youngs & Williams, J. Comput. Phys. 227 (2008) 4873-4894, who have z = max(M_L,
 * M_R) and the mean of both sides. That of a contact, (Z_L u_L + Z_R u_R)/(Z_L + Z_R), stays: with the plain mean air
 * moves the water beside it, and mixtures that differ from cell to cell shake (docs/decisions/low-mach.md). b is the
 * larger second difference of pressure of the two cells of the face: a shock wants its jump of velocity whole, and so
 * do the cells behind it, where the jump of pressure is small again; a pressure that rises evenly is no shock.
 * Solvers that resist shear (bulla/riemann.h) answer a jump of velocities along the face, too, by half of rho c times
 * it. There those are drawn together as well, by z_t = 1 - (1 - z) min(rho_L, rho_R)/max(rho_L, rho_R): what is left
 * of the resistance is at least that of the upwind side, z rho c >= |rho u|, in a liquid and in a gas; between them,
 * where the lighter side resists and the heavier one carries, the jump stays. Other solvers carry u_t from the upwind
 * side, and keep it. Faces of troubled cells and of those beside boundaries that waves cross keep their jumps: what
 * leaves there is a wave, and with two means in place of its invariants it would not.
 *
 * Where a liquid evaporates at its surface (pairs with an `onset`), evaporation makes volume, and the velocity jumps
 * from that of the vapour to that of the liquid within the smear, on any mesh. There `least` is at most LOW_MACH_FRONT,
 * with the key or without: a face that resists holds the liquid back, and the bubble grows too slowly. */
#ifndef LOW_MACH_H
#define LOW_MACH_H

#include "scheme/frame.h"

/* The most that `least` is at surfaces where a liquid evaporates (docs/decisions/phase-change.md). */
#define LOW_MACH_FRONT 0.05

/* Faces between edges of a row: the left one of face i stands at i, the right one at right + i. They lie between the
 * cells i and i + step of a row that goes on by `step` cells on both sides. */
struct low_mach {
    size_t n, right, step;
    double least;               /* z of a fluid at rest */
    const double *rho, *rho_c2; /* at the edges; rho_c2: of the mixture, frozen */
    size_t reach;               /* from the first cell of `p` and `lean` to that before the first face */
    const double *p;            /* of the cells of the frame */
    const double *lean[2];      /* of the same: differences of the traction to the cells below and above, where
                                   neighbours' normals tell (face.h); or NULL */
    const double *mask;         /* of the cells; 1: its faces keep their jump; or NULL */
    const double *front;        /* of the cells; 1: its faces take z from LOW_MACH_FRONT on, not `least`; or NULL */
    double *part;               /* [n] z: work space */
};

/* The mask of the cells before the faces of a frame: those marked in `mask` (NULL: none), and those beside the sides
 * that are `open`, where waves cross. NULL where there are none. room: frame->count, overwritten. */
const double *low_mach_kept(const struct frame *frame, const bool open[2], const double *mask, double *room);

/* Marks the cells that hold a part of a liquid, whose fraction is given. */
void low_mach_surface(size_t n, const double *liquid, double *front);

/* z of all faces, from the velocities `u` normal to them. */
void low_mach_weigh(const struct low_mach *faces, const double *u);

/* z of velocities along the faces, from that of low_mach_weigh. */
void low_mach_lighten(const struct low_mach *faces);

/* Draws a component of velocity together. Equal ones keep their bits; mirror images give mirror images. */
void low_mach_draw(const struct low_mach *faces, double *u);

#endif
