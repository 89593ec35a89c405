/* slip.h - where a solid meets a fluid its surface bears no shear.
 *
 * A fluid without viscosity has no shear traction, so the shear traction t_l of solid l on the normal n of its surface
 * is 0 there. But a mixed cell has one velocity: what the solid slides past shears it, and the little solid of cells
 * that are nearly fluid is dragged along without end. So after each stage the solids of a cell slide by a_l along the
 * surface,
 *     V_l <- polar((1 + a_l n^T) V_l),   t_l + k_l a_l = (1 - alpha_f) t_l,
 * with k_l the stiffness against shear along n (neo-Hookean: G n.Bn), alpha_f the fraction of the fluids, and n along
 * the gradient of the fractions of solids; less where that is small (seam.h). What is nearly solid keeps its shear, as
 * its centre is not the surface; what is nearly fluid loses all. Elastic energy falls, and is heat.
 * docs/decisions/oblique-surfaces.md. */
#ifndef SLIP_H
#define SLIP_H

#include "scheme/term.h"

/* Acts behind strain.h, viscoelastic.h and weld.h, on paths with solids and fluids, if the scene says so. */
extern const struct term slip_term;

#endif
