/* metric.h - exact face areas and cell volumes for cartesian, axisymmetric and spherical grids.
 *
 * Geometry enters through the first axis alone. Per cell column i of a tile (first axis):
 * area of its faces normal to axis 0, and the common factor of volume and of the areas normal
 * to the other axes, so that V = volume[i] * h1 * h2 and, e.g., A_1 = volume[i] * h2:
 *     beta 0: area 1,   volume h;   beta 1: area r, volume (r+^2 - r-^2)/2;
 *     beta 2: area r^2, volume (r+^3 - r-^3)/3.
 * Areas and volumes are per radian (beta 1) or per steradian (beta 2); metric_full gives the
 * factor (1, 2 pi, 4 pi) that makes them whole, used in everything that people read.
 *
 * What turns around the axis (swirl, beta 1) has momentum rho u_th whose lever is the radius: it
 * counts with areas r^2 and volumes (r+^3 - r-^3)/3, so that angular momentum is what is kept. The
 * same as its mean times the cell's volume and the middle of that volume. */
#ifndef METRIC_H
#define METRIC_H

#include "mesh/mesh.h"

enum { METRIC_CELLS = 256 }; /* most cells of a tile along an axis */

struct metric {
    double area[METRIC_CELLS + 1]; /* face i is the lower face of cell i */
    double volume[METRIC_CELLS];
    double centre[METRIC_CELLS];                                   /* middle of the cell along axis 0 */
    double turn_area[METRIC_CELLS + 1], turn_volume[METRIC_CELLS]; /* beta 1: of what turns; else not filled */
};

/* Of n <= METRIC_CELLS cells of a level, from number `first` on along axis 0; those before 0 lie behind the axis or a
 * wall. */
void metric_of_cells(const struct mesh *mesh, const struct level *level, int first, int n, struct metric *ret);
void metric_of_tile(const struct mesh *mesh, const struct level *level, const struct tile *tile, struct metric *ret);

/* Where cell values stand along axis 0: ret[i + 1] of cell i from -1 to n, the middles of the volumes (the mean of r
 * with the weight r^beta; cells behind a boundary mirror those inside). ret has METRIC_CELLS + 2 places. */
void metric_centroids(const struct mesh *mesh, const struct level *level, const struct tile *tile, double *ret);

/* The same of a cell between two radii. */
double metric_centroid(int beta, double a, double b);

/* Whole volume of each cell of a tile [m3; m2 per metre of depth in 2D cartesian, m in 1D]. */
void metric_volumes(const struct mesh *mesh, const struct level *level, const struct tile *tile, double *ret_volume);

double metric_full(int beta);

#endif
