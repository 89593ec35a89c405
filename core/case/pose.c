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
    *ret = (struct pose){.turn = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, .turned = rigid->angle.given};
    memcpy(ret->pivot, rigid->pivot, sizeof ret->pivot);
    for (int d = 0; d < SCENE_AXES; d++)
        TRY(pose_value(&rigid->displacement[d], rigid->velocity[d], t, &ret->shift[d]));
    if (!ret->turned) return STATUS_OK;
    TRY(pose_value(&rigid->angle, 0.0, t, &ret->angle));
    ret->turn[0][0] = ret->turn[1][1] = cos(ret->angle);
    ret->turn[1][0] = sin(ret->angle);
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

int pose_rate_at(const struct scene_rigid *rigid, double t, struct pose_rate *ret)
{
    TRY(pose_at(rigid, t, &ret->now));
    TRY(pose_at(rigid, t + rigid->brief, &ret->soon));
    return pose_at(rigid, t + 2.0 * rigid->brief, &ret->later);
}

/* Does a script move it? */
static bool pose_is_driven(const struct scene_rigid *rigid)
{
    bool driven = rigid->angle.given;
    for (int d = 0; d < SCENE_AXES; d++) driven = driven || rigid->displacement[d].given;
    return driven;
}

void pose_rate_way(const struct scene_rigid *rigid, const struct pose_rate *rate, const double x[3], double ret[3])
{
    double once[3], twice[3];
    memcpy(ret, rigid->velocity, 3 * sizeof *ret);
    if (!pose_is_driven(rigid)) return;
    pose_way(&rate->now, &rate->soon, x, once);
    pose_way(&rate->now, &rate->later, x, twice);
    for (int d = 0; d < 3; d++) ret[d] = (4.0 * once[d] - twice[d]) / (2.0 * rigid->brief);
}

double pose_rate_most(const struct scene_rigid *rigid, const struct pose_rate *rate)
{
    double pivot[3], u[3], spin = 0.0;
    for (int d = 0; d < 3; d++) pivot[d] = rate->now.pivot[d] + rate->now.shift[d];
    pose_rate_way(rigid, rate, pivot, u);
    for (int d = 0; d < 2; d++)
        spin = hypot(spin, 4.0 * (rate->soon.turn[d][0] - rate->now.turn[d][0]) -
                               (rate->later.turn[d][0] - rate->now.turn[d][0]));
    return sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]) + spin / (2.0 * rigid->brief) * rigid->reach;
}
