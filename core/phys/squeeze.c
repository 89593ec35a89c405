/* squeeze.c - see squeeze.h. Scalar code: it runs in a handful of cells. */
#include "phys/squeeze.h"

#include <math.h>

enum { SQUEEZE_ROUNDS = 80 };

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

double squeeze_slope(const struct model_eos *eos, double v0, double v, double p)
{
    double rho = 1.0 / v, de_dp, de_drho, rho_e, rho_c2;
    eos->law->derivatives(eos->self, 1, &rho, &p, &de_dp, &de_drho);
    eos->law->state(eos->self, 1, &rho, &p, &rho_e, &rho_c2);
    return -(v * de_dp + v - v0) / (rho_e + p - de_drho * rho);
}
