/* shape.h - regions, and how much of a cell they cover.
 *
 * A shape is a tree: primitives (box, half-space, sphere, cylinder, ellipsoid, ring, polygon, closed surfaces and
 * arrays from files) and complement, union, intersection of shapes, and shapes that are turned. It knows a signed level
 * function (negative inside, never larger in magnitude than the distance to its surface), which decides cells that no
 * surface cuts. Cells cut by one primitive get its exact volume (shape_volume.h); those cut by several, or by a slanted
 * cylinder in 3D, are divided, and the last boxes get the volume under a plane (Scardovelli & Zaleski 2000, J. Comput.
 * Phys. 164, 228). Axes that a scene does not have are at x = 0. */
#ifndef SHAPE_H
#define SHAPE_H

struct surface;
struct raster;

enum shape_type {
    SHAPE_EVERYWHERE,
    SHAPE_BOX,
    SHAPE_HALF_SPACE,
    SHAPE_SPHERE,
    SHAPE_CYLINDER,
    SHAPE_ELLIPSOID,
    SHAPE_RING,
    SHAPE_POLYGON,
    SHAPE_SURFACE,
    SHAPE_RASTER,
    SHAPE_TURNED,
    SHAPE_COMPLEMENT,
    SHAPE_UNION,
    SHAPE_INTERSECTION,
};

struct shape {
    enum shape_type type;
    double a[3]; /* box: lower; half-space: a point of the plane; others: centre (cylinder: one end) */
    double b[3]; /* box: upper; half-space: unit normal INTO the region; cylinder: other end; ellipsoid: half-axes (0 on
                    an axis that the scene does not have: unbounded) */
    double radius, inner; /* sphere, cylinder; ring (2D or shell): outer radius and inner radius */
    unsigned n;           /* vertices of the polygon, or number of parts */
    double (*vertex)[2];  /* polygon in the (x, y) plane, either orientation */
    struct shape **parts; /* turned (1), complement (1), union, intersection */
    struct surface *surface;
    struct raster *raster;
    double turn[3][3]; /* turned: the rotation about a; x belongs to the shape if its turn^T (x - a) + a does to the
                          part */
};

/* Signed level of a point: < 0 inside, |level| <= distance to the surface. */
double shape_level(const struct shape *shape, const double x[3]);

/* Is the point inside (surface included)? NULL shape: everywhere. */
int shape_contains(const struct shape *shape, const double x[3]);

/* Fraction of a cell's volume that the shape covers, 0 <= f <= 1, with the metric of the
 * geometry (beta 0: uniform, 1: weight x, 2: weight x^2). `dim` axes are used; exact 0 and 1
 * where the cell is outside or inside, also when round-off of its corners says 1e-10 else.
 * In cartesian geometry mirrored cells get the same bits, but for surfaces and turned shapes. NULL shape: 1. */
double shape_fraction(const struct shape *shape, const double lower[3], const double upper[3], int dim, int beta);

/* Does the shape reach into a box of `dim` axes? 0 only if it surely does not; it may be as small as it likes. NULL
 * shape: 1. */
int shape_reaches(const struct shape *shape, const double lower[3], const double upper[3], int dim);

void shape_free(struct shape *shape); /* parts too; NULL is fine */

#endif
