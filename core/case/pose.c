/* pose.c - see pose.h. */
#include "case/pose.h"

#include "base/status.h"

#include <math.h>
#include <string.h>

/* A value of time alone; `constant` per second where it is not given. */
static int pose_value(const struct scene_value *value, double constant, double t, double *ret)
{
    static const double origin[SCENE_AXES];
    *ret = constant * t;
    return value->given ? scene_value_at(value, origin, 0.0, t, ret) : STATUS_OK;
}

int pose_at(const struct scene_rigid *rigid, double t, struct pose *ret)
{
    double angle;
    *ret = (struct pose){.turn = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, .turned = rigid->angle.given};
    memcpy(ret->pivot, rigid->pivot, sizeof ret->pivot);
    for (int d = 0; d < SCENE_AXES; d++)
        TRY(pose_value(&rigid->displacement[d], rigid->velocity[d], t, &ret->shift[d]));
    if (!ret->turned) return STATUS_OK;
    TRY(pose_value(&rigid->angle, 0.0, t, &angle));
    ret->turn[0][0] = ret->turn[1][1] = cos(angle);
    ret->turn[1][0] = sin(angle);
    ret->turn[0][1] = -ret->turn[1][0];
    return STATUS_OK;
}

void pose_back(const struct pose *pose, const double x[3], double ret[3])
{
    double y[3];
    for (int d = 0; d < 3; d++) ret[d] = x[d] - pose->shift[d];
    if (!pose->turned) return;
    for (int d = 0; d < 3; d++) y[d] = ret[d] - pose->pivot[d];
    for (int d = 0; d < 3; d++) {
        ret[d] = pose->pivot[d];
        for (int e = 0; e < 3; e++) ret[d] += pose->turn[e][d] * y[e];
    }
}

void pose_way(const struct pose *from, const struct pose *to, const double x[3], double ret[3])
{
    double rest[3];
    for (int d = 0; d < 3; d++) ret[d] = to->shift[d] - from->shift[d];
    if (!to->turned) return;
    pose_back(from, x, rest);
    for (int d = 0; d < 3; d++) {
        ret[d] = to->pivot[d] + to->shift[d] - x[d];
        for (int e = 0; e < 3; e++) ret[d] += to->turn[d][e] * (rest[e] - to->pivot[e]);
    }
}
