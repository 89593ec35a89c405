/* shape_volume.h - exact volumes of cells cut by simple surfaces.
 *
 * Each function gives the fraction of a cell's volume that a body covers, in [0, 1] up to
 * round-off. They hold for a cell that the surface may or may not cut. A cell mirrored on the
 * body's centre, or with its axes exchanged, gives the same bits in cartesian geometry. */
#ifndef SHAPE_VOLUME_H
#define SHAPE_VOLUME_H

struct shape_cell {
    double lower[3], upper[3];
    int dim, beta; /* axes in use; weight x^beta of the geometry */
};

/* Volume per cross-section of the interval [a, b] of the first axis: the integral of x^beta. */
double shape_volume_along(double a, double b, int beta);

/* A box; an axis with from >= to is not bounded. Any dim and beta. */
double shape_volume_box(const struct shape_cell *cell, const double from[3], const double to[3]);

/* The side of the plane through `point` that the unit normal points into. */
double shape_volume_plane(const struct shape_cell *cell, const double point[3], const double normal[3]);

/* A ball or ellipsoid with the half-axes `axes`, positive for the axes in use (others: 0 means unbounded). In
 * axisymmetric geometry a torus when the centre is off the axis. */
double shape_volume_ball(const struct shape_cell *cell, const double centre[3], const double axes[3]);

/* A polygon in the plane of the first two axes (unbounded along the third); dim >= 2. */
double shape_volume_polygon(const struct shape_cell *cell, unsigned n, const double (*vertex)[2]);

#endif
