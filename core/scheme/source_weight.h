/* source_weight.h - the part of sources that pressure has to hold: accelerations along the axes of the mesh.
 *
 * Within a cell an acceleration a asks for the pressure difference G = rho a h in balance, from the middle to each face
 * for half of it (face_work.rise), and between the middles of two cells for F = (G_i + G_k)/2. Pressure is
 * reconstructed relative to that (edges.h): where it differs by F from cell to cell, edges of neighbours meet, u* = 0,
 * and the cell's force rho a cancels the difference of its p* to round-off. Behind boundaries pressure goes on as in
 * balance. After Kappeli & Mishra, J. Comput. Phys. 259 (2014) 199-219, with the difference that the means of
 * neighbours ask for in place of an isentrope. Forces per volume take no part: mostly it is not pressure that holds
 * them (flow, stress), and slopes without them are the worse ones then (docs/numerics.md). */
#ifndef SOURCE_WEIGHT_H
#define SOURCE_WEIGHT_H

#include "scheme/source_value.h"
#include "scheme/term.h"

/* Is there an acceleration along an axis? Those of a Lua table do not count. */
bool source_weight_any(const struct scene *scene, int axis);

/* Pressure in the layers behind a boundary, filled without forces, goes on in balance: what mirrors put there has the
 * pressure of the layer that it mirrors, what copies and waves do that of the cell inside, what flows in that of the
 * face. Rows of all fields, `pitch` apart. */
void source_weight_continue(struct source_value *values, const struct source_value_place *place,
                            const struct frame *frame, int side, size_t pitch, double *w);

/* Slot of the term (source.c): the rises of a gathered piece. */
void source_weight_frame(struct source_value *values, const struct term_piece *piece);

#endif
