/* frame.c - gathering, see frame.h. */
#include "scheme/frame.h"

#include "mesh/link.h"
#include "scheme/blend.h"

#include <string.h>

static struct frame frame_whole(const struct mesh *mesh, int axis)
{
    struct frame frame = {.axis = axis, .n = (size_t)mesh->n[axis], .ghosts = (size_t)mesh->ghosts, .tile_inner = 1};
    for (int d = 0; d < axis; d++) frame.tile_inner *= (size_t)mesh->n[d];
    frame.tile_outer = mesh->n_cell / frame.n / frame.tile_inner;
    size_t length = frame_layers(&frame);
    frame.inner = frame.tile_inner;
    while (frame.inner * length > FRAME_CELLS) frame.inner = (frame.inner + 1) / 2;
    frame.outer = FRAME_CELLS / (length * frame.inner);
    if (frame.outer < 1) frame.outer = 1;
    if (frame.outer > frame.tile_outer) frame.outer = frame.tile_outer;
    return frame;
}

static size_t frame_cut(size_t whole, size_t piece)
{
    return (whole + piece - 1) / piece;
}

size_t frame_pieces(const struct mesh *mesh, int axis)
{
    struct frame frame = frame_whole(mesh, axis);
    return frame_cut(frame.tile_outer, frame.outer) * frame_cut(frame.tile_inner, frame.inner);
}

struct frame frame_piece(const struct mesh *mesh, int axis, size_t index)
{
    struct frame frame = frame_whole(mesh, axis);
    size_t across = frame_cut(frame.tile_inner, frame.inner);
    frame.outer_from = index / across * frame.outer;
    frame.inner_from = index % across * frame.inner;
    if (frame.outer > frame.tile_outer - frame.outer_from) frame.outer = frame.tile_outer - frame.outer_from;
    if (frame.inner > frame.tile_inner - frame.inner_from) frame.inner = frame.tile_inner - frame.inner_from;
    frame.count = frame.outer * frame_layers(&frame) * frame.inner;
    return frame;
}

/* Copies a row; short rows, the usual case, without a call. */
static inline void frame_row(size_t n, const double *restrict source, double *restrict target)
{
    size_t i = 0;
    for (; i + 4 <= n; i += 4) memcpy(target + i, source + i, 4 * sizeof *target);
    for (; i < n; i++) target[i] = source[i];
}

/* `layers` layers of every outer slice, from a block whose slices have `depth` layers, starting
 * at layer `from`, to frame layer `to`. */
static void frame_copy(const struct frame *frame, const double *block, size_t depth, size_t from, int to, size_t layers,
                       double *w)
{
    bool whole = frame->inner == frame->tile_inner; /* then the layers of a slice follow each other */
    size_t rows = whole ? 1 : layers, length = whole ? layers * frame->inner : frame->inner;
    const double *source = block + (frame->outer_from * depth + from) * frame->tile_inner + frame->inner_from;
    double *target = w + frame_at(frame, 0, to);
    size_t source_slice = depth * frame->tile_inner, slice = frame_layers(frame) * frame->inner;
    for (size_t o = 0; o < frame->outer; o++, source += source_slice, target += slice)
        for (size_t row = 0; row < rows; row++)
            frame_row(length, source + row * frame->tile_inner, target + row * frame->inner);
}

static unsigned frame_field(const struct frame_source *source, unsigned i)
{
    return source->fields ? source->fields[i] : i;
}

/* The layers behind a coarse-fine face, of field q: linear in time between two strips, which may hold one layer more
 * than is needed, the one furthest from the face. */
static void frame_copy_strip(const struct frame_source *source, const struct link_face *face, unsigned q,
                             const struct frame *frame, int to, double *w)
{
    size_t depth = 2 * (size_t)link_depth(source->mesh), skip = to < 0 ? depth - frame->ghosts : 0;
    size_t slice = depth * frame->tile_inner, block = frame->tile_outer * slice, n_alpha = source->mesh->n_alpha;
    size_t at = frame->outer_from * slice + skip * frame->tile_inner + frame->inner_from;
    double theta = source->link->theta;
    const double *first = face->strip[0], *last = theta > 0.0 ? face->strip[1] : first;
    for (size_t o = 0; o < frame->outer; o++, at += slice)
        for (int row = 0; row < (int)frame->ghosts; row++) {
            size_t from = q * block + at + (size_t)row * frame->tile_inner, back = n_alpha * block;
            double *target = w + frame_at(frame, o, to + row);
            if (q < n_alpha || q >= 2 * n_alpha) blend_row(frame->inner, theta, first + from, last + from, target);
            else
                blend_density(frame->inner, theta, first + from, last + from, first + from - back, last + from - back,
                              target);
        }
}

static void frame_coarse(const struct frame_source *source, unsigned index, const struct frame *frame, int side,
                         size_t pitch, double *w)
{
    const struct link_face *face = &source->link->faces[index];
    int to = side ? (int)frame->n : -(int)frame->ghosts;
    for (unsigned i = 0; i < source->n_field; i++) {
        unsigned q = frame_field(source, i);
        frame_copy_strip(source, face, q, frame, to, w + q * pitch);
    }
}

static void frame_side(const struct frame_source *source, unsigned local, const struct frame *frame, int side,
                       size_t pitch, double *w)
{
    const struct neighbour *neighbour = &source->level->neighbours[local][2 * frame->axis + side];
    if (neighbour->kind == NEIGHBOUR_COARSE && source->link) {
        frame_coarse(source, neighbour->index, frame, side, pitch, w);
        return;
    }
    if (neighbour->kind == NEIGHBOUR_BOUNDARY || neighbour->kind == NEIGHBOUR_COARSE) {
        source->boundary(source->data, local, frame, side, pitch, w);
        return;
    }
    bool remote = neighbour->kind == NEIGHBOUR_REMOTE;
    size_t depth = remote ? frame->ghosts : frame->n, from = remote || side ? 0 : frame->n - frame->ghosts;
    size_t block = remote ? frame->tile_outer * frame->ghosts * frame->tile_inner : source->mesh->n_cell;
    const double *data = remote ? halo_slab(source->halo, neighbour->index) : source->arrays[neighbour->index];
    int to = side ? (int)frame->n : -(int)frame->ghosts;
    for (unsigned i = 0; i < source->n_field; i++) {
        unsigned q = frame_field(source, i);
        frame_copy(frame, data + q * block, depth, from, to, frame->ghosts, w + q * pitch);
    }
}

void frame_gather(const struct frame_source *source, unsigned local, const struct frame *frame, size_t pitch, double *w)
{
    const double *own = source->arrays[local];
    for (unsigned i = 0; i < source->n_field; i++) {
        unsigned q = frame_field(source, i);
        frame_copy(frame, own + q * source->mesh->n_cell, frame->n, 0, 0, frame->n, w + q * pitch);
    }
    for (int side = 0; side < 2; side++) frame_side(source, local, frame, side, pitch, w);
}

void frame_place(const struct frame *frame, const struct mesh *mesh, const struct level *level, const struct tile *tile,
                 int side, size_t c, double ret_x[3])
{
    size_t o = frame->outer_from + c / frame->inner, i = frame->inner_from + c % frame->inner;
    size_t below = 1, at[3];
    mesh_corner(mesh, level, tile, ret_x);
    for (int d = 0; d < 3; d++) {
        if (d == frame->axis) {
            below = 1;
            continue;
        }
        size_t index = d < frame->axis ? i : o;
        at[d] = index / below % (size_t)mesh->n[d];
        below *= (size_t)mesh->n[d];
        ret_x[d] += d < mesh->dim ? ((double)at[d] + 0.5) * level->h[d] : 0.0;
    }
    ret_x[frame->axis] = side ? mesh->upper[frame->axis] : mesh->lower[frame->axis];
}
