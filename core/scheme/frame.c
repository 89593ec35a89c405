/* frame.c - gathering, see frame.h. */
#include "scheme/frame.h"

#include "bulla/module.h"
#include "mesh/link.h"
#include "phys/row.h"
#include "scheme/blend.h"

#include <string.h>

static size_t frame_cut(size_t whole, size_t piece)
{
    return (whole + piece - 1) / piece;
}

/* The first piece. The whole tile, if it fits, which takes no division: small tiles are many. Else slices, or parts of
 * one, as many as fit and then equal in number, so that no short piece is left over. */
static struct frame frame_first(const struct mesh *mesh, int axis)
{
    struct frame frame = {
        .axis = axis, .n = (size_t)mesh->n[axis], .ghosts = (size_t)mesh->ghosts, .tile_inner = 1, .tile_outer = 1};
    for (int d = 0; d < axis; d++) frame.tile_inner *= (size_t)mesh->n[d];
    for (int d = axis + 1; d < mesh->dim; d++) frame.tile_outer *= (size_t)mesh->n[d];
    size_t length = frame_layers(&frame);
    frame.inner = frame.tile_inner;
    frame.outer = frame.tile_outer;
    frame.count = frame.outer * length * frame.inner;
    if (frame.count <= FRAME_CELLS) return frame;
    while (frame.inner * length > FRAME_CELLS) frame.inner = (frame.inner + 1) / 2;
    size_t most = FRAME_CELLS / (length * frame.inner);
    frame.outer = frame_cut(frame.tile_outer, frame_cut(frame.tile_outer, most));
    return frame;
}

size_t frame_pieces(const struct mesh *mesh, int axis)
{
    struct frame frame = frame_first(mesh, axis);
    if (frame.count <= FRAME_CELLS) return 1;
    return frame_cut(frame.tile_outer, frame.outer) * frame_cut(frame.tile_inner, frame.inner);
}

struct frame frame_piece(const struct mesh *mesh, int axis, size_t index)
{
    struct frame frame = frame_first(mesh, axis);
    if (frame.count <= FRAME_CELLS) return frame;
    size_t across = frame_cut(frame.tile_inner, frame.inner);
    frame.outer_from = index / across * frame.outer;
    frame.inner_from = index % across * frame.inner;
    if (frame.outer > frame.tile_outer - frame.outer_from) frame.outer = frame.tile_outer - frame.outer_from;
    if (frame.inner > frame.tile_inner - frame.inner_from) frame.inner = frame.tile_inner - frame.inner_from;
    frame.count = frame.outer * frame_layers(&frame) * frame.inner;
    return frame;
}

struct frame_runs frame_runs(const struct frame *frame)
{
    if (frame->inner == frame->tile_inner) /* the rows of an outer slice follow each other */
        return (struct frame_runs){.count = frame->outer,
                                   .n = frame->n * frame->inner,
                                   .row = frame_layers(frame) * frame->inner,
                                   .tile = frame->n * frame->tile_inner};
    return (struct frame_runs){.count = frame->n,
                               .n = frame->inner,
                               .row = frame->inner,
                               .tile = frame->tile_inner}; /* one slice */
}

/* Copies a few: read before any is written, so that compilers take whole vectors, where memcpy takes halves. */
enum { FRAME_FEW = 16 };
static inline void frame_few(const double *restrict source, double *restrict target)
{
    double few[FRAME_FEW];
    for (size_t i = 0; i < FRAME_FEW; i++) few[i] = source[i];
    for (size_t i = 0; i < FRAME_FEW; i++) target[i] = few[i];
}

/* Copies a row; short rows, the usual case, without a call. */
static inline void frame_row(size_t n, const double *restrict source, double *restrict target)
{
    size_t i = 0;
    for (; i + FRAME_FEW <= n; i += FRAME_FEW) frame_few(source + i, target + i);
    for (; i + 4 <= n; i += 4) memcpy(target + i, source + i, 4 * sizeof *target);
    for (; i < n; i++) target[i] = source[i];
}

/* Rows of slices: how many, how long, and how far apart they are where they come from and where they go. */
struct frame_rows {
    size_t slices, rows, length;
    size_t from_slice, from_row, to_slice, to_row;
};

static BULLA_KERNEL void frame_rows(const struct frame_rows *all, const double *source, double *target)
{
    size_t length = all->length;
    for (size_t o = 0; o < all->slices; o++, source += all->from_slice, target += all->to_slice) {
        const double *from = source;
        double *to = target;
        for (size_t row = 0; row < all->rows; row++, from += all->from_row, to += all->to_row)
            frame_row(length, from, to);
    }
}

/* `layers` layers of every outer slice, from a block whose slices have `depth` layers, starting
 * at layer `from`, to frame layer `to`. */
static void frame_copy(const struct frame *frame, const double *block, size_t depth, size_t from, int to, size_t layers,
                       double *w)
{
    bool whole = frame->inner == frame->tile_inner; /* then the layers of a slice follow each other */
    const struct frame_rows all = {.slices = frame->outer,
                                   .rows = whole ? 1 : layers,
                                   .length = whole ? layers * frame->inner : frame->inner,
                                   .from_slice = depth * frame->tile_inner,
                                   .from_row = frame->tile_inner,
                                   .to_slice = frame_layers(frame) * frame->inner,
                                   .to_row = frame->inner};
    frame_rows(&all, block + (frame->outer_from * depth + from) * frame->tile_inner + frame->inner_from,
               w + frame_at(frame, 0, to));
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

/* Cells that layers are read from: blocks of one component each, [outer][depth][inner], the first layer at `from`. */
struct frame_cells {
    const double *data;
    size_t block, depth, from;
};

/* What lies behind a side: cells of this rank or of another one. False: neither. */
static bool frame_behind(const struct frame_source *source, unsigned local, const struct frame *frame, int side,
                         struct frame_cells *ret_cells)
{
    const struct neighbour *neighbour = &source->level->neighbours[local][2 * frame->axis + side];
    if (neighbour->kind == NEIGHBOUR_BOUNDARY || neighbour->kind == NEIGHBOUR_COARSE) return false;
    bool remote = neighbour->kind == NEIGHBOUR_REMOTE;
    *ret_cells = (struct frame_cells){.data = remote ? halo_slab(source->halo, neighbour->index)
                                                     : source->arrays[neighbour->index],
                                      .block = remote ? frame->tile_outer * frame->ghosts * frame->tile_inner
                                                      : source->mesh->n_cell,
                                      .depth = remote ? frame->ghosts : frame->n,
                                      .from = remote || side ? 0 : frame->n - frame->ghosts};
    return true;
}

/* Lines one after the other: layers, own cells, layers, each from lines `depth` apart. Inlined with its numbers, a line
 * takes a dozen instructions. */
static inline void frame_lines_of(size_t count, size_t n, size_t ghosts, const double *const from[3],
                                  const size_t depth[3], double *restrict w)
{
    for (size_t o = 0; o < count; o++, w += n + 2 * ghosts) {
        const double *below = from[0] + o * depth[0], *above = from[2] + o * depth[2];
        memcpy(w, below, ghosts * sizeof *w);
        frame_row(n, from[1] + o * depth[1], w + ghosts);
        memcpy(w + ghosts + n, above, ghosts * sizeof *w);
    }
}

/* Along axis 0 a line is whole: its cells and the layers on both sides at once, instead of three copies of few
 * cells. */
static BULLA_KERNEL void frame_lines(const struct frame *frame, unsigned q, const struct frame_cells cells[3],
                                     double *w)
{
    const double *from[3];
    size_t depth[3], count = frame->outer, n = frame->n;
    for (int k = 0; k < 3; k++) {
        depth[k] = cells[k].depth;
        from[k] = cells[k].data + q * cells[k].block + frame->outer_from * depth[k] + cells[k].from;
    }
    if (frame->ghosts == 2 && n == 8) frame_lines_of(count, 8, 2, from, depth, w);
    else if (frame->ghosts == 2 && n == 16) frame_lines_of(count, 16, 2, from, depth, w);
    else if (frame->ghosts == 2) frame_lines_of(count, n, 2, from, depth, w);
    else frame_lines_of(count, n, frame->ghosts, from, depth, w);
}

/* The layers of a side that is no cells. */
static void frame_beyond(const struct frame_source *source, unsigned local, const struct frame *frame, int side,
                         size_t pitch, double *w)
{
    const struct neighbour *neighbour = &source->level->neighbours[local][2 * frame->axis + side];
    if (neighbour->kind == NEIGHBOUR_COARSE && source->link)
        frame_coarse(source, neighbour->index, frame, side, pitch, w);
    else source->boundary(source->data, local, frame, side, pitch, w);
}

void frame_gather(const struct frame_source *source, unsigned local, const struct frame *frame, size_t pitch, double *w)
{
    struct frame_cells own = {source->arrays[local], source->mesh->n_cell, frame->n, 0}, cells[3] = {own, own, own};
    bool behind[2];
    for (int side = 0; side < 2; side++) behind[side] = frame_behind(source, local, frame, side, &cells[2 * side]);
    for (unsigned i = 0; i < source->n_field; i++) {
        unsigned q = frame_field(source, i);
        double *row = w + q * pitch;
        if (frame->axis == 0) {
            frame_lines(frame, q, cells, row); /* of a side that is no cells its own, until they are replaced */
            continue;
        }
        frame_copy(frame, own.data + q * own.block, own.depth, 0, 0, frame->n, row);
        for (int side = 0; side < 2; side++) {
            const struct frame_cells *from = &cells[2 * side];
            if (!behind[side]) continue;
            frame_copy(frame, from->data + q * from->block, from->depth, from->from,
                       side ? (int)frame->n : -(int)frame->ghosts, frame->ghosts, row);
        }
    }
    for (int side = 0; side < 2; side++)
        if (!behind[side]) frame_beyond(source, local, frame, side, pitch, w);
}

/* The layers behind a side, if they are cells of this rank. */
static void frame_foresee_side(const struct frame_source *source, unsigned local, const struct frame *frame, int side)
{
    struct frame_cells cells;
    if (source->level->neighbours[local][2 * frame->axis + side].kind != NEIGHBOUR_LOCAL) return;
    frame_behind(source, local, frame, side, &cells);
    for (unsigned i = 0; i < source->n_field; i++)
        row_ask(frame->tile_outer, frame->n * frame->tile_inner, frame->ghosts * frame->tile_inner,
                cells.data + frame_field(source, i) * cells.block + cells.from * frame->tile_inner);
}

void frame_foresee(const struct frame_source *source, unsigned local)
{
    const struct mesh *mesh = source->mesh;
    for (unsigned i = 0; i < source->n_field; i++)
        row_ask(1, 0, mesh->n_cell, source->arrays[local] + frame_field(source, i) * mesh->n_cell);
    for (int axis = 0; axis < mesh->dim; axis++) {
        struct frame frame = frame_first(mesh, axis);
        for (int side = 0; side < 2; side++) frame_foresee_side(source, local, &frame, side);
    }
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
