/* voxels.h - a field of a box on equal cells, for rays that look for its surfaces.
 *
 * Leaves of all levels are laid on a grid as fine as the finest of them, or as many cells as there is room for: each
 * cell has the mean of the leaves in it by volume. Between centres values are trilinear (Levoy, IEEE CG&A 8(3), 1988);
 * blocks of cells know their extremes, so that rays pass in one step where no surface can be. */
#ifndef VOXELS_H
#define VOXELS_H

#include "io/read.h"

#include <stdbool.h>
#include <stddef.h>

enum { VOXELS_BLOCK = 8, VOXELS_MOST = 1 << 24 };

struct voxels {
    size_t n[3], n_block[3];
    double domain[2][3], h[3]; /* corners and sides of cells [m] */
    float *values;             /* [n2][n1][n0], NaN: nothing there */
    float *least, *most;       /* [blocks] of the values that a point in the block depends on */
};

/* The box of a snapshot in three dimensions, or of an axisymmetric one that is turned about its axis: x and y then are
 * across it, z along it. */
void voxels_domain(const struct snapshot *snapshot, double ret_domain[2][3]);

/* The part `domain` of that box, of one value for each leaf; at most some `room` cells. Free with voxels_done. */
void voxels_fill(const struct snapshot *snapshot, const double *values, const double domain[2][3], size_t room,
                 struct voxels *ret_voxels);
void voxels_done(struct voxels *voxels);

/* Value at a point; at the edges that of the last cell. */
double voxels_at(const struct voxels *voxels, const double x[3]);

/* The part of a ray inside of the box: false if it misses it. `along` has length 1. */
bool voxels_clip(const double domain[2][3], const double from[3], const double along[3], double *ret_begin,
                 double *ret_end);

/* Where a ray first meets the surface on which the field is `level`, within [begin, end] of it; the unit normal there
 * points to larger values. */
bool voxels_hit(const struct voxels *voxels, double level, const double from[3], const double along[3],
                const double span[2], double *ret_t, double ret_normal[3]);

/* Widens `extremes` by the values of `field` beside the surface of `voxels`; both were filled from the same
 * snapshot. */
void voxels_range(const struct voxels *voxels, double level, const struct voxels *field, double extremes[2]);

#endif
