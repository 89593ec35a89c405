/* conduction_wall.c - see conduction_wall.h. Few faces: one at a time. */
#include "scheme/conduction_wall.h"

#include "base/mem.h"
#include "base/status.h"
#include "scheme/conduction_channel.h"
#include "scheme/conduction_law.h"

#include <math.h>
#include <stdio.h>

/* From the centroid of the cells at a wall to the wall. */
static double conduction_wall_distance(const struct term_piece *piece, int side)
{
    const struct mesh *mesh = piece->tile->mesh;
    double h = piece->tile->level->h[piece->frame->axis];
    if (!mesh->beta || piece->frame->axis) return 0.5 * h;
    double wall = side ? mesh->upper[0] : mesh->lower[0];
    return side ? wall - metric_centroid(mesh->beta, wall - h, wall)
                : metric_centroid(mesh->beta, wall, wall + h) - wall;
}

/* A value at the middle of a face; NaN where its script fails. */
static double conduction_wall_value(const struct term_piece *piece, int side, size_t c, const struct scene_value *value,
                                    struct conduction_wall_fault *fault)
{
    const struct term_tile *tile = piece->tile;
    double x[3], got;
    frame_place(piece->frame, tile->mesh, tile->level, tile->tile, side, c, x);
    int status = scene_value_at(value, x, x[0], tile->t, &got);
    if (!status) return got;
    if (fault->status) return (double)NAN;
    fault->status = status;
    fault->message = mem_text(status_text());
    snprintf(fault->place, sizeof fault->place, "heat of the wall at (%.9g, %.9g, %.9g) m", x[0], x[1], x[2]);
    return (double)NAN;
}

/* What a wall of temperature T gives to material l in cell i [W/m2]. */
static double conduction_wall_warm(const struct term_piece *piece, const struct conduction_wall_cells *cells,
                                   unsigned l, size_t i, double T, double d)
{
    const struct model *path = piece->model;
    size_t at = l * (size_t)FACE_ROOM + i;
    const double *w = piece->faces->frame + frame_reach(piece->frame) + i;
    double part = cells->part[at], own = cells->T[at], mean = 0.5 * (T + own), k;
    if (!(part > 0.0) || !conduction_law_is(path, l)) return 0.0;
    conduction_law_ask(path, l, 1, &mean, w + path->i_E * FACE_ROOM, w + (path->i_m + l) * FACE_ROOM, &k);
    double most = cells->c && !(cells->sets[at] > 0.0) ? 0.5 * cells->most * cells->c[at] : k;
    return part * (k < most ? k : most) * (T - own) / d;
}

/* Flux `f` gets heat q of material l along the axis. */
static void conduction_wall_give(const struct term_piece *piece, unsigned l, size_t f, double q)
{
    struct face_work *faces = piece->faces;
    faces->energy[f] += q;
    if (!piece->model->n_alpha) return;
    faces->heat_below[l * FACE_ROOM + f] += q;
    faces->heat_above[l * FACE_ROOM + f] += q;
}

void conduction_wall_add(const struct term_piece *piece, int side, const struct conduction_wall_cells *cells,
                         struct conduction_wall_fault *fault)
{
    const struct model *path = piece->model;
    const struct frame *frame = piece->frame;
    const struct scene_boundary *wall = &path->scene->domain.boundary[frame->axis][side];
    bool warm = wall->temperature.given;
    double d = conduction_wall_distance(piece, side), along = side ? -1.0 : 1.0;
    for (size_t c = 0; c < frame->outer * frame->inner; c++) {
        size_t f = face_at(frame, c / frame->inner, side ? frame->n : 0) + c % frame->inner;
        size_t i = side ? f : f + frame->inner; /* the cell inside */
        double value = conduction_wall_value(piece, side, c, warm ? &wall->temperature : &wall->heat_flux, fault);
        for (unsigned l = 0; l < path->n_material; l++)
            conduction_wall_give(piece, l, f,
                                 along * (warm ? conduction_wall_warm(piece, cells, l, i, value, d)
                                               : cells->part[l * FACE_ROOM + i] * value));
    }
}
