/* curvature.h - curvature of the surface between two materials, from their fractions around a tile (patch.h).
 *
 * kappa = -div n [1/m], n = grad psi/|grad psi| at the corners of cells, psi = a^m/(a^m + b^m), m = 1/8: nearly straight
 * across a front, so that differences see it well (Shukla, J. Comput. Phys. 276 (2014) 508-540; his m is 0.1, an eighth
 * is three square roots). a and b are averaged to corners and back to cells before (1-2-1 along each axis), which fronts of
 * one or two cells need. Positive for a drop of a: 1/R in a plane, 2/R of a sphere. 0 where psi is flat.
 *
 * Where a wall asks for an angle theta other than 90 degrees (Brackbill, Kothe & Zemach, J. Comput. Phys. 100 (1992)
 * 335-354), fractions go on straight behind it, and at its corners n keeps the direction that it has along the wall,
 * with -cos theta across it. Behind it lies the kappa of before.
 *
 * A cell's kappa takes two layers of cells around it; a mean with the neighbours' (curvature_mean) one more. */
#ifndef CURVATURE_H
#define CURVATURE_H

#include "mesh/mesh.h"

#include <stdbool.h>

struct curvature;

/* Room for patches with g layers, 2 or 3, around the tiles of a mesh. */
struct curvature *curvature_new(const struct mesh *mesh, int g);
void curvature_free(struct curvature *room); /* NULL is fine */

/* Does a row of fractions tell of a surface: with `least` of the material and as much of others? */
bool curvature_is_mixed(size_t n, const double *a, double least);

/* kappa of the cells of a tile and of g - 2 layers around it, from the fractions a and b of the patch; the row lasts until
 * the next call. `cosine`: of the angles within a at walls of the domain, by faces of the tile; 0 where the patch stands as it
 * is, a right angle at a mirror. NULL: so everywhere. */
const double *curvature_take(struct curvature *room, const struct level *level, const struct tile *tile,
                             const double *a, const double *b, const double *cosine);

/* psi of the averaged fractions that the last call has made, of the tile and g - 1 layers around it; and psi of one a. */
const double *curvature_psi(const struct curvature *room);
double curvature_psi_of(double a);

/* After curvature_take with g = 3: means over a cell and those around it, 1-2-1 along each axis and with (a b)^2, which is
 * largest in the middle of a front; kappa[n_cell] of the tile. 0 where a b is not above `least`. */
void curvature_mean(struct curvature *room, const double *a, const double *b, double least, double *kappa);

#endif
