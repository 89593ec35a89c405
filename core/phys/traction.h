/* traction.h - one normal traction for all materials of a cell.
 *
 * Across the interface of a solid and a fluid the traction is common, not the pressure: with s'_l the solid's own
 * deviator, per its own volume, -p_l + s'_l,nn is the same for all materials. So in a mixed cell each material has a
 * pressure of its own, p_l = p + s'_l,nn - S,   S = sum_l alpha_l s'_l,nn, about the mean p = sum alpha_l p_l, and the
 * cell's stress is still -p 1 + sum alpha_l s'_l. Where n is known without looking at neighbours: in one dimension,
 * model->split (docs/decisions/common-traction.md).
 *
 * Across an interface with surface tension p differs by sigma kappa. A smeared one has a part of that step in each of
 * its cells, p = p_outside + alpha_inside sigma kappa, and its materials lag behind the mean of the cell by p_l - p =
 * sum_m alpha_m sigma_lm kappa_lm, so that each has one pressure throughout (docs/decisions/tension.md). Both may act
 * in one cell. */
#ifndef TRACTION_H
#define TRACTION_H

#include "phys/model.h"

#include <stddef.h>

/* s'_l,xx of each material in its own volume, from primitives w: row l at own + l * pitch, 0 for fluids [Pa]. */
void traction_own(const struct model *model, size_t n, size_t stride, const double *w, size_t pitch, double *own);

/* Cells that have a normal N, and it, packed: component d at normal + d * pitch. */
struct traction_aimed {
    size_t n;
    const unsigned *at;
    size_t pitch;
    const double *normal;
};

/* s'_nn of the solids at those cells of w, packed: row s at own + s * pitch. pull: NULL, or s'N [Pa], component d of
 * solid s at pull + (3 s + d) * pitch. */
void traction_at(const struct model *model, const struct traction_aimed *aimed, size_t stride, const double *w,
                 size_t pitch, double *own, double *pull);

/* S = sum_l alpha_l s'_l,xx [Pa], from primitives w. */
void traction_mean(const struct model *model, size_t n, size_t stride, const double *w, double *mean);

enum { TRACTION_BATCH = 512 };

/* The materials' pressures in n <= TRACTION_BATCH cells. */
struct traction_pressures {
    double lag[SCENE_MATERIALS][TRACTION_BATCH]; /* p_l - p, exactly 0 where a material is alone [Pa] */
    double own[TRACTION_BATCH];
};

/* Finds the lags from primitives w; does nothing unless the model is lagged. */
void traction_part(const struct model *model, size_t n, size_t stride, const double *w, struct traction_pressures *ret);

/* p_l = p + lag of material l: p itself unless the model is lagged, else a row that lasts until the next call. */
const double *traction_pressure(const struct model *model, size_t n, unsigned l, const double *p,
                                struct traction_pressures *parts);

#endif
