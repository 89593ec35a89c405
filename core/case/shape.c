/* shape.c - see shape.h: levels, what is inside, and which exact volume a cell needs.
 *
 * Most cells are far from every surface and are decided by one level at their middle. */
#include "case/shape.h"

#include "base/mem.h"
#include "case/raster.h"
#include "case/shape_volume.h"
#include "case/surface.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

enum { SHAPE_VERTICES = 64 }; /* most of a polygon that is turned as one */

static const double SHAPE_PURE = 1e-10; /* a smaller part is the round-off of cell corners */

static double shape_level_box(const struct shape *shape, const double x[3])
{
    double level = -INFINITY;
    for (int d = 0; d < 3; d++) {
        if (!(shape->a[d] < shape->b[d])) continue;
        double below = shape->a[d] - x[d], above = x[d] - shape->b[d], out = below > above ? below : above;
        level = out > level ? out : level;
    }
    return level;
}

static double shape_distance(const double a[3], const double b[3])
{
    double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return sqrt(x * x + y * y + z * z);
}

/* Scaling to the unit ball shortens no distance by more than the least half-axis. */
static double shape_level_ellipsoid(const struct shape *shape, const double x[3])
{
    double square = 0.0, least = INFINITY;
    for (int d = 0; d < 3; d++) {
        if (!(shape->b[d] > 0.0)) continue;
        double s = (x[d] - shape->a[d]) / shape->b[d];
        square += s * s;
        least = shape->b[d] < least ? shape->b[d] : least;
    }
    return (sqrt(square) - 1.0) * least;
}

static double shape_level_cylinder(const struct shape *shape, const double x[3])
{
    double length = shape_distance(shape->a, shape->b), along = 0.0, square = 0.0;
    for (int d = 0; d < 3; d++) along += (x[d] - shape->a[d]) * (shape->b[d] - shape->a[d]) / length;
    for (int d = 0; d < 3; d++) {
        double off = x[d] - shape->a[d] - along * (shape->b[d] - shape->a[d]) / length;
        square += off * off;
    }
    double side = sqrt(square) - shape->radius, end = along - length > -along ? along - length : -along;
    return side > end ? side : end;
}

static double shape_level_ring(const struct shape *shape, const double x[3])
{
    double r = shape_distance(x, shape->a), out = r - shape->radius, in = shape->inner - r;
    return out > in ? out : in;
}

/* Distance to the nearest edge; inside by counting the edges that a ray crosses. */
static double shape_level_polygon(const struct shape *shape, const double x[3])
{
    double least = INFINITY;
    bool inside = false;
    for (unsigned i = 0; i < shape->n; i++) {
        const double *a = shape->vertex[i], *b = shape->vertex[i + 1 < shape->n ? i + 1 : 0];
        double ex = b[0] - a[0], ey = b[1] - a[1], px = x[0] - a[0], py = x[1] - a[1], square = ex * ex + ey * ey;
        double s = square > 0.0 ? (px * ex + py * ey) / square : 0.0;
        s = s < 0.0 ? 0.0 : s > 1.0 ? 1.0 : s;
        double away = hypot(px - s * ex, py - s * ey);
        least = away < least ? away : least;
        if ((a[1] > x[1]) != (b[1] > x[1]) && px < py * ex / ey) inside = !inside;
    }
    return inside ? -least : least;
}

static double shape_level_turned(const struct shape *shape, const double x[3])
{
    double back[3];
    for (int d = 0; d < 3; d++) {
        back[d] = shape->a[d];
        for (int k = 0; k < 3; k++) back[d] += shape->turn[k][d] * (x[k] - shape->a[k]);
    }
    return shape_level(shape->parts[0], back);
}

/* sign 1: the largest level of the parts; -1: the smallest. */
static double shape_level_parts(const struct shape *shape, const double x[3], double sign)
{
    double most = -INFINITY;
    for (unsigned i = 0; i < shape->n; i++) {
        double level = sign * shape_level(shape->parts[i], x);
        most = level > most ? level : most;
    }
    return sign * most;
}

double shape_level(const struct shape *shape, const double x[3])
{
    switch (shape->type) {
    case SHAPE_BOX: return shape_level_box(shape, x);
    case SHAPE_HALF_SPACE:
        return shape->b[0] * (shape->a[0] - x[0]) + shape->b[1] * (shape->a[1] - x[1]) +
               shape->b[2] * (shape->a[2] - x[2]);
    case SHAPE_SPHERE: return shape_distance(x, shape->a) - shape->radius;
    case SHAPE_CYLINDER: return shape_level_cylinder(shape, x);
    case SHAPE_ELLIPSOID: return shape_level_ellipsoid(shape, x);
    case SHAPE_RING: return shape_level_ring(shape, x);
    case SHAPE_POLYGON: return shape_level_polygon(shape, x);
    case SHAPE_SURFACE: return surface_level(shape->surface, x);
    case SHAPE_RASTER: return raster_level(shape->raster, x);
    case SHAPE_TURNED: return shape_level_turned(shape, x);
    case SHAPE_COMPLEMENT: return -shape_level(shape->parts[0], x);
    case SHAPE_UNION: return shape_level_parts(shape, x, -1.0);
    case SHAPE_INTERSECTION: return shape_level_parts(shape, x, 1.0);
    case SHAPE_EVERYWHERE: break;
    }
    return -INFINITY;
}

int shape_contains(const struct shape *shape, const double x[3])
{
    return !shape || shape_level(shape, x) <= 0.0;
}

/* Fractions */

static void shape_middle(const struct shape_cell *cell, double ret_x[3])
{
    for (int d = 0; d < 3; d++) ret_x[d] = d < cell->dim ? 0.5 * (cell->lower[d] + cell->upper[d]) : 0.0;
}

/* From the middle of a cell to its corner. */
static double shape_reach(const struct shape_cell *cell)
{
    double square = 0.0;
    for (int d = 0; d < cell->dim; d++) {
        double h = cell->upper[d] - cell->lower[d];
        square += h * h;
    }
    return 0.5 * sqrt(square);
}

/* A box too small to divide: the volume under the plane that the level's slope gives. */
static double shape_fraction_leaf(const struct shape *shape, const struct shape_cell *cell)
{
    double x[3], slope[3] = {0.0}, point[3], square = 0.0;
    shape_middle(cell, x);
    double level = shape_level(shape, x);
    for (int d = 0; d < cell->dim; d++) {
        double h = cell->upper[d] - cell->lower[d], aside[3] = {x[0], x[1], x[2]};
        aside[d] = cell->upper[d];
        slope[d] = shape_level(shape, aside) / h;
        aside[d] = cell->lower[d];
        slope[d] -= shape_level(shape, aside) / h;
        square += slope[d] * slope[d];
    }
    if (!(square > 0.0)) return level <= 0.0 ? 1.0 : 0.0;
    for (int d = 0; d < 3; d++) {
        point[d] = x[d] - level * slope[d] / square;
        slope[d] /= -sqrt(square);
    }
    return shape_volume_plane(cell, point, slope);
}

static double shape_fraction_cell(const struct shape *shape, const struct shape_cell *cell, int depth);
static double shape_fraction_cut(const struct shape *shape, const struct shape_cell *cell, int depth);

/* Sum over the 2^dim halves of a cell. */
static double shape_fraction_divided(const struct shape *shape, const struct shape_cell *cell, int depth)
{
    static const int deepest[4] = {0, 30, 7, 4};
    if (depth >= deepest[cell->dim]) return shape_fraction_leaf(shape, cell);
    double sum = 0.0, whole = shape_volume_along(cell->lower[0], cell->upper[0], cell->beta), x[3];
    shape_middle(cell, x);
    for (int k = 0; k < 1 << cell->dim; k++) {
        struct shape_cell part = *cell;
        for (int d = 0; d < cell->dim; d++) *(k >> d & 1 ? part.lower + d : part.upper + d) = x[d];
        double share = shape_volume_along(part.lower[0], part.upper[0], cell->beta) / whole;
        sum += share * shape_fraction_cell(shape, &part, depth + 1);
    }
    return sum / (1 << (cell->dim - 1));
}

/* Union (inside = -1) or intersection (1): parts that do not reach into the cell drop out; with one left its own
 * volume counts. */
static double shape_fraction_parts(const struct shape *shape, const struct shape_cell *cell, int depth, double sign)
{
    const struct shape *cutting = NULL;
    double x[3], reach = shape_reach(cell);
    shape_middle(cell, x);
    for (unsigned i = 0; i < shape->n; i++) {
        if (sign * shape_level(shape->parts[i], x) < -reach) continue;
        if (cutting) return shape_fraction_divided(shape, cell, depth);
        cutting = shape->parts[i];
    }
    if (!cutting) return sign > 0.0 ? 1.0 : 0.0;
    return shape_fraction_cell(cutting, cell, depth);
}

static double shape_fraction_ball(const struct shape *shape, const struct shape_cell *cell, double radius)
{
    const double axes[3] = {radius, radius, radius};
    return radius > 0.0 ? shape_volume_ball(cell, shape->a, axes) : 0.0;
}

/* In 1D and 2D a cylinder is a (turned) rectangle; in 3D along an axis the product of a disc and an interval. */
static double shape_fraction_cylinder(const struct shape *shape, const struct shape_cell *cell, int depth)
{
    double length = shape_distance(shape->a, shape->b), vertex[4][2], along[3];
    for (int d = 0; d < 3; d++) along[d] = (shape->b[d] - shape->a[d]) / length;
    if (cell->dim == 2 && along[2] == 0.0 && shape->a[2] == 0.0) {
        for (int k = 0; k < 4; k++) {
            const double *end = k == 0 || k == 3 ? shape->a : shape->b;
            double side = k < 2 ? shape->radius : -shape->radius;
            vertex[k][0] = end[0] - side * along[1];
            vertex[k][1] = end[1] + side * along[0];
        }
        return shape_volume_polygon(cell, 4, (const double(*)[2])vertex);
    }
    int axis = fabs(along[0]) == 1.0 ? 0 : fabs(along[1]) == 1.0 ? 1 : 2;
    if (cell->dim < 3 || fabs(along[axis]) != 1.0) return shape_fraction_divided(shape, cell, depth);
    struct shape_cell across = {.dim = 2};
    double from[3] = {0.0}, to[3] = {0.0}, centre[3] = {0.0}, axes[3] = {shape->radius, shape->radius, 0.0};
    for (int d = 0, k = 0; d < 3; d++) {
        if (d == axis) continue;
        across.lower[k] = cell->lower[d];
        across.upper[k] = cell->upper[d];
        centre[k++] = shape->a[d];
    }
    from[axis] = along[axis] > 0.0 ? shape->a[axis] : shape->b[axis];
    to[axis] = along[axis] > 0.0 ? shape->b[axis] : shape->a[axis];
    return shape_volume_ball(&across, centre, axes) * shape_volume_box(cell, from, to);
}

/* Where a turned shape puts a point of what it turns, which may be turned itself. */
static void shape_turn(const struct shape *shape, const double x[3], double ret[3])
{
    double from[3] = {x[0], x[1], x[2]};
    if (shape->parts[0]->type == SHAPE_TURNED) shape_turn(shape->parts[0], x, from);
    for (int d = 0; d < 3; d++) {
        ret[d] = shape->a[d];
        for (int k = 0; k < 3; k++) ret[d] += shape->turn[d][k] * (from[k] - shape->a[k]);
    }
}

/* A turned polygon of n vertices in the plane. */
static double shape_fraction_turned_polygon(const struct shape *shape, const struct shape_cell *cell, unsigned n,
                                            const double (*vertex)[2])
{
    double turned[SHAPE_VERTICES][2];
    for (unsigned i = 0; i < n; i++) {
        double x[3] = {vertex[i][0], vertex[i][1], 0.0}, to[3];
        shape_turn(shape, x, to);
        turned[i][0] = to[0];
        turned[i][1] = to[1];
    }
    return shape_volume_polygon(cell, n, (const double(*)[2])turned);
}

/* What is as simple turned as it was: balls, rings and half-spaces, boxes and polygons in the plane. The rest is
 * divided. */
static double shape_fraction_turned(const struct shape *shape, const struct shape_cell *cell, int depth)
{
    const struct shape *of = shape->parts[0];
    while (of->type == SHAPE_TURNED) of = of->parts[0];
    struct shape turned = *of;
    const double *a = of->a, *b = of->b, end[3] = {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
    const double corner[4][2] = {{a[0], a[1]}, {b[0], a[1]}, {b[0], b[1]}, {a[0], b[1]}};
    shape_turn(shape, a, turned.a);
    if (of->type == SHAPE_SPHERE || of->type == SHAPE_RING) return shape_fraction_cut(&turned, cell, depth);
    if (of->type == SHAPE_HALF_SPACE) {
        shape_turn(shape, end, turned.b);
        for (int d = 0; d < 3; d++) turned.b[d] -= turned.a[d];
        return shape_fraction_cut(&turned, cell, depth);
    }
    if (cell->dim == 2 && of->type == SHAPE_BOX) return shape_fraction_turned_polygon(shape, cell, 4, corner);
    if (cell->dim == 2 && of->type == SHAPE_POLYGON && of->n <= SHAPE_VERTICES)
        return shape_fraction_turned_polygon(shape, cell, of->n, (const double(*)[2])of->vertex);
    return shape_fraction_divided(shape, cell, depth);
}

/* The exact or divided fraction of a cell that may be cut. */
static double shape_fraction_cut(const struct shape *shape, const struct shape_cell *cell, int depth)
{
    switch (shape->type) {
    case SHAPE_BOX: return shape_volume_box(cell, shape->a, shape->b);
    case SHAPE_HALF_SPACE: return shape_volume_plane(cell, shape->a, shape->b);
    case SHAPE_SPHERE: return shape_fraction_ball(shape, cell, shape->radius);
    case SHAPE_RING:
        return shape_fraction_ball(shape, cell, shape->radius) - shape_fraction_ball(shape, cell, shape->inner);
    case SHAPE_ELLIPSOID: return shape_volume_ball(cell, shape->a, shape->b);
    case SHAPE_CYLINDER: return shape_fraction_cylinder(shape, cell, depth);
    case SHAPE_POLYGON:
        if (cell->dim == 1) return shape_fraction_divided(shape, cell, depth);
        return shape_volume_polygon(cell, shape->n, (const double(*)[2])shape->vertex);
    case SHAPE_SURFACE: return surface_fraction(shape->surface, cell);
    case SHAPE_RASTER: return shape_fraction_divided(shape, cell, depth);
    case SHAPE_TURNED: return shape_fraction_turned(shape, cell, depth);
    case SHAPE_COMPLEMENT: return 1.0 - shape_fraction_cell(shape->parts[0], cell, depth);
    case SHAPE_UNION: return shape_fraction_parts(shape, cell, depth, -1.0);
    case SHAPE_INTERSECTION: return shape_fraction_parts(shape, cell, depth, 1.0);
    case SHAPE_EVERYWHERE: break;
    }
    return 1.0;
}

static double shape_fraction_cell(const struct shape *shape, const struct shape_cell *cell, int depth)
{
    double x[3], reach = shape_reach(cell);
    shape_middle(cell, x);
    double level = shape_level(shape, x);
    if (level >= reach) return 0.0;
    if (level <= -reach) return 1.0;
    return shape_fraction_cut(shape, cell, depth);
}

double shape_fraction(const struct shape *shape, const double lower[3], const double upper[3], int dim, int beta)
{
    if (!shape) return 1.0;
    struct shape_cell cell = {{lower[0], lower[1], lower[2]}, {upper[0], upper[1], upper[2]}, dim, beta};
    double fraction = shape_fraction_cell(shape, &cell, 0);
    if (!(fraction > SHAPE_PURE)) return 0.0;
    return fraction < 1.0 - SHAPE_PURE ? fraction : 1.0;
}

/* Reach */

/* The box around a primitive with corners or edges. */
static void shape_bounds(const struct shape *shape, int axis, double *ret_low, double *ret_high)
{
    *ret_low = shape->a[axis];
    *ret_high = shape->b[axis];
    if (shape->type == SHAPE_CYLINDER) {
        *ret_low = fmin(shape->a[axis], shape->b[axis]) - shape->radius;
        *ret_high = fmax(shape->a[axis], shape->b[axis]) + shape->radius;
    } else if (shape->type == SHAPE_POLYGON) {
        *ret_low = axis < 2 ? INFINITY : -INFINITY;
        *ret_high = -*ret_low;
        for (unsigned i = 0; axis < 2 && i < shape->n; i++) {
            *ret_low = fmin(*ret_low, shape->vertex[i][axis]);
            *ret_high = fmax(*ret_high, shape->vertex[i][axis]);
        }
    }
}

static int shape_reaches_bounds(const struct shape *shape, const double lower[3], const double upper[3], int dim)
{
    for (int d = 0; d < dim; d++) {
        double low, high;
        shape_bounds(shape, d, &low, &high);
        if (low > upper[d] || high < lower[d]) return 0;
    }
    return 1;
}

/* Round shapes: the point of the box that is nearest to the centre decides. */
static int shape_reaches_round(const struct shape *shape, const double lower[3], const double upper[3], int dim)
{
    double x[3] = {shape->a[0], shape->a[1], shape->a[2]};
    for (int d = 0; d < dim; d++) x[d] = x[d] < lower[d] ? lower[d] : x[d] > upper[d] ? upper[d] : x[d];
    return shape->type == SHAPE_ELLIPSOID ? shape_level_ellipsoid(shape, x) <= 0.0
                                          : shape_distance(x, shape->a) <= shape->radius;
}

/* Is any corner of the box inside a half-space? */
static int shape_reaches_plane(const struct shape *shape, const double lower[3], const double upper[3], int dim)
{
    double x[3] = {0.0};
    for (int d = 0; d < dim; d++) x[d] = shape->b[d] > 0.0 ? upper[d] : lower[d];
    return shape_level(shape, x) <= 0.0;
}

static int shape_reaches_parts(const struct shape *shape, const double lower[3], const double upper[3], int dim)
{
    unsigned reached = 0;
    for (unsigned i = 0; i < shape->n; i++) reached += shape_reaches(shape->parts[i], lower, upper, dim) != 0;
    return shape->type == SHAPE_UNION ? reached > 0 : reached == shape->n;
}

/* As far as one level can tell. */
static int shape_reaches_level(const struct shape *shape, const double lower[3], const double upper[3], int dim)
{
    const struct shape_cell box = {{lower[0], lower[1], lower[2]}, {upper[0], upper[1], upper[2]}, dim, 0};
    double x[3];
    shape_middle(&box, x);
    return shape_level(shape, x) <= shape_reach(&box);
}

int shape_reaches(const struct shape *shape, const double lower[3], const double upper[3], int dim)
{
    if (!shape) return 1;
    switch (shape->type) {
    case SHAPE_EVERYWHERE: return 1;
    case SHAPE_COMPLEMENT: return shape_fraction(shape->parts[0], lower, upper, dim, 0) < 1.0;
    case SHAPE_UNION:
    case SHAPE_INTERSECTION: return shape_reaches_parts(shape, lower, upper, dim);
    case SHAPE_HALF_SPACE: return shape_reaches_plane(shape, lower, upper, dim);
    case SHAPE_SPHERE:
    case SHAPE_RING:
    case SHAPE_ELLIPSOID: return shape_reaches_round(shape, lower, upper, dim);
    case SHAPE_SURFACE:
    case SHAPE_RASTER:
    case SHAPE_TURNED: return shape_reaches_level(shape, lower, upper, dim);
    case SHAPE_BOX:
    case SHAPE_CYLINDER:
    case SHAPE_POLYGON: break;
    }
    return shape_reaches_bounds(shape, lower, upper, dim);
}

void shape_free(struct shape *shape)
{
    if (!shape) return;
    if (shape->parts)
        for (unsigned i = 0; i < shape->n; i++) shape_free(shape->parts[i]);
    if (shape->surface) surface_done(shape->surface);
    if (shape->raster) raster_done(shape->raster);
    mem_free(shape->surface);
    mem_free(shape->raster);
    mem_free(shape->parts);
    mem_free(shape->vertex);
    mem_free(shape);
}
