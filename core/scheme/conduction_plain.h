/* conduction_plain.h - heat in one material with a constant conductivity: most faces of most scenes, also in tiles that
 * others touch. It fills all of each face, meets nothing but itself and leaves no traces: one loop is left of the
 * channels. */
#ifndef CONDUCTION_PLAIN_H
#define CONDUCTION_PLAIN_H

#include "phys/model.h"

/* The material that is alone in n cells and such a one, or -1. w: their primitives, [pitch]. */
int conduction_plain_find(const struct model *path, size_t n, size_t pitch, const double *w);

/* q[n] = k (T_i - T_(i+step))/d of material l, bit by bit what conduction.c would make; 0 where a cell has no
 * temperature. T: [n + step] [K]; per_d: 1/d of each face. */
void conduction_plain_flux(const struct model *path, unsigned l, size_t n, size_t step, const double *T,
                           const double *per_d, double *q);

#endif
