/* prolong_held.h - ghosts of pressure where forces act: what a coarse cell's own weight makes of pressure within it.
 *
 * Of the differences to its neighbours along an axis, F = (G_i + G_k)/2 is held by forces (scheme/source_weight.h),
 * with G = rho a H in each of the cells; the children get a quarter of the limited slope of what is left, and of the
 * cell's own G. So layers that lie on each other at rest, each of one density, have the pressures that they have on the
 * finer level, next to their interface, too: where minmod would take the slope of the lighter or the mean one. */
#ifndef PROLONG_HELD_H
#define PROLONG_HELD_H

#include "levels/prolong_slope.h"
#include "mesh/box.h"
#include "scheme/source_weight.h"

#include <stdbool.h>

struct prolong_held;

/* For blocks of `cells`, from a model with forces; NULL without sources. */
struct prolong_held *prolong_held_new(const struct model *model, const struct mesh *mesh, size_t cells);
void prolong_held_free(struct prolong_held *held);

/* G of the block w of a tile of a coarse level, for all its cells from[d] - 1 <= i < to[d] + 1; stride and origin:
 * where they lie in the block. */
struct prolong_held_block {
    const struct level *level;
    const struct tile *tile;
    double t;
    const size_t *from, *to, *stride;
    size_t origin, cells;
    const double *w;
};

void prolong_held_fill(struct prolong_held *held, const struct prolong_held_block *block);

/* Rows of G by axis at the same places as the block; NULL along axes without forces. */
const double *const *prolong_held_rows(const struct prolong_held *held);

/* What a child lies beside its coarse cell along an axis, at cell `at` of p and G (NULL: no force). */
static inline double prolong_held_slope(const double *p, const double *G, size_t stride)
{
    if (!G) return prolong_slope(p, stride);
    double below = 0.5 * (*(G - stride) + G[0]), above = 0.5 * (G[0] + G[stride]);
    return 0.25 * (prolong_slope_minmod((p[0] - *(p - stride)) - below, (p[stride] - p[0]) - above) + G[0]);
}

#endif
