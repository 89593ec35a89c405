/* curvature_carry.c - kappa of the layers of a smeared front made that of the sharp surface of the same volume
 * (curvature.h). */
#include "scheme/curvature.h"

#include "mesh/metric.h"
#include "scheme/curvature_room.h"

#include <math.h>
#include <string.h>

/* 4 psi (1 - psi) where a layer is carried the whole way, and where not at all: fractions of 7e-4 and of 1e-5. What is
 * thinner is a trace, whose psi says nothing of how far the surface is. */
#define CARRY_ALL 0.8
#define CARRY_NONE 0.6

/* psi along a row and beside it, of the cells whose kappa is carried. */
struct curvature_carry_beside {
    const double *low_x, *here, *high_x, *low_y, *high_y, *low_z, *high_z;
};

/* From a layer of a smeared front to the sharp surface that holds the same volume [m]: ret. psi = (1 + tanh(m x/w))/2
 * gives the distance x of the layer from the middle, and the width; across a surface of curvature kappa half the
 * variance of the front, pi^2 w^2/24, times kappa lies between its middle and the mean of its volume. */
static BULLA_KERNEL void curvature_carry_way(size_t n, const struct curvature_carry_beside *psi, const double per[3],
                                             double h, const double *restrict kappa, double *restrict ret)
{
    const double variance = M_PI * M_PI * CURVATURE_POWER * CURVATURE_POWER / 96.0;
    const double *restrict a = psi->low_x, *restrict p = psi->here, *restrict z = psi->high_x, *restrict b = psi->low_y,
                           *restrict c = psi->high_y, *restrict d = psi->low_z, *restrict e = psi->high_z;
    double half_y = 0.5 * per[1], half_z = 0.5 * per[2];
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double gx = 0.5 * (z[i] - a[i]), gy = half_y * (c[i] - b[i]), gz = half_z * (e[i] - d[i]), here = p[i];
        double length2 = (gx * gx + gy * gy) + gz * gz, straight = 4.0 * here * (1.0 - here), k = kappa[i] * h;
        double slope = sqrt(length2) / (straight > 0.25 ? straight : 0.25);
        double steep = length2 > CURVATURE_FLAT * CURVATURE_FLAT ? slope : 1.0; /* else there is no front */
        double way = (here - 0.5) / steep + k * variance / (steep * steep);
        double part = (straight - CARRY_NONE) / (CARRY_ALL - CARRY_NONE);
        part = part < 1.0 ? part : 1.0;
        part = part > 0.0 ? part : 0.0;
        part = length2 > CURVATURE_FLAT * CURVATURE_FLAT ? part : 0.0;
        ret[i] = way * h * part;
    }
}

/* Around an axis: the product of both curvatures, kappa_2 = -n_r/r and what is left of kappa. */
static BULLA_KERNEL void curvature_carry_axis(size_t n, const double *restrict below, const double *restrict above,
                                              const double *restrict r, const double *restrict kappa,
                                              double *restrict ret)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double normal = 0.25 * ((below[i] + above[i + 1]) + (below[i + 1] + above[i])), second = -normal / r[i];
        ret[i] = second * (kappa[i] - second);
    }
}

/* In space: the sum of the 2 x 2 minors of grad n; n grows by x[3], y[3], z[3] along the axes, in units of h. */
static BULLA_KERNEL void curvature_carry_space(size_t n, double h, double *const x[3], double *const y[3],
                                               double *const z[3], double *restrict ret)
{
    const double *restrict xx = x[0], *restrict xy = x[1], *restrict xz = x[2], *restrict yx = y[0],
                           *restrict yy = y[1], *restrict yz = y[2], *restrict zx = z[0], *restrict zy = z[1],
                           *restrict zz = z[2];
    double per = 1.0 / (h * h);
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double one = xx[i] * yy[i] - xy[i] * yx[i], two = xx[i] * zz[i] - xz[i] * zx[i],
               three = yy[i] * zz[i] - yz[i] * zy[i];
        ret[i] = (one + two + three) * per;
    }
}

/* kappa and the product of both principal curvatures, some way along the normal: each becomes k/(1 + way k). Not by
 * more than half of the smaller radius. */
static BULLA_KERNEL void curvature_carry_row(size_t n, const double *restrict way, const double *restrict product,
                                             double *restrict kappa)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double k = kappa[i], both = product[i], w = way[i], squares = k * k - 2.0 * both, far = w * w * squares;
        double part = 0.5 / sqrt(far > 0.25 ? far : 0.25), s = w * part;
        kappa[i] = (k + 2.0 * s * both) / (1.0 + s * k + s * s * both);
    }
}

/* The product of both principal curvatures of a row of kappa, from the normals at the corners; `rows` has room for
 * 10. */
static const double *curvature_carry_product(struct curvature *room, const struct level *level, size_t j, size_t k,
                                             const struct metric *metric, const double *kappa, double *rows)
{
    const struct mesh *mesh = room->mesh;
    const struct curvature_grid corners = curvature_grid(mesh, 2 * room->g - 3);
    size_t n = curvature_grid(mesh, 2 * room->g - 4).n[0];
    double *ret = rows + 9 * n, per[3], *rise[3][3];
    curvature_room_per(mesh, level, per);
    memset(ret, 0, n * sizeof *ret);
    if (mesh->dim == 2 && mesh->beta == 1) {
        const struct curvature_around around = curvature_room_around(&corners, room->normal[0], j, k);
        curvature_carry_axis(n, around.here, around.y, metric->centre, kappa, ret);
    }
    if (mesh->dim < 3) return ret;
    for (size_t d = 0; d < 3; d++) {
        const struct curvature_around around = curvature_room_around(&corners, room->normal[d], j, k);
        for (size_t e = 0; e < 3; e++) rise[d][e] = rows + (3 * d + e) * n;
        curvature_room_rise(n, &around, per, rise[d][0], rise[d][1], rise[d][2]);
    }
    curvature_carry_space(n, level->h[0], rise[0], rise[1], rise[2], ret);
    return ret;
}

void curvature_carry(struct curvature *room, const struct level *level, const struct tile *tile)
{
    const struct mesh *mesh = room->mesh;
    int more = 2 * room->g - 4;
    const struct curvature_grid of = curvature_grid(mesh, more + 2), to = curvature_grid(mesh, more);
    double per[3], *way = room->spare + 10 * to.n[0];
    struct metric metric;
    curvature_room_per(mesh, level, per);
    metric_of_cells(mesh, level, tile->at[0] * mesh->n[0] - more / 2, mesh->n[0] + more, &metric);
    for (size_t k = 0; k < to.n[2]; k++)
        for (size_t j = 0; j < to.n[1]; j++) {
            double *kappa = room->kappa + j * to.stride[1] + k * to.stride[2];
            const double *row = room->psi + (j + 1) * of.stride[1] + (k + 1) * of.stride[2],
                         *middle = row + of.stride[0];
            const struct curvature_carry_beside psi = {row,
                                                       middle,
                                                       middle + of.stride[0],
                                                       middle - of.stride[1],
                                                       middle + of.stride[1],
                                                       middle - of.stride[2],
                                                       middle + of.stride[2]};
            curvature_carry_way(to.n[0], &psi, per, level->h[0], kappa, way);
            curvature_carry_row(to.n[0], way, curvature_carry_product(room, level, j, k, &metric, kappa, room->spare),
                                kappa);
        }
}
