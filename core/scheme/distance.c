/* distance.c - see distance.h. */
#include "scheme/distance.h"

#include <string.h>

/* One over the distances of cells along a curved axis. */
static void distance_stretch(const struct term_tile *tile, const struct frame *frame, double *per_d)
{
    const struct mesh *mesh = tile->mesh;
    double h = tile->level->h[0], lower = mesh->lower[0], below, row[METRIC_CELLS + 1];
    int first = tile->tile->at[0] * mesh->n[0];
    below = metric_centroid(mesh->beta, lower + (first - 1) * h, lower + first * h);
    for (int i = 0; i <= mesh->n[0]; i++) {
        double here = metric_centroid(mesh->beta, lower + (first + i) * h, lower + (first + i + 1) * h);
        row[i] = 1.0 / (here - below);
        below = here;
    }
    if (first == 0 && lower == 0.0) row[0] = 1.0 / h; /* the axis: nothing goes through it */
    for (size_t o = 0; o < frame->outer; o++) memcpy(per_d + face_at(frame, o, 0), row, (frame->n + 1) * sizeof *row);
}

bool distance_ends(const struct term_piece *piece, int side)
{
    const struct term_tile *tile = piece->tile;
    int axis = piece->frame->axis, last = tile->level->extent[axis] - 1;
    return tile->tile->at[axis] == (side ? last : 0) &&
           !scene_boundary_is(piece->model->scene, 2 * axis + side, SCENE_BOUNDARY_WRAPS);
}

/* Mirrors and copies let nothing through by themselves. Behind other boundaries than inflows there are states of
 * waves. */
static void distance_close(const struct term_piece *piece, int side, double *per_d)
{
    const struct frame *frame = piece->frame;
    int face = 2 * frame->axis + side;
    if (!distance_ends(piece, side) || !scene_boundary_is(piece->model->scene, face, SCENE_BOUNDARY_REFERS)) return;
    for (size_t o = 0; o < frame->outer; o++)
        memset(per_d + face_at(frame, o, side ? frame->n : 0), 0, frame->inner * sizeof *per_d);
}

void distance_faces(const struct term_piece *piece, double *per_d)
{
    const struct term_tile *tile = piece->tile;
    size_t n = piece->faces->faces.n;
    double per_h = 1.0 / tile->level->h[piece->frame->axis];
    for (size_t i = 0; i < n; i++) per_d[i] = per_h;
    if (tile->model->beta && piece->frame->axis == 0) distance_stretch(tile, piece->frame, per_d);
    for (int side = 0; side < 2; side++) distance_close(piece, side, per_d);
}

double distance_squares(const struct level *level, int dim)
{
    double sum = 0.0;
    for (int d = 0; d < dim; d++) sum += 1.0 / (level->h[d] * level->h[d]);
    return sum;
}
