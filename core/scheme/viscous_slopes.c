/* viscous_slopes.c - see viscous_slopes.h. Slopes are central differences; along the radius over the distance of
 * centroids. */
#include "scheme/viscous_slopes.h"

#include "base/mem.h"
#include "scheme/patch.h"

#include <string.h>

void viscous_slopes_open(const struct mesh *mesh, struct viscous_slopes *ret)
{
    *ret = (struct viscous_slopes){.rows = mem_new((size_t)3 * SLOPES_QUANTITIES * FACE_ROOM, sizeof *ret->rows)};
    const struct box_block block = patch_block(mesh, 1, NULL);
    size_t stride = 1;
    ret->mixed = mem_new(block.pitch, sizeof *ret->mixed);
    ret->pitch = block.pitch;
    ret->first = box_at(&block, 0, 0, 0);
    for (int d = 0; d < mesh->dim; d++) {
        ret->stride[d] = stride;
        stride *= block.size[d];
    }
}

void viscous_slopes_close(struct viscous_slopes *slopes)
{
    mem_free(slopes->rows);
    mem_free(slopes->mixed);
}

static const double *viscous_slopes_colour(const struct viscous_slopes *slopes)
{
    unsigned n = slopes->tile->model->n_around_alpha;
    if (!slopes->tile->model->n_alpha) return NULL;
    if (n < 2) return slopes->data;
    memset(slopes->mixed, 0, slopes->pitch * sizeof *slopes->mixed);
    for (unsigned l = 0; l < n; l++) {
        const double *alpha = slopes->data + l * slopes->pitch;
        for (size_t i = 0; i < slopes->pitch; i++) slopes->mixed[i] += (l + 1.0) / n * alpha[i];
    }
    return slopes->mixed;
}

void viscous_slopes_look(struct viscous_slopes *slopes, const struct term_tile *tile)
{
    int n = tile->mesh->n[0];
    double half = 0.5 / tile->level->h[0];
    slopes->tile = tile;
    slopes->data = tile->around;
    slopes->colour = viscous_slopes_colour(slopes);
    for (int i = 0; i < n; i++) slopes->along[i] = half;
    if (!tile->mesh->beta) return;
    metric_centroids(tile->mesh, tile->level, tile->tile, slopes->centroid);
    for (int i = 0; i <= n; i++)
        slopes->radius[i] = tile->mesh->lower[0] + (tile->tile->at[0] * n + i) * tile->level->h[0];
    for (int i = 0; i < n; i++) slopes->along[i] = 1.0 / (slopes->centroid[i + 2] - slopes->centroid[i]);
}

/* Velocity d, or the colour, over the patch. */
static const double *viscous_slopes_quantity(const struct viscous_slopes *slopes, unsigned quantity)
{
    if (quantity == SLOPES_COLOUR) return slopes->colour;
    return slopes->data + (slopes->tile->model->n_around_alpha + quantity) * slopes->pitch;
}

/* Cells that follow each other along x, in the patch and in a row. */
struct viscous_run {
    size_t patch, row, n, x; /* x: of the first one, where slopes are taken along axis 0 */
};

static inline void viscous_slopes_copy(size_t n, const double *restrict from, double *restrict to)
{
    for (size_t i = 0; i < n; i++) to[i] = from[i];
}

static inline void viscous_slopes_differ(size_t n, size_t stride, double per, const double *restrict from,
                                         double *restrict to)
{
    for (size_t i = 0; i < n; i++) to[i] = (from[i + stride] - from[i - stride]) * per;
}

/* Along axis 0, whose cells have distances of their own. */
static inline void viscous_slopes_radial(size_t n, const double *restrict per, const double *restrict from,
                                         double *restrict to)
{
    for (size_t i = 0; i < n; i++) to[i] = (from[i + 1] - from[i - 1]) * per[i];
}

/* Slope of a quantity along an axis of space, of a run; to: where the run begins. */
static void viscous_slopes_run(const struct viscous_slopes *slopes, const double *from, int axis,
                               const struct viscous_run *run, double *to)
{
    if (axis == 0) viscous_slopes_radial(run->n, slopes->along + run->x, from + run->patch, to);
    else viscous_slopes_differ(run->n, slopes->stride[axis], 0.5 / slopes->tile->level->h[axis], from + run->patch, to);
}

/* All quantities of a run, and their slopes along the two other axes. */
static void viscous_slopes_all(const struct viscous_slopes *slopes, int axis, const struct viscous_run *run)
{
    for (unsigned q = 0; q < SLOPES_QUANTITIES; q++) {
        double *rows = slopes->rows + (size_t)(3 * q) * FACE_ROOM + run->row;
        if (q == SLOPES_COLOUR ? !slopes->colour : q >= slopes->tile->model->n_velocity) continue;
        const double *from = viscous_slopes_quantity(slopes, q);
        viscous_slopes_copy(run->n, from + run->patch, rows);
        for (int k = 1; k < slopes->tile->mesh->dim; k++)
            viscous_slopes_run(slopes, from, (int)axis_component(axis, (unsigned)k), run, rows + (size_t)k * FACE_ROOM);
    }
}

/* Where a line of cells along x begins in the patch. */
static size_t viscous_slopes_line(const struct viscous_slopes *slopes, size_t line)
{
    size_t n1 = (size_t)slopes->tile->mesh->n[1];
    return slopes->first + line % n1 * slopes->stride[1] + line / n1 * slopes->stride[2];
}

/* A layer of a piece across axis 1 or 2, which may begin and end within a line of cells. */
static void viscous_slopes_layer(const struct viscous_slopes *slopes, const struct frame *frame, size_t o, int i)
{
    size_t n0 = (size_t)slopes->tile->mesh->n[0], end = frame->inner_from + frame->inner;
    ptrdiff_t layer = i * (ptrdiff_t)slopes->stride[frame->axis];
    size_t base = slopes->first + (frame->axis == 1 ? (frame->outer_from + o) * slopes->stride[2] : 0);
    for (size_t c = frame->inner_from; c < end;) {
        size_t x = c % n0, n = n0 - x < end - c ? n0 - x : end - c;
        size_t at = base + x + (frame->axis == 2 ? c / n0 * slopes->stride[1] : 0);
        const struct viscous_run run = {.patch = (size_t)((ptrdiff_t)at + layer),
                                        .row = frame_at(frame, o, i) + (c - frame->inner_from),
                                        .n = n,
                                        .x = x};
        viscous_slopes_all(slopes, frame->axis, &run);
        c += n;
    }
}

void viscous_slopes_gather(struct viscous_slopes *slopes, const struct frame *frame)
{
    for (size_t o = 0; o < frame->outer; o++) {
        if (frame->axis == 0) {
            const struct viscous_run run = {.patch = viscous_slopes_line(slopes, frame->outer_from + o) - 1,
                                            .row = frame_at(frame, o, -1),
                                            .n = frame->n + 2};
            viscous_slopes_all(slopes, 0, &run);
            continue;
        }
        for (int i = -1; i <= (int)frame->n; i++) viscous_slopes_layer(slopes, frame, o, i);
    }
}

void viscous_slopes_cells(const struct viscous_slopes *slopes, const struct viscous_lines *lines,
                          struct viscous_strain *ret)
{
    const struct term_tile *tile = slopes->tile;
    ret->path = tile->model;
    ret->n = lines->n * lines->length;
    for (size_t k = 0; k < lines->n; k++) {
        const struct viscous_run run = {.patch = viscous_slopes_line(slopes, lines->first + k), .n = lines->length};
        const double *radial = viscous_slopes_quantity(slopes, 0) + run.patch;
        size_t to = k * lines->length;
        for (int e = 0; e < tile->mesh->dim; e++) {
            for (unsigned d = 0; d < tile->model->n_velocity; d++)
                viscous_slopes_run(slopes, viscous_slopes_quantity(slopes, d), e, &run, ret->gradient[d][e] + to);
            if (slopes->colour) viscous_slopes_run(slopes, slopes->colour, e, &run, ret->colour[e] + to);
        }
        for (size_t i = 0; tile->mesh->beta && i < lines->length; i++)
            ret->hoop[to + i] = radial[i] / slopes->centroid[i + 1];
    }
    viscous_strain_make(ret, viscous_strain_longest(tile->mesh->dim, tile->level->h));
}
