/* paint_pressure.c - see paint_pressure.h.
 *
 * At fixed density a temperature never falls with pressure, in the continuations of a law neither, so halving
 * finds the root in any law without a slot of its own; a layer asks once, or once per point where it varies. */
#include "paint/paint_pressure.h"

#include <math.h>

#define PAINT_PRESSURE_MOST 1e15 /* Pa */

static double paint_pressure_warmth(const struct model_eos *eos, double rho, double p)
{
    double T;
    eos->law->temperature(eos->self, 1, &rho, &p, &T);
    return T;
}

bool paint_pressure(const struct model_eos *eos, double rho, double T, double *ret_p)
{
    double low, step = 1e5;
    eos->law->p_min(eos->self, 1, &rho, &low);
    double high = low + step;
    while (!(paint_pressure_warmth(eos, rho, high) > T)) {
        low = high;
        high = low + step;
        step *= 2.0;
        if (!(high < PAINT_PRESSURE_MOST)) return false;
    }
    for (double middle = 0.5 * (low + high); middle > low && middle < high; middle = 0.5 * (low + high)) {
        if (paint_pressure_warmth(eos, rho, middle) > T) high = middle;
        else low = middle;
    }
    *ret_p = low;
    return fabs(paint_pressure_warmth(eos, rho, low) - T) <= 1e-9 * T;
}
