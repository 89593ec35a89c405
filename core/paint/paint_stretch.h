/* paint_stretch.h - the stretch of painted cells: an average over their solid, as unimodular as where it was said. */
#ifndef PAINT_STRETCH_H
#define PAINT_STRETCH_H

#include "phys/model.h"

#include <stddef.h>

/* Determinant of a symmetric tensor in the order of elastic.h, or a value <= 0 if it is not positive definite. */
double paint_stretch_det(const double V[6]);

/* Divides V by the cube root of its determinant, which is above 0. */
void paint_stretch_unimodular(const struct model *model, double V[6]);

/* Volume fraction of solid s of the model in a state whose fields are `stride` apart, conserved or primitive; 1 without
 * fractions. */
double paint_stretch_share(const struct model *model, unsigned s, const double *state, size_t stride);

/* Lays a state over fraction f of a cell: V of each solid becomes the mean over that of both, the identity without. Of
 * `cell` (conserved fields, `stride` apart) the fractions are those before, `covered` the part that has a state. */
struct paint_stretch_layer {
    double fraction, covered;
    const double *state; /* conserved fields of the layer, `stride` apart */
    size_t stride;
};
void paint_stretch_mix(const struct model *model, const struct paint_stretch_layer *layer, size_t stride, double *cell);

/* Makes the n cells of u (fields `stride` apart) what a step of the solver would leave: unimodular, and faded where
 * there is hardly any solid. */
void paint_stretch_finish(const struct model *model, size_t n, size_t stride, double *u);

/* Maxwell branches begin relaxed: the stretches of all of them, of n points, become the identity. */
void paint_stretch_relaxed(const struct model *model, size_t n, size_t stride, double *fields);

#endif
