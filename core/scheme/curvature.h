/* curvature.h - curvature of the surface between two materials, from their fractions around a tile (patch.h).
 *
 * kappa = -div n [1/m], n = grad psi/|grad psi| at the corners of cells, psi = a^m/(a^m + b^m), m = 1/8: nearly
 * straight across a front, so that differences see it well (Shukla, J. Comput. Phys. 276 (2014) 508-540; his m is 0.1,
 * an eighth is three square roots). a and b are averaged to corners and back to cells before (1-2-1 along each axis),
 * which fronts of one or two cells need. Positive for a drop of a: 1/R in a plane, 2/R of a sphere. 0 where psi is
 * flat.
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

/* Room for patches with g layers around the tiles of a mesh: 2 for curvature_take alone, 4 (HEIGHTS_LAYERS) for all. */
struct curvature *curvature_new(const struct mesh *mesh, int g);
void curvature_free(struct curvature *room); /* NULL is fine */

/* Does a row of fractions tell of a surface: with `least` of the material and as much of others? */
bool curvature_is_mixed(size_t n, const double *a, double least);

/* kappa of the cells of a tile and of g - 2 layers around it, from the fractions a and b of the patch; the row lasts
 * until the next call. `cosine`: of the angles within a at walls of the domain, by faces of the tile; 0 where the patch
 * stands as it is, a right angle at a mirror. NULL: so everywhere. */
const double *curvature_take(struct curvature *room, const struct level *level, const struct tile *tile,
                             const double *a, const double *b, const double *cosine);

/* After curvature_take: makes kappa of each layer of a smeared front that of the sharp surface of the same volume. A
 * layer that lies x nearer to the middle of a drop has 1/(R - x): through a front of three cells kappa of a disc of 8
 * cells changes by 40 %, and their mean is 1 to 6 % too large. Principal curvatures become k/(1 + x k) (parallel
 * surfaces). */
void curvature_carry(struct curvature *room, const struct level *level, const struct tile *tile);

/* After that, with g = 4: kappa from heights of columns where fronts are thin enough for them (heights.h). cosine: as
 * for curvature_take; poor: faces of the tile behind which fractions are of another mesh; columns do not count there.
 */
void curvature_heights(struct curvature *room, const struct level *level, const struct tile *tile, const double *a,
                       const double *cosine, const bool poor[MESH_FACES]);

/* Where a third material is about, a and b have each its surface against all others: curvature_keep keeps kappa of the
 * last call, that of a; curvature_oppose makes it part * kept - (1 - part) * that of the last call, of b. After Smith,
 * Solis & Chopp, Interfaces Free Bound. 4 (2002) 263-276, who give each material its part of the tensions. */
void curvature_keep(struct curvature *room);
void curvature_oppose(struct curvature *room, double part);

/* psi of the averaged fractions that the last call has made, of the tile and g - 1 layers around it; and psi of one
 * a. */
const double *curvature_psi(const struct curvature *room);
double curvature_psi_of(double a);

/* After all that: kappa[n_cell] of the tile, the mean over a cell and those around it, 1-2-1 along each axis and with
 * (a b)^2, which is largest in the middle of a front; cells with columns count twice. It leaves nothing
 * of waves of two cells, which columns see and drive, and 1 - (m h/R)^2/4 of mode m of a drop. 0 where a b is not above
 * `least`. */
void curvature_mean(struct curvature *room, const double *a, const double *b, double least, double *kappa);

#endif
