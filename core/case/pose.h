/* pose.h - where a rigid body is at a time: it is turned about a point of it, then moved. */
#ifndef POSE_H
#define POSE_H

#include "case/scene.h"

struct pose {
    double shift[3];   /* [m] */
    double turn[3][3]; /* about `pivot`; the identity unless `turned` */
    double pivot[3];   /* before it is moved */
    bool turned;
    double angle; /* [rad] */
};

/* The pose of a body at time t [s]. A script's failure is STATUS_CASE. */
int pose_at(const struct scene_rigid *rigid, double t, struct pose *ret);

/* Where a point of space is on the body at rest: the inverse of the motion. */
void pose_back(const struct pose *pose, const double x[3], double ret[3]);

/* How far a point of space that moves with the body goes from one pose to the other [m]. */
void pose_way(const struct pose *from, const struct pose *to, const double x[3], double ret[3]);

/* A pose, and those a little later that tell how fast a body goes: exactly where its velocity is given, else as
 * one-sided differences of second order over scene_rigid.brief; functions of the time alone. */
struct pose_rate {
    struct pose now, soon, later;
};

/* At time t [s]; a script's failure is STATUS_CASE. */
int pose_rate_at(const struct scene_rigid *rigid, double t, struct pose_rate *ret);

/* Velocity of a point of space that moves with the body [m/s]. */
void pose_rate_way(const struct scene_rigid *rigid, const struct pose_rate *rate, const double x[3], double ret[3]);

/* No point of the body that is in the domain is faster [m/s]. */
double pose_rate_most(const struct scene_rigid *rigid, const struct pose_rate *rate);

#endif
