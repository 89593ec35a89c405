/* outside.h - where a law's continuation stands in for its formulas (count_outside of bulla/eos.h). */
#ifndef OUTSIDE_H
#define OUTSIDE_H

#include "phys/model.h"

#include <stddef.h>

/* Does the law of material l tell? */
bool outside_is_told(const struct model *model, unsigned l);

/* Cells of a tile with a volume fraction of material l of at least PRESENCE_FRACTION at which its law does not hold; w:
 * n primitives of the scene's model, `stride` apart. Only cells with weight > 0 count; weight NULL: all. 0 for laws
 * that do not tell. */
size_t outside_count(const struct model *model, unsigned l, size_t n, size_t stride, const double *w,
                     const double *weight);

#endif
