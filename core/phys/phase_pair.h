/* phase_pair.h - what terms ask of a liquid and its vapour: who belongs together, where the surface between them
 * is, and where they have left their saturation curve. */
#ifndef PHASE_PAIR_H
#define PHASE_PAIR_H

#include "phys/model.h"

/* A phase below this volume fraction is a trace, from which nothing grows. */
#define PHASE_PAIR_FELT 1e-6

/* Are materials l and m the liquid of a pair and its vapour, or a gas beside that? */
bool phase_pair_joins(const struct model *model, unsigned l, unsigned m);

/* Vapour and gases fill this share of a cell at the surface of a pair with an `onset`: half of it, or less where the
 * onset is less. Cells between it and the onset pass on the heat that comes to them (scheme/conduction_front.h); only
 * those at the shore (scheme/shore.h) evaporate. */
double phase_pair_front(const struct scene_phase *scene);

/* Cells of a tile that hold at least PRESENCE_FRACTION of the liquid of pair k, and of its vapour and gases together,
 * at a pressure past the end of its saturation curve: they exchange no mass. w: n primitives of the scene's model,
 * `stride` apart. Only cells with weight > 0 count; weight NULL: all. */
size_t phase_pair_past(const struct model *model, unsigned k, size_t n, size_t stride, const double *w,
                       const double *weight);

#endif
