/* distance.h - how far apart the cells beside a face are, for what diffuses: between their centroids, a radius with its
 * weight. Boundaries behind which there are states of waves, and mirrors, let nothing through: their faces get 1/d =
 * 0. */
#ifndef DISTANCE_H
#define DISTANCE_H

#include "scheme/term.h"

/* 1/d of the faces of a piece [1/m]: a row of piece->faces->faces.n. */
void distance_faces(const struct term_piece *piece, double *per_d);

/* Does a piece end at the boundary of the domain, on this side of its axis? */
bool distance_ends(const struct term_piece *piece, int side);

/* What a step may take, against the limit of stability: DISTANCE_PACE D sum 1/h^2 <= 1/dt, D a diffusivity. */
#define DISTANCE_PACE (8.0 / 1.8)

/* Sum of 1/h^2 over the axes of a level [1/m2]. */
double distance_squares(const struct level *level, int dim);

#endif
