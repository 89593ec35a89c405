/* phase_rate.c - see phase_rate.h. */
#include "phys/phase_rate.h"

#include <math.h>

enum { PHASE_RATE_ROUNDS = 100 };

#define PHASE_RATE_PI 3.14159265358979323846

/* dm_v/dt at a solved point; liquid in tension without vapour: as fast as can be. */
static double phase_rate_flux(const struct equilibrium_point *point, const struct scene_phase *scene)
{
    const double *h = point->h, *s = point->s;
    double T = point->T, RT = point->family->R[EQUILIBRIUM_VAPOUR] * T, part = scene->accommodation;
    double K = 2.0 * part / (2.0 - part) / sqrt(2.0 * PHASE_RATE_PI * RT);
    double drive = h[EQUILIBRIUM_VAPOUR] - h[EQUILIBRIUM_LIQUID] - T * (s[EQUILIBRIUM_VAPOUR] - s[EQUILIBRIUM_LIQUID]);
    if (!(point->p > 0.0)) return HUGE_VAL;
    return scene->area * K * point->p * (exp(-drive / RT) - equilibrium_point_share(point));
}

/* m - before - dt dm_v/dt, which grows with m. */
static double phase_rate_excess(struct equilibrium_point *point, const struct scene_phase *scene, double all,
                                double before, double dt, double m)
{
    point->m[EQUILIBRIUM_VAPOUR] = m;
    point->m[EQUILIBRIUM_LIQUID] = all - m;
    if (!equilibrium_point_solve(point)) return HUGE_VAL; /* too much vapour for the energy */
    return m - before - dt * phase_rate_flux(point, scene);
}

/* Regula falsi of Illinois between the ends, bisection where that cannot be told. */
double phase_rate_step(struct equilibrium_point *point, const struct scene_phase *scene, double before, double after,
                       double dt)
{
    double all = point->m[EQUILIBRIUM_LIQUID] + point->m[EQUILIBRIUM_VAPOUR];
    double low = before < after ? before : after, high = before < after ? after : before;
    double f_low = phase_rate_excess(point, scene, all, before, dt, low),
           f_high = phase_rate_excess(point, scene, all, before, dt, high);
    if (!(f_low < 0.0)) return low;
    if (!(f_high > 0.0)) return high;
    for (int i = 0; i < PHASE_RATE_ROUNDS && high - low > 1e-15 * high; i++) {
        double m = (low * f_high - high * f_low) / (f_high - f_low);
        if (!(m > low && m < high)) m = 0.5 * (low + high);
        double f = phase_rate_excess(point, scene, all, before, dt, m);
        if (f == 0.0 || m == low || m == high) return m;
        if (f > 0.0) {
            f_low *= 0.5;
            high = m;
            f_high = f;
        } else {
            f_high *= 0.5;
            low = m;
            f_low = f;
        }
    }
    return 0.5 * (low + high);
}
