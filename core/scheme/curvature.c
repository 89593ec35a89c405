/* curvature.c - see curvature.h. Blocks of numbers in corners and cells by turns, each with one place less along every
 * axis than the one before. A corner lies between 2^dim cells; along axes that are not used both cells of a pair are
 * the same one, which leaves means as they are. Sums of four begin with opposite ones, so that mirrors and the exchange
 * of x and y keep all bits. */
#include "scheme/curvature.h"

#include "base/mem.h"
#include "mesh/metric.h"
#include "scheme/curvature_room.h"
#include "scheme/heights.h"

#include <math.h>
#include <string.h>

/* Least part along a wall of the unit normal at it: a surface that lies flatter does not meet the wall here. */
#define CURVATURE_LYING 0.1

/* Product of fractions below which columns count less. */
#define CURVATURE_TRACE 1e-2

/* Weight of a cell whose columns say nothing, in means with others, beside one that has them. Less would let few cells
 * of a front speak for those around them, beside whose foot they stand. */
#define CURVATURE_DOUBT 1.0

/* Where a block counts as empty: no quotient is taken. */
#define CURVATURE_NONE 1e-300

struct curvature *curvature_new(const struct mesh *mesh, int g)
{
    enum { BLOCKS = 9, ROWS = 11 };
    struct curvature *room = mem_new(1, sizeof *room);
    size_t row = (size_t)(mesh->n[0] + 2 * g), all = curvature_room_cells(mesh, 2 * g), rows = ROWS * row;
    size_t cells = all > rows ? all : rows; /* spare has rows, too */
    room->mesh = mesh;
    room->g = g;
    room->rows = mem_new(BLOCKS * cells, sizeof *room->rows);
    room->psi = room->rows;
    room->other = room->psi + cells;
    room->kappa = room->other + cells;
    room->kept = room->kappa + cells;
    room->trust = room->kept + cells;
    room->spare = room->trust + cells;
    for (size_t d = 0; d < 3; d++) room->normal[d] = room->spare + (d + 1) * cells;
    return room;
}

void curvature_free(struct curvature *room)
{
    if (!room) return;
    mem_free(room->rows);
    mem_free(room);
}

bool curvature_is_mixed(size_t n, const double *a, double least)
{
    double low = a[0], high = a[0];
    for (size_t i = 1; i < n; i++) {
        low = a[i] < low ? a[i] : low;
        high = a[i] > high ? a[i] : high;
    }
    return high >= least && low <= 1.0 - least;
}

/* Means of four values each of the rows a and b. */
static BULLA_KERNEL void curvature_mean_row(size_t n, const double *restrict a, const double *restrict b,
                                            double *restrict ret)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) ret[i] = 0.25 * ((a[i] + b[i + 1]) + (a[i + 1] + b[i]));
}

/* In space: with those of the layer above, whose rows are c and d. */
static BULLA_KERNEL void curvature_mean_layer(size_t n, const double *restrict c, const double *restrict d,
                                              double *restrict ret)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double low = ret[i], high = 0.25 * ((c[i] + d[i + 1]) + (c[i + 1] + d[i]));
        ret[i] = 0.5 * (low + high);
    }
}

void curvature_room_between(const struct mesh *mesh, int more, const double *from, double *ret)
{
    const struct curvature_grid of = curvature_grid(mesh, more), to = curvature_grid(mesh, more - 1);
    for (size_t k = 0; k < to.n[2]; k++)
        for (size_t j = 0; j < to.n[1]; j++) {
            const struct curvature_around around = curvature_room_around(&of, from, j, k);
            double *row = ret + j * to.stride[1] + k * to.stride[2];
            curvature_mean_row(to.n[0], around.here, around.y, row);
            if (mesh->dim == 3) curvature_mean_layer(to.n[0], around.z, around.yz, row);
        }
}

static BULLA_KERNEL void curvature_straighten(size_t n, const double *restrict b, double *restrict psi)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double x = psi[i], y = b[i], some = x > 0.0 ? x : 0.0, rest = y > 0.0 ? y : 0.0;
        some = sqrt(sqrt(sqrt(some)));
        rest = sqrt(sqrt(sqrt(rest)));
        double sum = some + rest;
        psi[i] = sum > 0.0 ? some / sum : 0.0;
    }
}

static BULLA_KERNEL void curvature_rise_row(size_t n, const struct curvature_around *around, const double per[3],
                                            double *restrict x, double *restrict y, double *restrict z)
{
    const double *restrict a = around->here, *restrict b = around->y, *restrict c = around->z, *restrict d = around->yz;
    double per_y = per[1], per_z = per[2];
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a0 = a[i], a1 = a[i + 1], b0 = b[i], b1 = b[i + 1], c0 = c[i], c1 = c[i + 1], d0 = d[i], d1 = d[i + 1];
        x[i] = 0.25 * (((a1 + d1) + (b1 + c1)) - ((a0 + d0) + (b0 + c0)));
        y[i] = 0.25 * (((b0 + d1) + (b1 + d0)) - ((a0 + c1) + (a1 + c0))) * per_y;
        z[i] = 0.25 * (((c0 + d1) + (c1 + d0)) - ((a0 + b1) + (a1 + b0))) * per_z;
    }
}

void curvature_room_rise(size_t n, const struct curvature_around *around, const double per[3], double *restrict x,
                         double *restrict y, double *restrict z)
{
    curvature_rise_row(n, around, per, x, y, z);
}

/* Vectors made as long as 1; 0 where they say nothing. */
static BULLA_KERNEL void curvature_unit_row(size_t n, double *restrict x, double *restrict y, double *restrict z)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double gx = x[i], gy = y[i], gz = z[i], length2 = (gx * gx + gy * gy) + gz * gz;
        double length = length2 > CURVATURE_FLAT * CURVATURE_FLAT ? sqrt(length2) : (double)INFINITY;
        x[i] = gx / length; /* exactly 1 in one dimension */
        y[i] = gy / length;
        z[i] = gz / length;
    }
}

void curvature_room_per(const struct mesh *mesh, const struct level *level, double ret_per[3])
{
    for (int d = 0; d < 3; d++) ret_per[d] = d < mesh->dim ? level->h[0] / level->h[d] : 0.0;
}

/* At the corners of the block of psi. */
static void curvature_normals(struct curvature *room, const struct level *level, int more)
{
    const struct mesh *mesh = room->mesh;
    const struct curvature_grid of = curvature_grid(mesh, more), to = curvature_grid(mesh, more - 1);
    double per[3];
    curvature_room_per(mesh, level, per);
    for (size_t k = 0; k < to.n[2]; k++)
        for (size_t j = 0; j < to.n[1]; j++) {
            const struct curvature_around around = curvature_room_around(&of, room->psi, j, k);
            size_t at = j * to.stride[1] + k * to.stride[2];
            double *x = room->normal[0] + at, *y = room->normal[1] + at, *z = room->normal[2] + at;
            curvature_room_rise(to.n[0], &around, per, x, y, z);
            curvature_unit_row(to.n[0], x, y, z);
        }
}

/* Means of what lies around faces across axis 0. */
static BULLA_KERNEL void curvature_face_row(size_t n, const struct curvature_around *around, double *restrict ret)
{
    const double *restrict a = around->here, *restrict b = around->y, *restrict c = around->z, *restrict d = around->yz;
#pragma omp simd
    for (size_t i = 0; i < n; i++) ret[i] = 0.25 * ((a[i] + d[i]) + (b[i] + c[i]));
}

/* What the normals of axis 0 give to div n, with the areas of the geometry. */
static BULLA_KERNEL void curvature_row_x(size_t n, const double *restrict face, const struct metric *metric,
                                         double *restrict ret)
{
    const double *restrict area = metric->area, *restrict volume = metric->volume;
#pragma omp simd
    for (size_t i = 0; i < n; i++) ret[i] = (area[i + 1] * face[i + 1] - area[i] * face[i]) / volume[i];
}

/* The same of another axis: a, b have the corners of the lower faces, up_a and up_b those of the upper ones. */
static BULLA_KERNEL void curvature_row(size_t n, const double *restrict a, const double *restrict b,
                                       const double *restrict up_a, const double *restrict up_b, double h,
                                       double *restrict ret)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double low = 0.25 * ((a[i] + b[i + 1]) + (a[i + 1] + b[i]));
        double high = 0.25 * ((up_a[i] + up_b[i + 1]) + (up_a[i + 1] + up_b[i]));
        double old = ret[i];
        ret[i] = old + (high - low) / h;
    }
}

static BULLA_KERNEL void curvature_turn(size_t n, double *kappa)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) kappa[i] = 0.0 - kappa[i]; /* no -0 */
}

/* kappa of the cells between the corners. */
static void curvature_divide(struct curvature *room, const struct level *level, const struct tile *tile, int more)
{
    const struct mesh *mesh = room->mesh;
    const struct curvature_grid of = curvature_grid(mesh, more), to = curvature_grid(mesh, more - 1);
    struct metric metric;
    metric_of_cells(mesh, level, tile->at[0] * mesh->n[0] - (more - 1) / 2, mesh->n[0] + more - 1, &metric);
    for (size_t k = 0; k < to.n[2]; k++)
        for (size_t j = 0; j < to.n[1]; j++) {
            double *ret = room->kappa + j * to.stride[1] + k * to.stride[2];
            struct curvature_around around = curvature_room_around(&of, room->normal[0], j, k);
            curvature_face_row(of.n[0], &around, room->spare);
            curvature_row_x(to.n[0], room->spare, &metric, ret);
            around = curvature_room_around(&of, room->normal[1], j, k);
            if (mesh->dim > 1) curvature_row(to.n[0], around.here, around.z, around.y, around.yz, level->h[1], ret);
            around = curvature_room_around(&of, room->normal[2], j, k);
            if (mesh->dim > 2) curvature_row(to.n[0], around.here, around.y, around.z, around.yz, level->h[2], ret);
            curvature_turn(to.n[0], ret);
        }
}

/* A plane of a block across an axis, at `at`: its first place and the steps along its two other axes. */
struct curvature_plane {
    size_t from, n[2], stride[2];
};

static struct curvature_plane curvature_plane(const struct curvature_grid *grid, int axis, size_t at)
{
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    return (
        struct curvature_plane){at * grid->stride[axis], {grid->n[u], grid->n[v]}, {grid->stride[u], grid->stride[v]}};
}

/* Layer `ghost` behind the wall at a face, or -1 - ghost before it, in a block of cells with `layers` around the
 * tile. */
static size_t curvature_layer(const struct mesh *mesh, size_t layers, int face, int ghost)
{
    int n = mesh->n[face / 2], behind = face % 2 ? n + ghost : -1 - ghost;
    return (size_t)((int)layers + behind);
}

/* Fractions that go on straight behind walls with an angle, by one layer, so that the means of the cells at the wall
 * are not bent; into `ret`, unless there are no such walls. */
static const double *curvature_straight(const struct curvature *room, const double *cosine, const double *a,
                                        double *ret)
{
    const struct mesh *mesh = room->mesh;
    size_t g = (size_t)room->g;
    if (!cosine) return a;
    memcpy(ret, a, curvature_room_cells(mesh, 2 * room->g) * sizeof *ret);
    const struct curvature_grid grid = curvature_grid(mesh, 2 * room->g);
    for (int face = 0; face < 2 * mesh->dim; face++) {
        struct curvature_plane to = curvature_plane(&grid, face / 2, curvature_layer(mesh, g, face, 0)),
                               one = curvature_plane(&grid, face / 2, curvature_layer(mesh, g, face, -1)),
                               two = curvature_plane(&grid, face / 2, curvature_layer(mesh, g, face, -2));
        for (size_t v = 0; cosine[face] != 0.0 && v < to.n[1]; v++)
            for (size_t u = 0; u < to.n[0]; u++) {
                size_t at = u * to.stride[0] + v * to.stride[1];
                ret[to.from + at] = 2.0 * ret[one.from + at] - ret[two.from + at];
            }
    }
    return ret;
}

/* Turns one unit vector to the angle of a wall across `axis`, keeping its direction along the wall. `across`: what it
 * shall have along the axis. What lies flat on the wall, or has no direction, stays. */
static void curvature_turn_to(struct curvature *room, int axis, double across, size_t at)
{
    double *u = room->normal[(axis + 1) % 3] + at, *v = room->normal[(axis + 2) % 3] + at;
    double along = sqrt(*u * *u + *v * *v), factor = sqrt(1.0 - across * across) / along;
    if (!(along > CURVATURE_LYING)) return;
    room->normal[axis][at] = across;
    *u *= factor;
    *v *= factor;
}

/* Is a corner, `u` and `v` along the axes after that of `face`, on another wall with an angle, too? */
static bool curvature_in_edge(const struct curvature *room, const double *cosine, int face, size_t u, size_t v)
{
    size_t at[2] = {u, v}, wall = (size_t)room->g - 2;
    for (int d = 0; d < 2; d++) {
        int axis = (face / 2 + 1 + d) % 3;
        if (axis >= room->mesh->dim) continue;
        if (cosine[2 * axis] != 0.0 && at[d] == wall) return true;
        if (cosine[2 * axis + 1] != 0.0 && at[d] == wall + (size_t)room->mesh->n[axis]) return true;
    }
    return false;
}

/* Normals at the corners on walls with an angle. In edges between two of them they stay. */
static void curvature_lean(struct curvature *room, const double *cosine)
{
    const struct mesh *mesh = room->mesh;
    const struct curvature_grid grid = curvature_grid(mesh, 2 * room->g - 3);
    for (int face = 0; face < 2 * mesh->dim; face++) {
        int axis = face / 2, n = mesh->n[axis];
        size_t wall = (size_t)(room->g - 2 + (face % 2 ? n : 0));
        struct curvature_plane plane = curvature_plane(&grid, axis, wall);
        double across = face % 2 ? cosine[face] : -cosine[face];
        for (size_t v = 0; cosine[face] != 0.0 && v < plane.n[1]; v++)
            for (size_t u = 0; u < plane.n[0]; u++)
                if (!curvature_in_edge(room, cosine, face, u, v))
                    curvature_turn_to(room, axis, across, plane.from + u * plane.stride[0] + v * plane.stride[1]);
    }
}

/* Behind walls with an angle, by one layer, what lies before them, in a block with `layers` around the tile. */
static void curvature_behind(const struct mesh *mesh, const double *cosine, size_t layers, double *block)
{
    const struct curvature_grid grid = curvature_grid(mesh, 2 * (int)layers);
    for (int face = 0; layers && cosine && face < 2 * mesh->dim; face++) {
        struct curvature_plane to = curvature_plane(&grid, face / 2, curvature_layer(mesh, layers, face, 0)),
                               from = curvature_plane(&grid, face / 2, curvature_layer(mesh, layers, face, -1));
        for (size_t v = 0; cosine[face] != 0.0 && v < to.n[1]; v++)
            for (size_t u = 0; u < to.n[0]; u++) {
                size_t at = u * to.stride[0] + v * to.stride[1];
                block[to.from + at] = block[from.from + at];
            }
    }
}

const double *curvature_take(struct curvature *room, const struct level *level, const struct tile *tile,
                             const double *a, const double *b, const double *cosine)
{
    const struct mesh *mesh = room->mesh;
    int more = 2 * room->g;
    curvature_room_between(mesh, more, curvature_straight(room, cosine, a, room->normal[0]), room->spare);
    curvature_room_between(mesh, more - 1, room->spare, room->psi);
    curvature_room_between(mesh, more, curvature_straight(room, cosine, b, room->normal[0]), room->spare);
    curvature_room_between(mesh, more - 1, room->spare, room->other);
    curvature_straighten(curvature_room_cells(mesh, more - 2), room->other, room->psi);
    curvature_normals(room, level, more - 2);
    if (cosine) curvature_lean(room, cosine);
    curvature_divide(room, level, tile, more - 3);
    curvature_behind(mesh, cosine, (size_t)room->g - 2, room->kappa);
    memset(room->trust, 0, curvature_room_cells(mesh, 2 * HEIGHTS_AROUND) * sizeof *room->trust);
    return room->kappa;
}

/* Where columns cross such a face, or stand beside it. */
static void curvature_doubt(struct curvature *room, const bool *poor)
{
    const struct mesh *mesh = room->mesh;
    const struct curvature_grid grid = curvature_grid(mesh, 2 * HEIGHTS_AROUND);
    for (int face = 0; face < 2 * mesh->dim; face++)
        for (int layer = -HEIGHTS_AROUND; poor[face] && layer < 3 && layer < mesh->n[face / 2]; layer++) {
            size_t at = curvature_layer(mesh, HEIGHTS_AROUND, face, -1 - layer);
            const struct curvature_plane plane = curvature_plane(&grid, face / 2, at);
            for (size_t v = 0; v < plane.n[1]; v++)
                for (size_t u = 0; u < plane.n[0]; u++)
                    room->trust[plane.from + u * plane.stride[0] + v * plane.stride[1]] = 0.0;
        }
}

/* Traces beside a surface are no part of it. */
static BULLA_KERNEL void curvature_trace_row(size_t n, const double *restrict a, double *restrict trust)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double part = a[i] * (1.0 - a[i]) / CURVATURE_TRACE, t = trust[i];
        part = part < 1.0 ? part : 1.0;
        trust[i] = part > 0.0 ? t * part : 0.0;
    }
}

static BULLA_KERNEL void curvature_merge_row(size_t n, const double *restrict heights, const double *restrict trust,
                                             double *restrict kappa)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double k = kappa[i], h = heights[i];
        kappa[i] = trust[i] > 0.0 ? k + trust[i] * (h - k) : k;
    }
}

void curvature_heights(struct curvature *room, const struct level *level, const struct tile *tile, const double *a,
                       const double *cosine, const bool poor[MESH_FACES])
{
    const struct mesh *mesh = room->mesh;
    const struct curvature_grid wide = curvature_grid(mesh, 2 * room->g - 4),
                                to = curvature_grid(mesh, 2 * HEIGHTS_AROUND),
                                patch = curvature_grid(mesh, 2 * room->g);
    double *normal[3] = {room->spare, room->normal[0], room->normal[1]}, *heights = room->normal[2];
    for (int d = 0; d < mesh->dim; d++) curvature_room_between(mesh, 2 * room->g - 3, room->normal[d], normal[d]);
    heights_take(mesh, level, tile, a, normal, cosine, heights, room->trust);
    curvature_doubt(room, poor);
    for (size_t k = 0; k < to.n[2]; k++)
        for (size_t j = 0; j < to.n[1]; j++) {
            size_t at = j * to.stride[1] + k * to.stride[2];
            curvature_trace_row(to.n[0], a + curvature_grid_at(&patch, (size_t)room->g - HEIGHTS_AROUND, j, k),
                                room->trust + at);
            curvature_merge_row(to.n[0], heights + at, room->trust + at,
                                room->kappa + curvature_grid_at(&wide, HEIGHTS_AROUND, j, k));
        }
    curvature_behind(mesh, cosine, (size_t)room->g - 2, room->kappa);
    curvature_behind(mesh, cosine, HEIGHTS_AROUND, room->trust);
}

void curvature_keep(struct curvature *room)
{
    memcpy(room->kept, room->kappa, curvature_room_cells(room->mesh, 2 * room->g - 4) * sizeof *room->kept);
}

void curvature_oppose(struct curvature *room, double part)
{
    size_t n = curvature_room_cells(room->mesh, 2 * room->g - 4);
    for (size_t c = 0; c < n; c++) room->kappa[c] = part * room->kept[c] - (1.0 - part) * room->kappa[c];
}

const double *curvature_psi(const struct curvature *room)
{
    return room->psi;
}

double curvature_psi_of(double a)
{
    double b = 1.0 - a;
    curvature_straighten(1, &b, &a);
    return a;
}

static BULLA_KERNEL void curvature_weigh_row(size_t n, const double *restrict a, const double *restrict b,
                                             const double *restrict trust, const double *restrict kappa,
                                             double *restrict sum, double *restrict weight)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double both = a[i] * b[i], part = both > 0.0 ? both * both : 0.0, with = part * (CURVATURE_DOUBT + trust[i]);
        weight[i] = with;
        sum[i] = with * kappa[i];
    }
}

static BULLA_KERNEL void curvature_mean_of(size_t n, double least, const double *restrict a, const double *restrict b,
                                           const double *restrict sum, const double *restrict weight,
                                           double *restrict kappa)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double w = weight[i], s = sum[i], mean = s / (w > CURVATURE_NONE ? w : 1.0);
        kappa[i] = a[i] * b[i] > least ? mean : 0.0;
    }
}

static const double *curvature_inside(const struct curvature_grid *grid, const double *of, size_t layers, size_t j,
                                      size_t k)
{
    return of + curvature_grid_at(grid, layers, j, k);
}

void curvature_mean(struct curvature *room, const double *a, const double *b, double least, double *kappa)
{
    const struct mesh *mesh = room->mesh;
    size_t g = (size_t)room->g;
    const struct curvature_grid patch = curvature_grid(mesh, 2 * room->g),
                                known = curvature_grid(mesh, 2 * room->g - 4), wide = curvature_grid(mesh, 2),
                                own = curvature_grid(mesh, 0);
    double *weight = room->other, *sums = room->psi;
    for (size_t k = 0; k < wide.n[2]; k++)
        for (size_t j = 0; j < wide.n[1]; j++) {
            size_t at = j * wide.stride[1] + k * wide.stride[2];
            curvature_weigh_row(wide.n[0], curvature_inside(&patch, a, g - 1, j, k),
                                curvature_inside(&patch, b, g - 1, j, k), room->trust + at,
                                curvature_inside(&known, room->kappa, g - 3, j, k), room->normal[0] + at, weight + at);
        }
    curvature_room_between(mesh, 2, room->normal[0], room->spare);
    curvature_room_between(mesh, 1, room->spare, sums);
    curvature_room_between(mesh, 2, weight, room->spare);
    curvature_room_between(mesh, 1, room->spare, weight);
    for (size_t k = 0; k < own.n[2]; k++)
        for (size_t j = 0; j < own.n[1]; j++) {
            size_t at = j * own.stride[1] + k * own.stride[2];
            curvature_mean_of(own.n[0], least, curvature_inside(&patch, a, g, j, k),
                              curvature_inside(&patch, b, g, j, k), sums + at, weight + at, kappa + at);
        }
}
