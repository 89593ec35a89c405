/* bound_ahead.c - see bound_ahead.h. The layer is filled as a stage would, from the cells next to it alone. */
#include "scheme/bound_ahead.h"

#include "base/mem.h"
#include "base/status.h"
#include "scheme/bound_layer.h"

#include <string.h>

bool bound_ahead_is(const struct bound *bound, unsigned local, int face)
{
    return bound->level->neighbours[local][face].kind == NEIGHBOUR_BOUNDARY &&
           scene_boundary_is(bound->model->scene, face, SCENE_BOUNDARY_DRIVES);
}

/* Slices of one layer: a row of the tile or of a frame to the other. */
static void bound_ahead_copy(const struct frame *frame, const double *from, size_t from_slice, double *to,
                             size_t to_slice)
{
    for (size_t o = 0; o < frame->outer; o++)
        memcpy(to + o * to_slice, from + o * from_slice, frame->inner * sizeof *to);
}

void bound_ahead_row(struct bound *bound, unsigned local, const struct frame *frame, int side, const double *w,
                     size_t pitch, double *space, double *row)
{
    const struct model *model = bound->model;
    size_t n = frame->outer * frame->inner, slice = frame_layers(frame) * frame->inner;
    size_t tile_slice = frame->n * frame->tile_inner, n_cell = bound->mesh->n_cell;
    int inside = bound_layer_inside(frame, side, 0), behind = bound_layer_behind(frame, side, 0);
    bool failed = bound->status != STATUS_OK;
    for (unsigned q = 0; q < model->n_field; q++)
        bound_ahead_copy(frame, w + q * n_cell + frame_tile_at(frame, 0, (size_t)inside), tile_slice,
                         space + q * pitch + frame_at(frame, 0, inside), slice);
    bound_fill(bound, local, frame, side, pitch, space);
    for (unsigned q = 0; q < model->n_field; q++)
        bound_ahead_copy(frame, space + q * pitch + frame_at(frame, 0, behind), slice, row + q * n, frame->inner);
    if (failed || !bound->status) return;
    mem_free(bound->message);
    bound->message = NULL;
    bound->status = STATUS_OK;
}
