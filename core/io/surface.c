/* surface.c - see surface.h.
 *
 * The surface passes between two neighbouring cells wherever alpha - 1/2 changes sign. At each
 * such place the field is interpolated to alpha = 1/2, and the place counts with the area of the
 * face times |n_a|, n the normal of the surface from the gradient of alpha and a the axis of the
 * pair: a plane of area S is crossed |n_a| S / A times along axis a, so these weights add up to
 * S sum n_a^2 = S whatever its direction. Pairs across tiles and ranks belong to the lower tile.
 * Tiles away from the surface only lend their alpha. A pair counts on the finest level that holds both
 * cells: of two cells of a level at least one must be a leaf, where the other holds the mean of finer
 * ones; a fine cell and a coarse one are no pair. */
#include "io/surface.h"

#include "base/comm.h"
#include "base/mem.h"
#include "mesh/halo.h"
#include "mesh/metric.h"
#include "mesh/tally.h"
#include "scheme/bound.h"
#include "scheme/frame.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Components of the work arrays: alpha, the field times its weight, the weight (1, or the fraction of the material that
 * the field belongs to), how much `where` covers, 1 in leaves, the gradient of alpha. */
enum { SURFACE_ALPHA, SURFACE_FIELD, SURFACE_WEIGHT, SURFACE_COVER, SURFACE_LEAF, SURFACE_SLOPE };

struct surface {
    const struct state *state;
    const struct mesh *mesh;
    const struct level *level;
    int l;
    unsigned n; /* components */
    double **arrays;
    int *side; /* of each local tile: all below 1/2 (-1), all above (1), both (0) */
    struct halo *halo;
    double *frame;  /* [n][FRAME_CELLS] */
    double most[2]; /* of the values of all crossings, and of their negatives */
    bool keep;      /* every crossing as a piece */
    size_t n_piece;
    struct surface_piece *pieces;
};

/* Copies alpha, marks leaves; which side of 1/2 the tile lies on: -1, 1, or 0 for both. */
static int surface_take(const struct surface *surface, unsigned local, unsigned material)
{
    size_t n = surface->mesh->n_cell, above = 0;
    const double *alpha = surface->level->u_old[local] + (surface->state->model->i_alpha + material) * n;
    memcpy(surface->arrays[local] + SURFACE_ALPHA * n, alpha, n * sizeof *alpha);
    mesh_leaves(surface->mesh, &surface->level->tiles[surface->level->first + local],
                surface->arrays[local] + SURFACE_LEAF * n);
    for (size_t i = 0; i < n; i++) above += alpha[i] >= 0.5;
    return above == n ? 1 : above == 0 ? -1 : 0;
}

/* Can the surface cross a pair of cells that this tile is part of? */
static bool surface_is_near(const struct surface *surface, unsigned local)
{
    if (surface->level->tiles[surface->level->first + local].hidden) return false; /* nor is a neighbour a leaf */
    if (surface->side[local] == 0) return true;
    for (int face = 0; face < 2 * surface->mesh->dim; face++) {
        const struct neighbour *other = &surface->level->neighbours[local][face];
        if (other->kind == NEIGHBOUR_REMOTE) return true;
        if (other->kind == NEIGHBOUR_LOCAL && surface->side[other->index] != surface->side[local]) return true;
    }
    return false;
}

static void surface_fill(struct surface *surface, unsigned local, const struct derive *field,
                         const struct region *where)
{
    size_t n = surface->mesh->n_cell;
    double *to = surface->arrays[local], *values = mem_new(3 * n, sizeof *values);
    const double *fractions = NULL;
    enum region_cover cover = where ? region_tile(where, surface->l, local, &fractions) : REGION_ALL;
    derive_tile(surface->state->model, surface->mesh, surface->l, local, surface->state->t, field, values);
    const struct model *model = surface->state->model;
    int material = model->n_alpha ? derive_material(field) : -1;
    const double *own = surface->level->u_old[local] + (model->i_alpha + (unsigned)(material < 0 ? 0 : material)) * n;
    for (size_t i = 0; i < n; i++) {
        double x = values[i], y = values[n + i], z = values[2 * n + i],
               weight = material < 0 ? 1.0
                        : x != 0.0   ? own[i]
                                     : 0.0;
        to[SURFACE_FIELD * n + i] = weight * (field->components == 3 ? sqrt(x * x + y * y + z * z) : x);
        to[SURFACE_WEIGHT * n + i] = weight;
        to[SURFACE_COVER * n + i] = cover == REGION_PART ? fractions[i] : cover == REGION_ALL;
    }
    mem_free(values);
}

/* Is there a coarser tile behind this side of the frame? */
static bool surface_is_jump(const struct surface *surface, unsigned local, const struct frame *frame, int side)
{
    return surface->level->neighbours[local][2 * frame->axis + side].kind == NEIGHBOUR_COARSE;
}

/* Layers behind a side: copies; before coarser cells alpha goes on with its slope. */
static void surface_boundary(void *data, unsigned local, const struct frame *frame, int side, size_t pitch, double *w)
{
    const struct surface *surface = data;
    for (unsigned q = 0; q < surface->n; q++) bound_copy(NULL, local, frame, side, pitch, w + q * pitch);
    if (!surface_is_jump(surface, local, frame, side)) return;
    int last = side ? (int)frame->n - 1 : 0, out = side ? 1 : -1;
    double *alpha = w + SURFACE_ALPHA * pitch;
    for (size_t o = 0; o < frame->outer; o++)
        for (size_t j = 0; j < frame->inner; j++) {
            double here = alpha[frame_at(frame, o, last) + j], inside = alpha[frame_at(frame, o, last - out) + j];
            alpha[frame_at(frame, o, last + out) + j] = 2.0 * here - inside;
        }
}

/* Calls `visit` with every frame of a tile. */
static void surface_sweep(struct surface *surface, unsigned local,
                          void (*visit)(struct surface *, unsigned, const struct frame *, double *), double *data)
{
    const struct frame_source source = {.mesh = surface->mesh,
                                        .level = surface->level,
                                        .arrays = surface->arrays,
                                        .halo = surface->halo,
                                        .n_field = surface->n,
                                        .boundary = surface_boundary,
                                        .data = surface};
    for (int axis = 0; axis < surface->mesh->dim; axis++)
        for (size_t piece = 0; piece < frame_pieces(surface->mesh, axis); piece++) {
            struct frame frame = frame_piece(surface->mesh, axis, piece);
            frame_gather(&source, local, &frame, FRAME_CELLS, surface->frame);
            visit(surface, local, &frame, data);
        }
}

/* Central differences of alpha along the frame's axis, into the tile's own arrays. */
static void surface_slope(struct surface *surface, unsigned local, const struct frame *frame, double *data)
{
    const double *alpha = surface->frame + SURFACE_ALPHA * FRAME_CELLS;
    unsigned component = SURFACE_SLOPE + (unsigned)frame->axis;
    double *slope = surface->arrays[local] + component * surface->mesh->n_cell;
    (void)data;
    for (size_t o = 0; o < frame->outer; o++)
        for (size_t i = 0; i < frame->n; i++)
            for (size_t j = 0; j < frame->inner; j++) {
                size_t at = frame_at(frame, o, (int)i) + j;
                slope[frame_tile_at(frame, o, i) + j] =
                    (alpha[at + frame->inner] - alpha[at - frame->inner]) / (2.0 * surface->level->h[frame->axis]);
            }
}

/* |n_a| between frame cells `at` and the next, from the mean of their gradients. */
static double surface_normal(const struct surface *surface, const struct frame *frame, size_t at)
{
    double sum = 0.0, along = 0.0;
    for (int axis = 0; axis < surface->mesh->dim; axis++) {
        const double *slope = surface->frame + (size_t)(SURFACE_SLOPE + axis) * FRAME_CELLS;
        double mean = 0.5 * (slope[at] + slope[at + frame->inner]);
        sum += mean * mean;
        if (axis == frame->axis) along = fabs(mean);
    }
    return sum > 0.0 ? along / sqrt(sum) : 1.0;
}

/* Whole area of the upper face, along the frame's axis, of a tile's cell. */
static double surface_area(const struct surface *surface, const struct metric *metric, const struct frame *frame,
                           size_t cell)
{
    const struct mesh *mesh = surface->mesh;
    size_t i = cell % (size_t)mesh->n[0];
    double area = metric_full(mesh->beta) * (frame->axis == 0 ? metric->area[i + 1] : metric->volume[i]);
    for (int axis = 1; axis < mesh->dim; axis++)
        if (axis != frame->axis) area *= surface->level->h[axis];
    return area;
}

/* Keeps a crossing behind frame cell `at` (cell `cell` of the tile) for surface_pieces. */
static void surface_keep(struct surface *surface, unsigned local, int axis, size_t cell, double share,
                         struct surface_piece piece)
{
    const struct mesh *mesh = surface->mesh;
    mesh_corner(mesh, surface->level, &surface->level->tiles[surface->level->first + local], piece.x);
    for (int d = 0; d < mesh->dim; d++) {
        size_t n = (size_t)mesh->n[d];
        double way = (double)(cell % n) + 0.5 + (d == axis ? share : 0.0);
        piece.x[d] += way * surface->level->h[d];
        piece.h[d] = surface->level->h[d];
        cell /= n;
    }
    surface->pieces = mem_grow(surface->pieces, surface->n_piece, surface->n_piece + 1, sizeof *surface->pieces);
    surface->pieces[surface->n_piece++] = piece;
}

/* Adds area times field, and area, of the crossings of a frame to data[0], data[1]. */
static void surface_cross(struct surface *surface, unsigned local, const struct frame *frame, double *data)
{
    const double *alpha = surface->frame, *field = alpha + SURFACE_FIELD * FRAME_CELLS;
    const double *weight = alpha + SURFACE_WEIGHT * FRAME_CELLS;
    const double *cover = alpha + SURFACE_COVER * FRAME_CELLS, *leaf = alpha + SURFACE_LEAF * FRAME_CELLS;
    size_t pairs = frame->n - surface_is_jump(surface, local, frame, 1);
    struct metric metric;
    metric_of_tile(surface->mesh, surface->level, &surface->level->tiles[surface->level->first + local], &metric);
    for (size_t o = 0; o < frame->outer; o++)
        for (size_t i = 0; i < pairs; i++)
            for (size_t j = 0; j < frame->inner; j++) {
                size_t at = frame_at(frame, o, (int)i) + j, next = at + frame->inner;
                if (leaf[at] + leaf[next] < 0.5) continue;
                if ((alpha[at] >= 0.5) == (alpha[next] >= 0.5)) continue;
                double share = (0.5 - alpha[at]) / (alpha[next] - alpha[at]);
                double part = weight[at] + share * (weight[next] - weight[at]);
                if (cover[at] + share * (cover[next] - cover[at]) < 0.5 || !(part > 0.0)) continue;
                size_t cell = frame_tile_at(frame, o, i) + j;
                double area = surface_area(surface, &metric, frame, cell) * surface_normal(surface, frame, at);
                double value = (field[at] + share * (field[next] - field[at])) / part;
                data[0] += area * value;
                data[1] += area;
                surface->most[0] = value > surface->most[0] ? value : surface->most[0];
                surface->most[1] = -value > surface->most[1] ? -value : surface->most[1];
                if (surface->keep)
                    surface_keep(surface, local, frame->axis, cell, share,
                                 (struct surface_piece){.area = area, .value = value});
            }
}

static void surface_exchange(struct surface *surface)
{
    halo_start(surface->halo, surface->arrays);
    halo_finish(surface->halo);
}

/* Sums of one level, two per local tile. */
static void surface_of_level(struct surface *surface, unsigned material, const struct derive *field,
                             const struct region *where, double *sums)
{
    unsigned n_local = surface->level->n_local;
    surface->arrays = mem_new(n_local, sizeof *surface->arrays);
    surface->side = mem_new(n_local, sizeof *surface->side);
    surface->halo = halo_new(surface->mesh, surface->level, surface->n);
    for (unsigned i = 0; i < n_local; i++) {
        surface->arrays[i] = mem_new(surface->n * surface->mesh->n_cell, sizeof(double));
        surface->side[i] = surface_take(surface, i, material);
    }
    for (unsigned i = 0; i < n_local; i++)
        if (surface_is_near(surface, i)) surface_fill(surface, i, field, where);
    surface_exchange(surface);
    for (unsigned i = 0; i < n_local; i++)
        if (surface_is_near(surface, i)) surface_sweep(surface, i, surface_slope, NULL);
    surface_exchange(surface); /* now with the slopes */
    for (unsigned i = 0; i < n_local; i++)
        if (surface_is_near(surface, i)) surface_sweep(surface, i, surface_cross, sums + 2 * (size_t)i);
    for (unsigned i = 0; i < n_local; i++) mem_free(surface->arrays[i]);
    halo_free(surface->halo);
    mem_free(surface->side);
    mem_free(surface->arrays);
}

/* Looks at all levels; `sums` has two numbers per local tile. */
static void surface_look(struct surface *surface, const struct state *state, unsigned material,
                         const struct derive *field, const struct region *where, double *sums)
{
    surface->state = state;
    surface->mesh = state->mesh;
    surface->n = SURFACE_SLOPE + (unsigned)state->mesh->dim;
    surface->most[0] = surface->most[1] = -INFINITY;
    surface->frame = mem_new((size_t)surface->n * FRAME_CELLS, sizeof *surface->frame);
    for (surface->l = 0; surface->l < state->mesh->n_level; surface->l++) {
        surface->level = &state->mesh->levels[surface->l];
        surface_of_level(surface, material, field, where, sums);
        sums += 2 * (size_t)surface->level->n_local;
    }
    mem_free(surface->frame);
}

double surface_mean(const struct state *state, unsigned material, const struct derive *field,
                    const struct region *where)
{
    struct surface surface = {0};
    if (!state->model->n_alpha) return NAN;
    double *sums = mem_new(2 * (tally_tiles(state->mesh) + 1), sizeof *sums), totals[2];
    surface_look(&surface, state, material, field, where, sums);
    tally_add(state->mesh, 2, sums, totals);
    mem_free(sums);
    return totals[0] / totals[1];
}

void surface_extremes(const struct state *state, unsigned material, const struct derive *field,
                      const struct region *where, double ret_ends[2])
{
    struct surface surface = {0};
    ret_ends[0] = ret_ends[1] = (double)NAN;
    if (!state->model->n_alpha) return;
    double *sums = mem_new(2 * (tally_tiles(state->mesh) + 1), sizeof *sums);
    surface_look(&surface, state, material, field, where, sums);
    mem_free(sums);
    comm_max(surface.most, 2);
    if (!(surface.most[0] >= -surface.most[1])) return;
    ret_ends[0] = -surface.most[1];
    ret_ends[1] = surface.most[0];
}

enum { SURFACE_PIECE = sizeof(struct surface_piece) / sizeof(double) };

/* Any order will do that the ranks have no part in. */
static int surface_compare(const void *a, const void *b)
{
    const double *x = a, *y = b;
    for (int i = 0; i < SURFACE_PIECE; i++)
        if (x[i] != y[i]) return x[i] < y[i] ? -1 : 1;
    return 0;
}

struct surface_piece *surface_pieces(const struct state *state, unsigned material, const struct derive *field,
                                     const struct region *where, size_t *ret_n)
{
    struct surface surface = {.keep = true};
    *ret_n = 0;
    if (!state->model->n_alpha) return NULL;
    double *sums = mem_new(2 * (tally_tiles(state->mesh) + 1), sizeof *sums);
    surface_look(&surface, state, material, field, where, sums);
    double own = (double)surface.n_piece, *counts = mem_new((size_t)comm_size(), sizeof *counts), total = 0.0;
    comm_join(&own, 1, counts);
    for (int rank = 0; rank < comm_size(); rank++) total += counts[rank];
    struct surface_piece *all = mem_new((size_t)total + 1, sizeof *all);
    comm_join((const double *)surface.pieces, SURFACE_PIECE * (int)surface.n_piece, (double *)all);
    qsort(all, (size_t)total, sizeof *all, surface_compare);
    mem_free(surface.pieces);
    mem_free(counts);
    mem_free(sums);
    *ret_n = (size_t)total;
    return all;
}
