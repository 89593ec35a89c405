/* bound_row.h - cells at a boundary, side by side, and what sound does in them. */
#ifndef BOUND_ROW_H
#define BOUND_ROW_H

#include "phys/model.h"
#include "scheme/frame.h"

enum { BOUND_ROW = FRAME_CELLS / (2 * SCENE_GHOSTS) }; /* most face cells of a frame */

/* One row of boundary cells taken out of the frame: [n_field] components of `stride` points. */
struct bound_row {
    size_t n, stride;
    double *w;
};

/* Density and speed of sound of the mixture. */
void bound_row_sound(const struct model *model, const struct bound_row *row, double *rho, double *sound);

/* Each material along its isentrope from the pressures `old` to those that the row has. */
void bound_row_follow(const struct model *model, struct bound_row *row, const double *old);

#endif
