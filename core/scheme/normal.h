/* normal.h - the normals of the surfaces of solids, in two and three dimensions.
 *
 * The materials of a mixed cell share the traction on their interface (phys/traction.h), so the cell has to know how
 * that lies. The closure is called cell by cell, so that normals are fields of the state, without fluxes: each stage
 * makes them from the fractions that it starts from, N = min(1, |d|/1e-3) g/|g|,     g = grad alpha_s over the 3^dim
 * cells around, weights 1 2 1 across, d = h g, 0 where none of the neighbours across faces differs. The square of the
 * length is the weight of the traction: a mixture that lies about evenly has one pressure. Sums are paired so that
 * mirrored states have mirrored normals, to the bit. */
#ifndef NORMAL_H
#define NORMAL_H

#include "scheme/term.h"

extern const struct term normal_term;

/* N of the cells of a tile, dim rows of n_cell; around: as term_tile.around, h: widths of the cells. */
void normal_make(const struct model *model, const struct mesh *mesh, const double *h, const double *around,
                 double *ret_normal);

#endif
