/* tube.h - the Riemann problem that a scene paints: what `reference: exact-riemann` solves. */
#ifndef TUBE_H
#define TUBE_H

#include "case/scene.h"
#include "judge/exact.h"

struct tube {
    struct exact exact;
    double x0;       /* where the two states meet [m] */
    int material[2]; /* of the left and the right state */
};

/* Two uniform pure states that meet at one point of a 1D cartesian scene. Anything else is STATUS_CASE. */
int tube_of_scene(const struct scene *scene, struct tube *ret_tube);

#endif
