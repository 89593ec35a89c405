/* paint.h - the initial state: layers of paint on the cells of a tile.
 *
 * This folder, paint: the initial state of a case, cell by cell, also where boundaries and new tiles ask for it. */
#ifndef PAINT_H
#define PAINT_H

#include "mesh/mesh.h"
#include "phys/model.h"

/* Fills the conserved fields of a tile, u[n_field][n_cell] (cells x fastest, order as in model.h), with the cell
 * averages of the scene's layers. A layer covers the fraction f of a cell that lies in its shape: mass, momentum,
 * energy and volume fractions become (1 - f) before + f layer. Values that vary in space are averaged over the cell,
 * or over its part inside the shape, by four Gauss points per axis. STATUS_CASE: a state that no material can have, or
 * a script that fails; the message names layer, place, field and value.
 *
 * With model->reaches a shape's surface between a liquid and its vapour (or the gases beside it) that lies on faces of
 * cells puts a trace of each, some 4e-6 of the cell, into the cells of the other. Where a pair has an `onset`, and heat
 * is conducted, its surfaces are smeared at the end (paint_smear.h). */
int paint_tile(const struct model *model, const struct mesh *mesh, const struct level *level, const struct tile *tile,
               double *u);

#endif
