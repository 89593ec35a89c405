/* beam.c - see beam.h. */
#include "case/beam.h"

#include <math.h>

struct beam_ray beam_at(const struct scene_beam *beam, const double x[3])
{
    struct beam_ray ray = {.factor = 1.0};
    if (beam->path == SCENE_BEAM_NORMAL) return ray;
    double away[3], along = 0.0, square = 0.0;
    for (int d = 0; d < 3; d++) {
        away[d] = x[d] - beam->point[d];
        along += away[d] * beam->way[d];
        square += away[d] * away[d];
        ray.way[d] = beam->way[d];
    }
    if (beam->path == SCENE_BEAM_PLANE) {
        ray.later = along / beam->speed;
        return ray;
    }
    double r = sqrt(square);
    ray.later = (beam->radius - r) / beam->speed;
    ray.factor = r > 0.0 && -along >= beam->cosine * r ? pow(beam->radius / r, beam->power) : 0.0;
    if (r > 0.0) ray.near = beam->power * beam->speed / r;
    for (int d = 0; d < 3 && r > 0.0; d++) ray.way[d] = -away[d] / r;
    return ray;
}
