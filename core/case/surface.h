/* surface.h - closed surfaces of triangles, and how much of a cell they enclose.
 *
 * Read from STL files (3D Systems 1989; text or binary), the common language of scanners and CAD. The file repeats a
 * corner in each of its triangles: equal ones become one vertex, so that edges are known and a hole is found. A surface
 * may have many parts, holes in them, and touch itself; where parts overlap the region counts once.
 *
 * A cell gets its exact volume. With outward normals the point p is inside as often as the ray from p along +x leaves
 * the surface more often than it enters it, so that V = sum over triangles of sign(n_x) int int min(max(x(y, z) -
 * lower_x, 0), h_x) dy dz over the part of the triangle's shadow on the (y, z) plane that lies in the cell's. No case
 * is special: faces that lie in the plane of a cell have no shadow, or the same from both sides. */
#ifndef SURFACE_H
#define SURFACE_H

#include "case/shape_volume.h"

#include <stdbool.h>
#include <stddef.h>

struct surface_node {
    double lower[3], upper[3]; /* the box around its triangles */
    size_t first, n;           /* leaf: triangles first .. first + n - 1; else n = 0, and ... */
    size_t right;              /* ... the other child; one child is the next node */
};

struct surface {
    size_t n_vertex, n, n_node;
    double (*vertex)[3]; /* [n_vertex] */
    size_t (*corner)[3]; /* [n] vertices of a triangle, counterclockwise seen from outside, in the order of the tree */
    struct surface_node *node; /* [n_node]; NULL until surface_place */
};

enum { SURFACE_TRIANGLES = 20000000 };

/* Reads an STL file: corners as they stand there, triangles without area left out, the outside where the volume is
 * positive. STATUS_CASE with what is wrong and where: no STL file, numbers that are none, an edge that does not belong
 * to two triangles (a hole), neighbours that are wound against each other. Release with surface_done, also after
 * failure. */
int surface_read(const char *path, struct surface *ret_surface);
void surface_done(struct surface *surface);

/* Is every edge shared by two triangles that run along it in opposite directions (or by more, in pairs)? STATUS_CASE
 * says how many are not and where one lies, in the file's units. */
int surface_check(const struct surface *surface);

/* What it encloses; negative if its triangles are seen from inside. */
double surface_volume(const struct surface *surface);
void surface_bounds(const struct surface *surface, double ret_lower[3], double ret_upper[3]);

/* Moves each vertex x to turn x scale + offset, turn[3][3] a rotation, and builds the tree that the
 * functions below need. */
void surface_place(struct surface *surface, const double turn[3][3], double scale, const double offset[3]);

/* Signed distance of a point: < 0 inside. */
double surface_level(const struct surface *surface, const double x[3]);

/* Fraction of a cell of three axes, weight 1, that lies inside; in [0, 1]. */
double surface_fraction(const struct surface *surface, const struct shape_cell *cell);

#endif
