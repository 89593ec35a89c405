/* soften.h - which cells of a tile may have to be softened (phys/soft.h). Cheap: nothing is solved for. */
#ifndef SOFTEN_H
#define SOFTEN_H

#include "phys/model.h"

#include <stdbool.h>
#include <stddef.h>

enum { SOFTEN_BATCH = 512 };

/* Does a scene soften at all? With kapila and a fluid, where materials of a cell have one pressure, and where only
 * waves give heat or volume to a material: no phase changes, nothing conducts, no source heats. model: of the scene,
 * not of a path. */
bool soften_applies(const struct model *model);

struct soften_suspect {
    size_t cell;
    double least; /* rho_l c_l^2 [Pa] */
};

/* n <= SOFTEN_BATCH cells of blocks of `stride`, which begin at the first of them: conserved fields, primitives and
 * rho_l c_l^2 after a stage, pressures before it. Returns how many of them are shared by several materials and have
 * another pressure than before, by more than a part of their least rho_l c_l^2; which, in rising order, and that. */
size_t soften_find(const struct model *model, size_t n, size_t stride, const double *u, const double *w,
                   const double *rho_c2, const double *p_before, struct soften_suspect ret_suspects[SOFTEN_BATCH]);

#endif
