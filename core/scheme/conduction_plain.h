/* conduction_plain.h - heat in one material with a constant conductivity: most faces of most scenes. It fills all of each
 * face, meets nothing but itself and leaves no traces: one loop is left of the channels. */
#ifndef CONDUCTION_PLAIN_H
#define CONDUCTION_PLAIN_H

#include "phys/model.h"

/* Is that all there is to a path? */
bool conduction_plain_is(const struct model *path);

/* Adds k (T_i - T_(i+step))/d to n fluxes of energy, bit by bit what conduction.c would; nothing where a cell has no
 * temperature. T: [n + step] [K]; per_d: 1/d of each face. */
void conduction_plain_add(const struct model *path, size_t n, size_t step, const double *T, const double *per_d,
                          double *energy);

#endif
