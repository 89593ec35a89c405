/* bodies.c - see bodies.h. */
#include "io/bodies.h"

#include "base/mem.h"
#include "case/pose.h"
#include "mesh/tally.h"
#include "scheme/cut.h"

#include <math.h>

double bodies_load(const struct state *state, int l, unsigned local, const struct scene_column *column, int axis)
{
    const struct mesh *mesh = state->mesh;
    const struct level *level = &mesh->levels[l];
    const struct tile *tile = &level->tiles[level->first + local];
    double *volume = mem_new(mesh->n_cell, sizeof *volume);
    tally_volumes(mesh, level, tile, volume);
    struct cut_force force = {
        .model = state->model, .mesh = mesh, .level = level, .tile = tile, .t = state->t, .w = level->w[local]};
    force.volume = volume;
    double sum = cut_force(&force, (unsigned)column->rigid, column->measure == SCENE_POWER ? CUT_POWER : axis);
    mem_free(volume);
    return sum;
}

/* How fast the pivot goes. */
static double bodies_speed(const struct scene_rigid *rigid, double t, int axis)
{
    struct pose_rate rate;
    double pivot[3], u[3];
    if (pose_rate_at(rigid, t, &rate)) return NAN;
    for (int d = 0; d < 3; d++) pivot[d] = rate.now.pivot[d] + rate.now.shift[d];
    pose_rate_way(rigid, &rate, pivot, u);
    return u[axis];
}

double bodies_motion(const struct state *state, const struct scene_column *column, int axis)
{
    const struct scene_rigid *rigid = &state->scene->rigids[column->rigid];
    struct pose pose;
    if (column->measure == SCENE_BODY_VELOCITY) return bodies_speed(rigid, state->t, axis);
    if (pose_at(rigid, state->t, &pose)) return NAN;
    return column->measure == SCENE_BODY_ANGLE ? pose.angle : pose.shift[axis];
}
