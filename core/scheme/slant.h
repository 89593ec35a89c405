/* slant.h - how the surfaces in the cells lie to the axes of the mesh, in two and three dimensions.
 *
 * A limiter that is steeper than a surface is along an axis makes steps of it: where a surface lies along x and moves
 * along x, its fractions change slowly from cell to cell of a row, and steepened they become teeth, which curvatures
 * see (docs/decisions/edges.md). So edges take as much of the interface limiter as the surface lies across the axis,
 * and `along-limiter` for the rest:
 *
 *     edges: along + s_d (steep - along),   s_d = n_d^2 = sum_l (d_d alpha_l)^2/sum_l |grad alpha_l|^2
 *
 * with differences over the 3^dim cells around, weights 1 2 1 across; 0 where all of these are alike. s_d are the last
 * fields of the state, without fluxes, and of its primitives alone: each stage makes them from the fractions that it
 * starts from (solve/curve.h); conserved fields have 0 there. Sums are paired so that mirrors, and in the plane the
 * exchange of x and y, keep all bits. */
#ifndef SLANT_H
#define SLANT_H

#include "mesh/box.h"
#include "mesh/mesh.h"
#include "phys/model.h"
#include "scheme/term.h"

#include <stdbool.h>

extern const struct term slant_term;

/* Do surfaces of a scene go by their slant? */
static inline bool slant_acts(const struct model *model)
{
    return model->n_slant > 0;
}

/* Does a fraction that says how surfaces lie vary over the n cells of a tile? [n_alpha][n]. Elsewhere no edge leaves
 * the value of its cell by more than round-off, and s may be anything. */
bool slant_varies(const struct model *model, size_t n, const double *alpha);

/* s of the cells of a tile, dim rows of n_cell. patch: its fractions with at least one layer around, as `block` lies,
 * block->pitch apart; h: widths of the cells; room: (dim + 1) * block->pitch numbers, which are
 * overwritten. */
void slant_make(const struct model *model, const struct mesh *mesh, const struct box_block *block, const double *h,
                const double *patch, double *room, double *ret_slant);

#endif
