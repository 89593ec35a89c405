/* cut_wall.h - the pressure of fluids on a rigid wall. */
#ifndef CUT_WALL_H
#define CUT_WALL_H

#include "mesh/rigid.h"
#include "phys/model.h"

/* n cells that a wall closes: primitives of the path, component q at w + q stride; where each lies in the block of
 * `cells`. */
struct cut_wall {
    const struct model *model;
    size_t n, stride;
    const double *w;
    const struct rigid_cells *cells;
    const size_t *at; /* [n] */
    double *scratch;  /* [n_material + 3] rows of `stride` */
};

/* Pressure between what is in a cell and its image that the wall makes of it, as a gas of two atoms has it, gamma
 * = 1.4: towards the wall  p + rho u (s u + sqrt(s^2 u^2 + c^2)), s = (gamma + 1)/4: a shock; away from it      p -
 * (rho c^2/gamma) (1 - (1 + (gamma - 1)/2 u/c)^7): a rarefaction, u the velocity towards the wall, relative to it (Toro
 * 2009, 4.3 and 6.3.3). Sound, p + rho c u, is right for all laws, and for liquids u is small against c. p where there
 * is no wall. Leaves densities and squares of the speed of sound in the first two rows of `scratch`. */
void cut_wall_pressure(const struct cut_wall *wall, double *ret_p);

/* Takes the velocity towards the wall out of the primitives w: what is left goes along it, or with it. `stop`: what
 * goes along it is taken, too. */
void cut_wall_slide(const struct cut_wall *wall, bool stop, double *w);

#endif
