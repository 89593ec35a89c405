/* source_weight.c - see source_weight.h. */
#include "scheme/source_weight.h"

#include "case/scene_boundary.h"
#include "phys/row.h"
#include "scheme/bound_layer.h"

#include <string.h>

bool source_weight_any(const struct scene *scene, int axis)
{
    return scene->sources && scene->sources->value[SCENE_SOURCE_ACCELERATION + axis].given;
}

/* G/2 = rho a h/2 of a row of cells. */
static BULLA_KERNEL void source_weight_half(size_t n, double h, const double *restrict acceleration,
                                            const double *restrict rho, double *restrict half)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double r = rho[i], a = acceleration[i];
        half[i] = 0.5 * (r * a * h);
    }
}

/* Density of n cells. */
static void source_weight_density(const struct model *model, size_t n, size_t pitch, const double *w, double *rho)
{
    const double *rho_l = w + model->i_m * pitch;
    if (!model->n_alpha) memcpy(rho, rho_l, n * sizeof *rho);
    else memset(rho, 0, n * sizeof *rho);
    for (unsigned l = 0; l < model->n_alpha; l++)
        row_add_product(n, w + (model->i_alpha + l) * pitch, rho_l + l * pitch, rho);
}

/* What the cells of a piece w hold, from <= i < to along its axis. */
static void source_weight_cells(struct source_value *values, const struct source_value_place *place,
                                const struct frame *frame, int from, int to, size_t pitch, const double *w,
                                double *half)
{
    double rho[FACE_ROOM], acceleration[FACE_ROOM];
    source_weight_density(values->path, frame->count, pitch, w, rho);
    source_value_frame(values, place, frame, from, to, acceleration);
    source_weight_half(frame->count, place->level->h[frame->axis], acceleration, rho, half);
}

/* Where p in the layers behind a boundary comes from: from the layer inside that each mirrors, from the outermost one,
 * or from the face. */
enum source_weight_start { SOURCE_WEIGHT_MIRRORED, SOURCE_WEIGHT_COPIED, SOURCE_WEIGHT_BROUGHT };

static enum source_weight_start source_weight_start(const struct scene *scene, int face)
{
    if (scene_boundary_is(scene, face, SCENE_BOUNDARY_BRINGS)) return SOURCE_WEIGHT_BROUGHT;
    bool mirrors =
        scene_boundary_is(scene, face, SCENE_BOUNDARY_RESTS) && !scene_boundary_is(scene, face, SCENE_BOUNDARY_OPEN);
    return mirrors ? SOURCE_WEIGHT_MIRRORED : SOURCE_WEIGHT_COPIED;
}

/* Layer k from a boundary: behind it from 0 on, inside from -1 down. */
static int source_weight_at(const struct frame *frame, int side, int k)
{
    return k < 0 ? bound_layer_inside(frame, side, -1 - k) : bound_layer_behind(frame, side, k);
}

/* What p has gained up to a layer behind a boundary. */
static void source_weight_layer(const struct frame *frame, int side, int ghost, enum source_weight_start start,
                                const double *half, double *p)
{
    int first = start == SOURCE_WEIGHT_MIRRORED ? -1 - ghost : start == SOURCE_WEIGHT_COPIED ? -1 : 0;
    for (size_t o = 0; o < frame->outer; o++)
        for (size_t i = 0; i < frame->inner; i++) {
            const double *of = half + i;
            double sum = first < 0 ? 0.0 : of[frame_at(frame, o, source_weight_at(frame, side, 0))];
            for (int k = first; k < ghost; k++)
                sum += of[frame_at(frame, o, source_weight_at(frame, side, k))] +
                       of[frame_at(frame, o, source_weight_at(frame, side, k + 1))];
            p[frame_at(frame, o, bound_layer_behind(frame, side, ghost)) + i] += side ? sum : -sum;
        }
}

void source_weight_continue(struct source_value *values, const struct source_value_place *place,
                            const struct frame *frame, int side, size_t pitch, double *w)
{
    const struct model *path = values->path;
    enum source_weight_start start = source_weight_start(path->scene, 2 * frame->axis + side);
    int n = (int)frame->n, ghosts = (int)frame->ghosts;
    double half[FACE_ROOM];
    if (!source_weight_any(path->scene, frame->axis)) return;
    source_weight_cells(values, place, frame, side ? n - ghosts : -ghosts, side ? n + ghosts : ghosts, pitch, w, half);
    for (int ghost = 0; ghost < ghosts; ghost++)
        source_weight_layer(frame, side, ghost, start, half, w + path->i_E * pitch);
}

void source_weight_frame(struct source_value *values, const struct term_piece *piece)
{
    const struct frame *frame = piece->frame;
    const struct term_tile *tile = piece->tile;
    const struct source_value_place place = {tile->level, tile->tile, tile->t, frame->axis};
    struct face_work *faces = piece->faces;
    double half[FACE_ROOM];
    if (!source_weight_any(piece->model->scene, frame->axis)) return;
    source_weight_cells(values, &place, frame, -(int)frame->ghosts, (int)(frame->n + frame->ghosts), FACE_ROOM,
                        faces->frame, half);
    face_rise(faces, frame, half, half);
}
