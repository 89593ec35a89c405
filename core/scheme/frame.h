/* frame.h - a piece of a tile with some layers of neighbours along one axis, gathered for a sweep.
 *
 * Seen along axis a, a tile is [outer][n_a][inner]; a frame is a sub-range of outer and inner
 * with n_a extended by the mesh's ghosts on both sides: [outer][n_a + 2 ghosts][inner], so that a step of
 * `inner` doubles is one cell along the axis, whatever the axis, and kernels see one long row.
 * No corners, no stored ghosts: copying is cheaper than keeping frames (docs/decisions). */
#ifndef FRAME_H
#define FRAME_H

#include "mesh/axis.h"
#include "mesh/halo.h"
#include "mesh/mesh.h"

#include <stddef.h>

enum { FRAME_CELLS = 768 }; /* most cells of a frame, the layers included: what a sweep works on stays in L2 */

/* Which part of a tile, along which axis. */
struct frame {
    int axis;
    size_t outer, n, inner; /* extents of the piece; n: cells of the tile along the axis */
    size_t ghosts;          /* layers on each side */
    size_t outer_from, inner_from;
    size_t tile_outer, tile_inner; /* extents of the whole tile */
    size_t count;                  /* outer * frame_layers * inner */
};

/* Where a gather reads: tiles of one level, halo slabs, and what to do at domain boundaries. */
struct frame_source {
    const struct mesh *mesh;
    const struct level *level;
    double *const *arrays;   /* [n_local] blocks of n_field components */
    const struct halo *halo; /* finished exchange of the same arrays */
    const struct link *link; /* strips behind coarse-fine faces; NULL: `boundary` fills those too */
    unsigned n_field;
    const unsigned
        *fields; /* [n_field] components to gather, each keeps its number in the frame; NULL: the first n_field */
    /* Fills the layers of all fields behind a boundary (and, without a link, a coarse-fine) face `side`;
     * `data` is its own. */
    void (*boundary)(void *data, unsigned local, const struct frame *frame, int side, size_t pitch, double *w);
    void *data;
};

/* Cells of a piece as runs that follow each other in its row and in the tile: how many runs, how long, and how far
 * apart. The first begins at frame_at(frame, 0, 0) and frame_tile_at(frame, 0, 0). */
struct frame_runs {
    size_t count, n, row, tile;
};
struct frame_runs frame_runs(const struct frame *frame);

/* Number of pieces a tile is swept in along an axis, and the piece `index`. */
size_t frame_pieces(const struct mesh *mesh, int axis);
struct frame frame_piece(const struct mesh *mesh, int axis, size_t index);

/* Copies the piece of local tile `local` and its neighbours' layers to w, component q at w + q * pitch
 * (pitch >= count). Layer g of a side lies next to cell 0 or n - 1; see frame_at. */
void frame_gather(const struct frame_source *source, unsigned local, const struct frame *frame, size_t pitch,
                  double *w);

/* Asks caches for what all gathers of a tile will read from cells of this rank. */
void frame_foresee(const struct frame_source *source, unsigned local);

/* Centre of face c (outer, then inner) of a piece at the domain's boundary, `side` of the frame's axis. */
void frame_place(const struct frame *frame, const struct mesh *mesh, const struct level *level, const struct tile *tile,
                 int side, size_t c, double ret_x[3]);

/* Cells of a frame along its axis. */
static inline size_t frame_layers(const struct frame *frame)
{
    return frame->n + 2 * frame->ghosts;
}

/* Offset in a frame of outer index o, axis index i (-ghosts ... n + ghosts - 1), inner index 0. */
static inline size_t frame_at(const struct frame *frame, size_t o, int i)
{
    return (o * frame_layers(frame) + (size_t)(i + (int)frame->ghosts)) * frame->inner;
}

/* From the first cell of a frame to the first that has edges, whose neighbours are all in the row; and how many
 * have. */
static inline size_t frame_reach(const struct frame *frame)
{
    return (frame->ghosts - 1) * frame->inner;
}

static inline size_t frame_edged(const struct frame *frame)
{
    return frame->count - 2 * frame_reach(frame);
}

/* Offset in a tile's component of the same cell. */
static inline size_t frame_tile_at(const struct frame *frame, size_t o, size_t i)
{
    return ((frame->outer_from + o) * frame->n + i) * frame->tile_inner + frame->inner_from;
}

#endif
