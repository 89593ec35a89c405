/* surface.h - the mean of a field over the interface of a material, its surface alpha = 0.5. */
#ifndef SURFACE_H
#define SURFACE_H

#include "io/region.h"
#include "phys/derive.h"
#include "solve/state.h"

/* Area-weighted mean of a field (prepared for the present time) on the surface; of a vector, its
 * magnitude; `where` (or NULL) restricts it to cells covered by half. NaN if there is no surface.
 * Collective. */
double surface_mean(const struct state *state, unsigned material, const struct derive *field,
                    const struct region *where);

#endif
