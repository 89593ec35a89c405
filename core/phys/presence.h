/* presence.h - where a material is more than nothing, so that its temperature means something.
 *
 * Two kinds of cells hold a material in name only. Traces, down to 1e-12 of a cell, that numerical fronts carry. And
 * voids: cells that a liquid in tension has left, filled by gas without mass (1e-11 kg/m3); at the pressure around them
 * that gas would have 1e12 K. Both would decide any mean of a temperature by volume. */
#ifndef PRESENCE_H
#define PRESENCE_H

#include "mesh/mesh.h"
#include "phys/model.h"

/* Least volume fraction that is felt. */
#define PRESENCE_FRACTION 1e-3

/* Least density [kg/m3] of material l that is felt: 1e-3 of its mass over its volume in the whole scene now; 0 where a
 * scene has one material only, or none of this one. The same on any number of ranks. Collective. */
double presence_density(const struct model *model, const struct mesh *mesh, unsigned l);

#endif
