/* restrict.c - see restrict.h.
 *
 * A coarse cell sees 2^d fine ones as pairs of opposite corners. A mirror in any axis exchanges pairs or the two
 * ends of a pair, and so does the exchange of x and y: with the order of additions below the sum keeps its bits.
 * In curved geometry axis 0 is no mirror: the pairs across axis 1 are added first, then the two columns
 * weighted by their volumes in the form a + share (b - a), which keeps equal numbers. */
#include "levels/restrict.h"

#include "mesh/metric.h"

#include <string.h>

/* A row of n coarse cells from the four fine rows (y, z) = (0, 0), (1, 0), (0, 1), (1, 1) above it. */
static BULLA_KERNEL void restrict_row3(size_t n, const double *restrict a, const double *restrict b,
                                       const double *restrict c, const double *restrict d, double *restrict mean)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double p0 = a[2 * i] + d[2 * i + 1], p1 = a[2 * i + 1] + d[2 * i];
        double p2 = b[2 * i] + c[2 * i + 1], p3 = c[2 * i] + b[2 * i + 1];
        mean[i] = 0.125 * ((p0 + p3) + (p1 + p2));
    }
}

static BULLA_KERNEL void restrict_row2(size_t n, const double *restrict a, const double *restrict b,
                                       double *restrict mean)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) mean[i] = 0.25 * ((a[2 * i] + b[2 * i + 1]) + (a[2 * i + 1] + b[2 * i]));
}

static BULLA_KERNEL void restrict_row1(size_t n, const double *restrict a, double *restrict mean)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) mean[i] = 0.5 * (a[2 * i] + a[2 * i + 1]);
}

/* share[i]: part of the upper of two fine columns in the volume of both. */
static BULLA_KERNEL void restrict_curved2(size_t n, const double *restrict share, const double *restrict a,
                                          const double *restrict b, double *restrict mean)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double lower = 0.5 * (a[2 * i] + b[2 * i]), upper = 0.5 * (a[2 * i + 1] + b[2 * i + 1]);
        mean[i] = lower + share[i] * (upper - lower);
    }
}

static BULLA_KERNEL void restrict_curved1(size_t n, const double *restrict share, const double *restrict a,
                                          double *restrict mean)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double lower = a[2 * i], upper = a[2 * i + 1];
        mean[i] = lower + share[i] * (upper - lower);
    }
}

/* A box of fine cells to be halved along its first `dim` axes, x fastest. */
struct restrict_box {
    int dim;
    size_t n[3];         /* fine cells */
    const double *share; /* along axis 0 of curved geometry, else NULL */
};

static void restrict_row(const struct restrict_box *box, const double *fine, double *mean)
{
    size_t n = box->n[0] / 2, y = box->n[0], z = box->n[0] * box->n[1];
    if (box->share && box->dim == 2) restrict_curved2(n, box->share, fine, fine + y, mean);
    else if (box->share) restrict_curved1(n, box->share, fine, mean);
    else if (box->dim == 3) restrict_row3(n, fine, fine + y, fine + z, fine + z + y, mean);
    else if (box->dim == 2) restrict_row2(n, fine, fine + y, mean);
    else restrict_row1(n, fine, mean);
}

/* One component: `step` and `plane` are the distances of rows and planes of coarse cells in ret. */
static void restrict_box(const struct restrict_box *box, const double *fine, size_t step, size_t plane, double *ret)
{
    size_t n1 = box->dim > 1 ? box->n[1] / 2 : 1, n2 = box->dim > 2 ? box->n[2] / 2 : 1;
    for (size_t k = 0; k < n2; k++)
        for (size_t j = 0; j < n1; j++)
            restrict_row(box, fine + 2 * (k * box->n[1] + j) * box->n[0], ret + k * plane + j * step);
}

/* turns: of what counts with a lever. */
static void restrict_shares(const struct mesh *mesh, const struct level *level, const struct tile *tile, bool turns,
                            double *ret_share)
{
    struct metric metric;
    metric_of_tile(mesh, level, tile, &metric);
    const double *volume = turns ? metric.turn_volume : metric.volume;
    for (int i = 0; i < mesh->n[0] / 2; i++) ret_share[i] = volume[2 * i + 1] / (volume[2 * i] + volume[2 * i + 1]);
}

/* First cell of an octant in a tile. */
static size_t restrict_origin(const struct mesh *mesh, int octant)
{
    size_t at = 0, step = 1;
    for (int d = 0; d < mesh->dim; d++) {
        at += (size_t)(octant >> d & 1) * ((size_t)mesh->n[d] / 2) * step;
        step *= (size_t)mesh->n[d];
    }
    return at;
}

/* The octant of a coarse tile's conserved fields that a child covers. */
static double *restrict_target(const struct mesh *mesh, int l, const struct link_child *child)
{
    const struct level *coarse = &mesh->levels[l - 1];
    return coarse->u_old[child->coarse] + restrict_origin(mesh, child->octant);
}

void restrict_averages(const struct mesh *mesh, int l, int depth)
{
    const struct level *level = &mesh->levels[l];
    const struct link *link = level->link;
    double share[2][METRIC_CELLS / 2];
    struct restrict_box box = {.dim = mesh->dim};
    size_t n[3];
    for (int d = 0; d < 3; d++) {
        box.n[d] = (size_t)mesh->n[d];
        n[d] = d < mesh->dim ? box.n[d] / 2 : 1;
    }
    for (unsigned i = 0; i < link->n_child; i++) {
        const struct link_child *child = &link->children[i];
        if (child->sleeps != depth) continue;
        const double *fine = level->u_old[child->fine];
        bool away = child->average != NULL;
        double *to = away ? child->average : restrict_target(mesh, l, child);
        size_t pitch = away ? link->octant_cells : mesh->n_cell, step = away ? n[0] : box.n[0];
        size_t plane = away ? n[0] * n[1] : box.n[0] * box.n[1];
        for (int turns = 0; turns <= (mesh->turns < mesh->n_field) && mesh->beta; turns++)
            restrict_shares(mesh, level, &level->tiles[level->first + child->fine], turns, share[turns]);
        for (unsigned q = 0; q < mesh->n_field; q++) {
            box.share = mesh->beta ? share[q == mesh->turns] : NULL;
            restrict_box(&box, fine + q * mesh->n_cell, step, plane, to + q * pitch);
        }
    }
}

/* Copies a packed octant into a component of a coarse tile. */
static void restrict_place(const struct mesh *mesh, const double *average, double *to)
{
    size_t n0 = (size_t)mesh->n[0] / 2, n1 = mesh->dim > 1 ? (size_t)mesh->n[1] / 2 : 1;
    size_t n2 = mesh->dim > 2 ? (size_t)mesh->n[2] / 2 : 1;
    for (size_t k = 0; k < n2; k++)
        for (size_t j = 0; j < n1; j++)
            memcpy(to + (k * (size_t)mesh->n[1] + j) * (size_t)mesh->n[0], average + (k * n1 + j) * n0,
                   n0 * sizeof *to);
}

void restrict_take(const struct mesh *mesh, int l, int depth)
{
    const struct link *link = mesh->levels[l].link;
    for (unsigned i = 0; i < link->n_octant; i++) {
        const struct link_child *child = &link->octants[i];
        if (!child->average || child->sleeps != depth) continue;
        double *to = restrict_target(mesh, l, child);
        for (unsigned q = 0; q < mesh->n_field; q++)
            restrict_place(mesh, child->average + q * link->octant_cells, to + q * mesh->n_cell);
    }
}

void restrict_late(const struct mesh *mesh, int l, int depth)
{
    restrict_averages(mesh, l, depth);
    link_up_late(mesh->levels[l].link, depth);
    restrict_take(mesh, l, depth);
}

void restrict_face(const struct mesh *mesh, const struct level *level, const struct tile *tile, int axis, unsigned q,
                   const double *fine, double *ret_coarse)
{
    double share[METRIC_CELLS / 2];
    struct restrict_box box = {.n = {1, 1, 1}};
    for (int d = 0; d < mesh->dim; d++)
        if (d != axis) box.n[box.dim++] = (size_t)mesh->n[d];
    if (mesh->beta && axis > 0) {
        restrict_shares(mesh, level, tile, q == mesh->turns, share);
        box.share = share;
    }
    if (box.dim == 0) ret_coarse[0] = fine[0];
    else restrict_box(&box, fine, box.n[0] / 2, box.n[0] / 2 * (box.n[1] / 2), ret_coarse);
}
