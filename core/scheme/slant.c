/* slant.c - see slant.h. The block around a tile is one long row from the first cell of the tile to its last: cells
 * beside the tile are done, too, and left out afterwards. */
#include "scheme/slant.h"

#include "phys/row.h"

#include <string.h>

/* Added to sums of squares that may be 0. */
#define SLANT_NONE 1e-300

/* Fractions that say how surfaces lie: of two the first, whose differences are those of the other. */
static unsigned slant_fractions(const struct model *model)
{
    return model->n_alpha > 2 ? model->n_alpha : 1;
}

static BULLA_KERNEL int slant_differ(size_t n, const double *restrict a)
{
    const double first = a[0];
    int count = 0;
#pragma omp simd reduction(+ : count)
    for (size_t i = 0; i < n; i++) count += a[i] != first;
    return count;
}

bool slant_varies(const struct model *model, size_t n, const double *alpha)
{
    bool varies = false;
    for (unsigned l = 0; l < slant_fractions(model) && !varies; l++) varies = slant_differ(n, alpha + l * n) > 0;
    return varies;
}

/* Adds the square of the difference along an axis, over the cells beside it, in the plane; `scale` per difference. */
static BULLA_KERNEL void slant_plane(size_t n, double scale, ptrdiff_t along, ptrdiff_t one, const double *restrict c,
                                     double *restrict sum)
{
    const double *below = c - along, *above = c + along;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double middle = above[i] - below[i], left = (above - one)[i] - (below - one)[i];
        double right = (above + one)[i] - (below + one)[i], was = sum[i];
        double d = scale * ((left + right) + 2.0 * middle);
        sum[i] = was + d * d;
    }
}

/* The same in space. */
static BULLA_KERNEL void slant_space(size_t n, double scale, const ptrdiff_t *stride, const double *restrict c,
                                     double *restrict sum)
{
    const ptrdiff_t one = stride[1], two = stride[2];
    const double *below = c - stride[0], *above = c + stride[0];
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double middle = above[i] - below[i], was = sum[i];
        double sides = ((above + one)[i] - (below + one)[i]) + ((above - one)[i] - (below - one)[i]);
        double others = ((above + two)[i] - (below + two)[i]) + ((above - two)[i] - (below - two)[i]);
        double even =
            ((above + one + two)[i] - (below + one + two)[i]) + ((above - one - two)[i] - (below - one - two)[i]);
        double odd =
            ((above + one - two)[i] - (below + one - two)[i]) + ((above + two - one)[i] - (below + two - one)[i]);
        double d = scale * ((even + odd) + 2.0 * (sides + others) + 4.0 * middle);
        sum[i] = was + d * d;
    }
}

static BULLA_KERNEL void slant_share(size_t n, const double *restrict all, double *restrict share)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) share[i] = share[i] / (all[i] + SLANT_NONE);
}

/* Squares along axis a of all fractions: two of them have the same. */
static void slant_along(const struct model *model, const struct mesh *mesh, const struct box_block *block, int a,
                        double scale, size_t n, const double *first, double *sum)
{
    const ptrdiff_t row = (ptrdiff_t)block->size[0], steps[3] = {1, row, row * (ptrdiff_t)block->size[1]};
    const ptrdiff_t stride[3] = {steps[a], steps[(a + 1) % mesh->dim], steps[(a + 2) % mesh->dim]};
    memset(sum, 0, n * sizeof *sum);
    for (unsigned l = 0; l < slant_fractions(model); l++, first += block->pitch)
        if (mesh->dim == 2) slant_plane(n, scale, stride[0], stride[1], first, sum);
        else slant_space(n, scale, stride, first, sum);
}

void slant_make(const struct model *model, const struct mesh *mesh, const struct box_block *block, const double *h,
                const double *patch, double *room, double *ret_slant)
{
    size_t first = box_at(block, 0, 0, 0), n = box_at(block, mesh->n[0], mesh->n[1] - 1, mesh->n[2] - 1) - first;
    double *all = room + (size_t)mesh->dim * block->pitch;
    memset(all, 0, n * sizeof *all);
    for (int a = 0; a < mesh->dim; a++) {
        double *sum = room + (size_t)a * block->pitch;
        slant_along(model, mesh, block, a, h[0] / h[a], n, patch + first, sum);
        row_add(n, sum, all);
    }
    for (int a = 0; a < mesh->dim; a++) {
        double *share = room + (size_t)a * block->pitch;
        slant_share(n, all, share);
        for (int k = 0; k < mesh->n[2]; k++)
            for (int j = 0; j < mesh->n[1]; j++, ret_slant += mesh->n[0])
                memcpy(ret_slant, share + (box_at(block, 0, j, k) - first), (size_t)mesh->n[0] * sizeof *ret_slant);
    }
}

/* The array of a stage's result has had other fields in it. */
static size_t slant_apply(const struct term_tile *tile, double *u_new)
{
    const struct model *path = tile->model;
    memset(u_new + path->i_slant * tile->n_cell, 0, path->n_slant * tile->n_cell * sizeof *u_new);
    return 0;
}

const struct term slant_term = {
    .name = "slant",
    .owner = "core/scheme/slant.c",
    .equation = "edges of alpha: those of along-limiter + s (those of interface-limiter - those), s = n_d^2",
    .wanted = slant_acts,
    .apply = slant_apply,
};
