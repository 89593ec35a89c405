/* viscous_slopes.c - see viscous_slopes.h. Slopes are central differences; along the radius over the distance of
 * centroids. */
#include "scheme/viscous_slopes.h"

#include "base/mem.h"
#include "scheme/patch.h"

#include <string.h>

void viscous_slopes_open(const struct mesh *mesh, struct viscous_slopes *ret)
{
    const struct box_block block = rim_block(mesh, 1, NULL);
    size_t stride = 1;
    *ret = (struct viscous_slopes){.mixed = mem_new(block.pitch, sizeof *ret->mixed),
                                   .pitch = block.pitch,
                                   .first = box_at(&block, 0, 0, 0)};
    for (int d = 0; d < mesh->dim; d++) {
        ret->stride[d] = stride;
        stride *= block.size[d];
    }
}

void viscous_slopes_close(struct viscous_slopes *slopes)
{
    mem_free(slopes->mixed);
}

static const double *viscous_slopes_colour(const struct viscous_slopes *slopes)
{
    const struct model *path = slopes->tile->model;
    unsigned n = path->n_around_alpha;
    if (!path->n_alpha) return NULL;
    if (n < 2) return slopes->data;
    memset(slopes->mixed, 0, slopes->pitch * sizeof *slopes->mixed);
    for (unsigned l = 0; l < n; l++) {
        const double *alpha = slopes->data + l * slopes->pitch;
        for (size_t i = 0; i < slopes->pitch; i++) slopes->mixed[i] += path->colour[l + 1] * alpha[i];
    }
    return slopes->mixed;
}

/* Distances along the radius are those of centroids. */
static void viscous_slopes_curve(struct viscous_slopes *slopes)
{
    const struct term_tile *tile = slopes->tile;
    int n = tile->mesh->n[0];
    double *r = slopes->centroid;
    metric_centroids(tile->mesh, tile->level, tile->tile, r);
    for (int i = 0; i <= n; i++) {
        double face = tile->mesh->lower[0] + (tile->tile->at[0] * n + i) * tile->level->h[0];
        slopes->across[0][i] = 1.0 / (r[i + 1] - r[i]);
        slopes->part[i] = (face - r[i]) / (r[i + 1] - r[i]);
    }
    for (int i = 0; i < n; i++) slopes->along[0][i] = 1.0 / (r[i + 2] - r[i]);
}

void viscous_slopes_look(struct viscous_slopes *slopes, const struct term_tile *tile)
{
    slopes->tile = tile;
    slopes->data = tile->around;
    slopes->colour = viscous_slopes_colour(slopes);
    for (int d = 0; d < tile->mesh->dim; d++)
        for (int i = 0; i <= tile->mesh->n[0]; i++) {
            slopes->along[d][i] = 0.5 / tile->level->h[d];
            slopes->across[d][i] = 1.0 / tile->level->h[d];
        }
    if (tile->mesh->beta) viscous_slopes_curve(slopes);
}

static inline size_t viscous_slopes_least(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* Where a line of cells along x begins in the patch. */
static size_t viscous_slopes_line(const struct viscous_slopes *slopes, size_t line)
{
    size_t n1 = (size_t)slopes->tile->mesh->n[1];
    return slopes->first + line % n1 * slopes->stride[1] + line / n1 * slopes->stride[2];
}

/* Lines that follow line `line` at one distance, as many as `most`. */
static size_t viscous_slopes_even(const struct viscous_slopes *slopes, size_t line, size_t most)
{
    size_t n1 = (size_t)slopes->tile->mesh->n[1];
    return viscous_slopes_least(n1 - line % n1, most);
}

/* Faces across axis 0: a row is a line, or a part of a very long one. */
static void viscous_slopes_lines(struct viscous_walk *walk, struct viscous_block *ret)
{
    const struct viscous_slopes *slopes = walk->slopes;
    const struct frame *frame = walk->frame;
    size_t line = frame->outer_from + walk->o, faces = frame->n + 1;
    size_t rows = viscous_slopes_even(slopes, line, frame->outer - walk->o);
    size_t n = viscous_slopes_least(faces - walk->c, STRAIN_POINTS);
    *ret = (struct viscous_block){.rows = rows,
                                  .n = n,
                                  .x = walk->c,
                                  .patch = viscous_slopes_line(slopes, line) - 1 + walk->c,
                                  .patch_row = slopes->stride[1],
                                  .face = face_at(frame, walk->o, 0) + walk->c,
                                  .face_row = frame_layers(frame),
                                  .step = 1};
    walk->c += n;
    if (walk->c < faces) return;
    walk->c = 0;
    walk->o += rows;
}

/* Faces across axis 1 or 2: a row is a layer of cells, as much of it as lies in one line. */
static void viscous_slopes_layers(struct viscous_walk *walk, struct viscous_block *ret)
{
    const struct viscous_slopes *slopes = walk->slopes;
    const struct frame *frame = walk->frame;
    size_t n0 = (size_t)slopes->tile->mesh->n[0], cell = frame->inner_from + walk->c, x = cell % n0;
    size_t step = slopes->stride[frame->axis];
    size_t plane = frame->axis == 1 ? (frame->outer_from + walk->o) * slopes->stride[2] : cell / n0 * slopes->stride[1];
    *ret = (struct viscous_block){.rows = frame->n + 1,
                                  .n = viscous_slopes_least(n0 - x, frame->inner - walk->c),
                                  .x = x,
                                  .patch = slopes->first + plane + x - step,
                                  .patch_row = step,
                                  .face = face_at(frame, walk->o, 0) + walk->c,
                                  .face_row = frame->inner,
                                  .step = step,
                                  .axis = frame->axis};
    walk->c += ret->n;
    if (walk->c < frame->inner) return;
    walk->c = 0;
    walk->o++;
}

bool viscous_slopes_next(struct viscous_walk *walk, struct viscous_block *ret)
{
    if (walk->o >= walk->frame->outer) return false;
    if (walk->frame->axis == 0) viscous_slopes_lines(walk, ret);
    else viscous_slopes_layers(walk, ret);
    return true;
}

void viscous_slopes_part(struct viscous_block *rest, size_t rows, struct viscous_block *ret)
{
    *ret = *rest;
    ret->rows = rows;
    rest->rows -= rows;
    rest->patch += rows * rest->patch_row;
    rest->face += rows * rest->face_row;
}

bool viscous_slopes_batch(struct viscous_block *rest, struct viscous_block *ret)
{
    size_t most = STRAIN_POINTS / rest->n, parts = (rest->rows + most - 1) / most;
    if (!rest->rows) return false;
    viscous_slopes_part(rest, (rest->rows + parts - 1) / parts, ret); /* parts of one size */
    return true;
}

struct viscous_block viscous_slopes_cells(const struct viscous_slopes *slopes, size_t first, size_t most)
{
    size_t n = (size_t)slopes->tile->mesh->n[0];
    return (struct viscous_block){.rows = viscous_slopes_even(slopes, first, most),
                                  .n = n,
                                  .patch = viscous_slopes_line(slopes, first),
                                  .patch_row = slopes->stride[1],
                                  .face = first * n,
                                  .face_row = n,
                                  .axis = -1};
}

static BULLA_KERNEL void viscous_slopes_differ(const struct viscous_block *block, const double *restrict low,
                                               const double *restrict high, const double *restrict per,
                                               double *restrict slope)
{
    size_t n = block->n, row = block->patch_row;
    for (size_t r = 0; r < block->rows; r++, low += row, high += row, slope += n)
#pragma omp simd
        for (size_t i = 0; i < n; i++) slope[i] = (high[i] - low[i]) * per[i];
}

/* Slopes along a face: the mean of those of both cells. t: from a cell to the next along the face. */
static BULLA_KERNEL void viscous_slopes_along(const struct viscous_block *block, size_t t, const double *restrict a,
                                              const double *restrict per, double *restrict slope)
{
    size_t n = block->n, row = block->patch_row;
    const double *restrict b = a + block->step;
    for (size_t r = 0; r < block->rows; r++, a += row, b += row, slope += n)
#pragma omp simd
        for (size_t i = 0; i < n; i++)
            slope[i] = 0.5 * ((a[i + t] - (a - t)[i]) * per[i] + (b[i + t] - (b - t)[i]) * per[i]);
}

/* Gradient of one quantity; from: over the patch. */
static void viscous_slopes_derive(const struct viscous_slopes *slopes, const struct viscous_block *block,
                                  const double *from, double (*ret)[STRAIN_POINTS])
{
    const double *at = from + block->patch;
    for (int e = 0; e < slopes->tile->mesh->dim; e++) {
        size_t t = slopes->stride[e];
        const double *along = slopes->along[e] + block->x, *across = slopes->across[e] + block->x;
        if (e == block->axis) viscous_slopes_differ(block, at, at + t, across, ret[e]);
        else if (block->step) viscous_slopes_along(block, t, at, along, ret[e]);
        else viscous_slopes_differ(block, at - t, at + t, along, ret[e]);
    }
}

/* u_r/r. At r = 0, where the area is 0, that is du_r/dr. */
static void viscous_slopes_hoop(const struct viscous_slopes *slopes, const struct viscous_block *block,
                                struct viscous_strain *strain)
{
    const double *r = slopes->centroid + block->x, *u = viscous_slopes_velocity(slopes, 0) + block->patch;
    for (size_t k = 0; k < block->rows; k++, u += block->patch_row)
        for (size_t i = 0; i < block->n; i++) {
            size_t to = k * block->n + i;
            double sum = block->axis ? 2.0 * r[i + 1] : r[i] + r[i + 1];
            strain->hoop[to] = sum > 0.0 ? (u[i] + u[i + block->step]) / sum : strain->gradient[0][0][to];
        }
}

/* Of what turns the shear is r d(u_th/r)/dr: none where it turns as a whole. */
static void viscous_slopes_turn(const struct viscous_slopes *slopes, const struct viscous_block *block, double *slope)
{
    const double *r = slopes->centroid + block->x, *w = viscous_slopes_velocity(slopes, 2) + block->patch;
    const double *across = slopes->across[0] + block->x, *along = slopes->along[0] + block->x;
    bool faces = block->axis == 0;
    for (size_t k = 0; k < block->rows; k++, w += block->patch_row)
        for (size_t i = 0; i < block->n; i++) {
            size_t s = block->step;
            double here = r[i] + slopes->part[block->x + i] * (r[i + 1] - r[i]), middle = r[i + 1];
            double whole = w[i + 1] / r[i + 2] - (w - 1)[i] / r[i];
            double beside = w[i + s + 1] / r[i + 2] - (w + s - 1)[i] / r[i];
            slope[k * block->n + i] = faces ? here * (w[i + 1] / r[i + 1] - w[i] / r[i]) * across[i]
                                            : middle * (0.5 * (whole + beside)) * along[i];
        }
}

void viscous_slopes_strain(const struct viscous_slopes *slopes, const struct viscous_block *block,
                           struct viscous_strain *ret)
{
    const struct term_tile *tile = slopes->tile;
    ret->path = tile->model;
    ret->n = block->rows * block->n;
    for (unsigned d = 0; d < ret->path->n_velocity; d++)
        viscous_slopes_derive(slopes, block, viscous_slopes_velocity(slopes, d), ret->gradient[d]);
    if (slopes->colour) viscous_slopes_derive(slopes, block, slopes->colour, ret->colour);
    if (tile->mesh->beta) viscous_slopes_hoop(slopes, block, ret);
    if (model_turns(ret->path)) viscous_slopes_turn(slopes, block, ret->gradient[2][0]);
    viscous_strain_make(ret, viscous_strain_longest(tile->mesh->dim, tile->level->h));
}

static BULLA_KERNEL void viscous_slopes_mean(const struct viscous_block *block, const double *restrict a,
                                             double *restrict mean)
{
    size_t n = block->n, step = block->step;
    for (size_t r = 0; r < block->rows; r++, a += block->patch_row, mean += n)
#pragma omp simd
        for (size_t i = 0; i < n; i++) mean[i] = 0.5 * (a[i] + a[i + step]);
}

void viscous_slopes_speed(const struct viscous_slopes *slopes, const struct viscous_block *block, unsigned d,
                          double *ret)
{
    const double *u = viscous_slopes_velocity(slopes, d) + block->patch, *part = slopes->part + block->x;
    if (!slopes->tile->mesh->beta || block->axis) {
        viscous_slopes_mean(block, u, ret);
        return;
    }
    for (size_t r = 0; r < block->rows; r++, u += block->patch_row)
        for (size_t i = 0; i < block->n; i++) ret[r * block->n + i] = u[i] + part[i] * (u[i + 1] - u[i]);
}
