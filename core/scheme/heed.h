/* heed.h - what of a cell sets the time step of what diffuses: heat (conduction.h), gases in each other (fick.h).
 *
 * Little of a cell, or next to nothing of its mass, does not; what goes through it is bounded by what keeps it stable.
 * What little gas there is in torn liquid is so thin that it would ask for steps of 1e-16 s
 * (docs/decisions/heat-channels.md). */
#ifndef HEED_H
#define HEED_H

#include "phys/model.h"

#include <stddef.h>

/* The least part of a cell, and of its mass. */
#define HEED_VOLUME 0.01
#define HEED_MASS 1e-6

/* Density of n cells with primitives w: that of the only material, or made in room[n] [kg/m3]. */
const double *heed_density(const struct model *path, size_t n, size_t stride, const double *w, double *room);

/* Of n fractions those that set the time step, else 0; rho_l: density of the part, rho: of the cell. */
void heed_parts(size_t n, const double *part, const double *rho_l, const double *rho, double *sets);

#endif
