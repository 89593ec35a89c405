/* squeeze.c - see squeeze.h. Scalar code: it runs in a handful of cells. */
#include "phys/squeeze.h"

#include <math.h>

enum { SQUEEZE_ROUNDS = 80, SQUEEZE_BEARS = 16 };

/* Longest step of a specific volume, as a ratio: a Newton step may miss by orders of magnitude, a search must not. */
#define SQUEEZE_LEAP 64.0

double squeeze_energy(const struct model_eos *eos, double rho, double p, double *ret_slope)
{
    double rho_e, rho_c2, de_dp, de_drho;
    eos->law->state(eos->self, 1, &rho, &p, &rho_e, &rho_c2);
    eos->law->derivatives(eos->self, 1, &rho, &p, &de_dp, &de_drho);
    *ret_slope = de_drho;
    return rho_e;
}

static double squeeze_least(const struct model_eos *eos, double rho)
{
    double least;
    eos->law->p_min(eos->self, 1, &rho, &least);
    return least;
}

/* Newton: the left side grows with v by rho c^2/Gamma and is linear in v for the stiffened-gas family. Where c^2 is
 * almost nothing, at the end of a law, a step would go anywhere: none is longer than SQUEEZE_LEAP in ratio or leaves
 * the bracket that the signs have left. */
double squeeze_volume(const struct model_eos *eos, double v0, double e0, double p)
{
    double target = e0 + p * v0, v = v0, low = 0.0, high = HUGE_VAL;
    for (int i = 0; i < SQUEEZE_ROUNDS && p <= squeeze_least(eos, 1.0 / v); i++) v *= SQUEEZE_LEAP;
    for (int i = 0; i < SQUEEZE_ROUNDS; i++) {
        double de_drho, rho_e = squeeze_energy(eos, 1.0 / v, p, &de_drho);
        double excess = v * rho_e + p * v - target, next = v - excess / (rho_e + p - de_drho / v);
        if (excess > 0.0) high = v;
        else low = v;
        double least = v / SQUEEZE_LEAP > low ? v / SQUEEZE_LEAP : low,
               most = v * SQUEEZE_LEAP < high ? v * SQUEEZE_LEAP : high;
        if (fabs(next - v) <= 1e-14 * v) return next;
        if (!(next > least && next < most)) next = sqrt((excess > 0.0 ? least : v) * (excess > 0.0 ? v : most));
        v = next;
    }
    return v;
}

/* dv/dp, and how v answers e0, dv/de0 [m3/J]. */
static double squeeze_slopes(const struct model_eos *eos, double v0, double v, double p, double *ret_warm)
{
    double rho = 1.0 / v, de_dp, de_drho, rho_e, rho_c2;
    eos->law->derivatives(eos->self, 1, &rho, &p, &de_dp, &de_drho);
    eos->law->state(eos->self, 1, &rho, &p, &rho_e, &rho_c2);
    *ret_warm = 1.0 / (rho_e + p - de_drho * rho);
    return -(v * de_dp + v - v0) / (rho_e + p - de_drho * rho);
}

double squeeze_slope(const struct model_eos *eos, double v0, double v, double p)
{
    double warm;
    return squeeze_slopes(eos, v0, v, p, &warm);
}

/* At a v the solid is squeezed to p + tau/v from e0 + tau (1 - v0/v), tau = own v0: Newton's method on top of that. */
double squeeze_solid(const struct model_eos *eos, double v0, double e0, double own, double p, double *ret_slope)
{
    double tau = own * v0, v = squeeze_volume(eos, v0, e0, p + own), slope, warm, gain = 1.0;
    for (int i = 0; i < SQUEEZE_BEARS; i++) {
        slope = squeeze_slopes(eos, v0, v, p + tau / v, &warm);
        gain = 1.0 + tau / (v * v) * (slope - v0 * warm);
        if (own == 0.0) break;
        double step = (squeeze_volume(eos, v0, e0 + tau * (1.0 - v0 / v), p + tau / v) - v) / gain;
        v += step;
        if (fabs(step) <= 1e-15 * v) break;
    }
    *ret_slope = slope / gain;
    return v;
}
