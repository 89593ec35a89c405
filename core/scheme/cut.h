/* cut.h - cells that rigid bodies cut: two terms, one at each end of the list.
 *
 * A cell has the part theta of its volume, its faces the parts a of their areas, a wall the rest (mesh/rigid.h):
 *     theta du/dt = -sum_d [(a F)+ - (a F)-]/h_d - W . F_wall,   F_wall = (0, p_w, p_w U).
 * Cells may be as small as they like without a smaller step: of a face, the part that looks at the wall of a cell gets
 * a flux between that of the face and that of the wall, G + alpha (F - G),   alpha = min over axes of (k theta - a)/(a-
 * + a+ - 2 a),   a = min(a-, a+, theta), at most 1, so that what the cell gets is at most k times what a whole one
 * would (Klein, Bates & Nikiforakis 2009, Phil. Trans. R. Soc. A 367, 4559; Gokhale, Nikiforakis & Klein 2018, J.
 * Comput. Phys. 364, 186). G is the flux of what is in the cell without its velocity towards the wall, with the wall's
 * pressure: sum_d W_d G_d is what the wall gives, so that a uniform flow along a wall stays one, which fluxes of the
 * wall alone would not let. It is one flux for both sides: mass and energy beside bodies at rest are conserved to
 * round-off. Beside bodies that move they are to second order in the time step.
 * Scenes of several materials: see cut_flux_pressure and cut_flux_misses (docs/decisions/bodies.md).
 *
 * cut_term fills what is covered before faces are made, and makes rates of the cells' parts from rates of whole ones;
 * cut_flux_term changes the fluxes once all other terms have added to them (cut_flux.c). */
#ifndef CUT_H
#define CUT_H

#include "scheme/term.h"

extern const struct term cut_term, cut_flux_term;

/* Has a path rigid bodies beside it? */
bool cut_wanted(const struct model *path);

/* A tile at a time. */
struct cut_force {
    const struct model *model;
    const struct mesh *mesh;
    const struct level *level;
    const struct tile *tile;
    double t;                 /* [s] */
    const double *w, *volume; /* primitives; what counts of each cell [m3, ...] */
};

/* What presses along an axis on one body in the cells of a tile: the sum of p_w W_axis V [N; per metre in 2D, per m2 in
 * 1D]. Of CUT_POWER what that works, the sum of p_w W . U V [W]. */
enum { CUT_POWER = -1 };
double cut_force(const struct cut_force *force, unsigned rigid, int axis);

#endif
