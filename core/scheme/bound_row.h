/* bound_row.h - cells at a boundary, side by side, and what sound does in them. */
#ifndef BOUND_ROW_H
#define BOUND_ROW_H

#include "phys/model.h"
#include "scheme/bound_wave.h"
#include "scheme/frame.h"

enum { BOUND_ROW = FRAME_CELLS / (2 * SCENE_GHOSTS) }; /* most face cells of a frame */

/* One row of boundary cells taken out of the frame: [n_field] components of `stride` points. */
struct bound_row {
    size_t n, stride;
    double *w;
};

/* Density and speed of sound of the mixture: with Kapila's closure Wood's, at which its waves run, and what elasticity
 * adds. */
void bound_row_sound(const struct model *model, const struct bound_row *row, double *rho, double *sound);

/* Each material along its isentrope from the pressures `old` to those that the row has; mass fractions stay. (Allaire's
 * closure: fractions stay, and all densities change alike.) Where the mixture bears no such pressure (a gas that leaves
 * fast: linear waves take more from it than it has) p, velocities and the mixture are those of the cell inside, as
 * behind an outflow. old_u: [n_velocity] rows of velocities inside; NULL: that one is as it was. */
void bound_row_follow(const struct model *model, struct bound_row *row, const double *old, const double *const *old_u);

/* Simple waves of a row [n], from density and speed of sound inside to states of pressure `there` on the isentropes.
 * The row is as it was. */
void bound_row_waves(const struct model *model, struct bound_row *row, const double *rho, const double *sound,
                     const double *there, struct bound_wave *waves);

#endif
