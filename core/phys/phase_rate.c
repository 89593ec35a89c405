/* phase_rate.c - see phase_rate.h. */
#include "phys/phase_rate.h"

#include "case/script.h"

#include <math.h>

enum { PHASE_RATE_ROUNDS = 100 };

#define PHASE_RATE_PI 3.14159265358979323846

/* What the search asks at each mass. */
struct phase_rate {
    const struct scene_phase *scene;
    double all, before, dt; /* both masses, that of the vapour, the step */
    int status;             /* of scripts */
};

/* Volume fraction of vapour and gases. */
static double phase_rate_thin(const struct equilibrium_point *point)
{
    double thin = 0.0;
    for (unsigned k = EQUILIBRIUM_VAPOUR; k < point->family->n; k++) thin += point->m[k] * point->v[k];
    return thin;
}

/* What a script says; 0 once it has failed. */
static double phase_rate_script(const struct equilibrium_point *point, double p_eq, struct phase_rate *rate)
{
    const double in[] = {point->p, point->T, p_eq, equilibrium_point_share(point), phase_rate_thin(point)};
    double flux = 0.0;
    if (!rate->status) rate->status = script_call(rate->scene->script, in, sizeof in / sizeof *in, &flux, 1);
    return rate->status ? 0.0 : flux;
}

/* dm_v/dt at a solved point; as fast as can be where a liquid is in tension, or the vapour denser than any. */
static double phase_rate_flux(const struct equilibrium_point *point, struct phase_rate *rate)
{
    const double *h = point->h, *s = point->s;
    double T = point->T, RT = point->family->R[EQUILIBRIUM_VAPOUR] * T, part = rate->scene->accommodation;
    double K = 2.0 * part / (2.0 - part) / sqrt(2.0 * PHASE_RATE_PI * RT);
    double drive = h[EQUILIBRIUM_VAPOUR] - h[EQUILIBRIUM_LIQUID] - T * (s[EQUILIBRIUM_VAPOUR] - s[EQUILIBRIUM_LIQUID]);
    if (!(point->p > 0.0)) return HUGE_VAL;
    if (isnan(drive)) return -HUGE_VAL;
    if (rate->scene->script) return phase_rate_script(point, point->p * exp(-drive / RT), rate);
    return rate->scene->area * K * point->p * (exp(-drive / RT) - equilibrium_point_share(point));
}

/* m - before - dt dm_v/dt, which grows with m. */
static double phase_rate_excess(struct equilibrium_point *point, struct phase_rate *rate, double m)
{
    point->m[EQUILIBRIUM_VAPOUR] = m;
    point->m[EQUILIBRIUM_LIQUID] = rate->all - m;
    if (!equilibrium_point_solve(point)) return HUGE_VAL; /* too much vapour for the energy */
    return m - rate->before - rate->dt * phase_rate_flux(point, rate);
}

/* Regula falsi of Illinois between the ends, bisection where that cannot be told. */
static double phase_rate_search(struct equilibrium_point *point, struct phase_rate *rate, double low, double high)
{
    double f_low = phase_rate_excess(point, rate, low), f_high = phase_rate_excess(point, rate, high);
    if (!(f_low < 0.0)) return low;
    if (!(f_high > 0.0)) return high;
    for (int i = 0; i < PHASE_RATE_ROUNDS && high - low > 1e-15 * high; i++) {
        double m = (low * f_high - high * f_low) / (f_high - f_low);
        if (!(m > low && m < high)) m = 0.5 * (low + high);
        double f = phase_rate_excess(point, rate, m);
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

double phase_rate_step(struct equilibrium_point *point, const struct scene_phase *scene, double before, double after,
                       double dt, int *ret_status)
{
    double all = point->m[EQUILIBRIUM_LIQUID] + point->m[EQUILIBRIUM_VAPOUR];
    struct phase_rate rate = {.scene = scene, .all = all, .before = before, .dt = dt};
    double m = phase_rate_search(point, &rate, before < after ? before : after, before < after ? after : before);
    *ret_status = rate.status;
    return rate.status ? before : m;
}
