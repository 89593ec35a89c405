/* bound_layer.h - which layers of a frame lie behind a side, and which inside they are made from. */
#ifndef BOUND_LAYER_H
#define BOUND_LAYER_H

#include "mesh/metric.h"
#include "scheme/frame.h"

/* Layer `ghost` behind a side, counted from it (0, 1), and the layer inside that mirrors it. */
static inline int bound_layer_behind(const struct frame *frame, int side, int ghost)
{
    return side ? (int)frame->n + ghost : -1 - ghost;
}

static inline int bound_layer_inside(const struct frame *frame, int side, int ghost)
{
    return side ? (int)frame->n - 1 - ghost : ghost;
}

/* What turns goes on behind a mirror across the radius as a whole, with the same u_th/r, so that it bears no shear
 * there: the radius behind it over that before it. */
static inline double bound_layer_lever(const struct mesh *mesh, const struct level *level, int side)
{
    double wall = side ? mesh->upper[0] : mesh->lower[0], inside = side ? wall - level->h[0] : wall + level->h[0];
    double r = metric_centroid(1, side ? inside : wall, side ? wall : inside);
    return (2.0 * wall - r) / r;
}

/* Fills the layers behind a side with those inside times `factor`: mirrored, or all with the outermost one. */
static inline void bound_layer_fill(const struct frame *frame, int side, bool mirror, double factor, double *w)
{
    for (int ghost = 0; ghost < (int)frame->ghosts; ghost++)
        for (size_t o = 0; o < frame->outer; o++) {
            double *to = w + frame_at(frame, o, bound_layer_behind(frame, side, ghost));
            const double *from = w + frame_at(frame, o, bound_layer_inside(frame, side, mirror ? ghost : 0));
            for (size_t i = 0; i < frame->inner; i++) to[i] = factor * from[i];
        }
}

#endif
