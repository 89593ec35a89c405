/* paint_curvature.h - curvatures of interfaces in cells of one dimension, for surface tension (scheme/tension.h).
 *
 * kappa = -div n of the unit normal n along r that points to where the inside material is: +-(A+ - A-)/V, positive
 * where it lies nearer to the centre or the axis, 0 where its fraction is the same on both sides. */
#ifndef PAINT_CURVATURE_H
#define PAINT_CURVATURE_H

#include "mesh/metric.h"
#include "phys/model.h"

/* (A+ - A-)/V of n cells [1/m]. */
void paint_curvature_size(const struct metric *metric, size_t n, double *size);

/* kappa of n cells; a, b: fractions of the inside and the outside material, from the cell before the first on. */
void paint_curvature_cells(size_t n, const double *size, const double *a, const double *b, double *kappa);

/* Curvatures of a tile that has just been painted, into their rows of u. Beside the tile lies what lies at its edge. */
void paint_curvature(const struct model *model, const struct mesh *mesh, const struct level *level,
                     const struct tile *tile, double *u);

#endif
