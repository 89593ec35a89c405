/* cubic_thermal.h - everything from pressure and temperature by a law of cubic.h, for the gases of phase change.
 *
 *     v_p = 1/(dp/dv)_T,   v_T = -p_T v_p,   c_p = cv - T p_T^2 v_p,   h = e + p v.
 * The law itself, with a table too. Below the critical temperature the root is that of the gas, up to where the search
 * from the thin side ends; at t-min, where the continuations begin, and below there is no state, only NaN: those are no
 * potentials. */
#ifndef CUBIC_THERMAL_H
#define CUBIC_THERMAL_H

#include "cubic_rows.h"

static double cubic_thermal_density(const struct cubic *par, double p, double T)
{
    if (!(p > 0.0) || !(T > par->T_min)) return (double)NAN;
    return T > par->Tc ? cubic_rows_density_at(par, p, T) : cubic_rows_isotherm(par, p, T);
}

static void cubic_thermal(const void *instance, size_t n, const double *BULLA_RESTRICT p,
                          const double *BULLA_RESTRICT T, double *BULLA_RESTRICT rho, double *BULLA_RESTRICT v,
                          double *BULLA_RESTRICT h, double *BULLA_RESTRICT s, double *BULLA_RESTRICT v_T,
                          double *BULLA_RESTRICT v_p, double *BULLA_RESTRICT c_p)
{
    const struct cubic *par = instance;
    for (size_t i = 0; i < n; i++) {
        double at = cubic_thermal_density(par, p[i], T[i]);
        rho[i] = v[i] = h[i] = s[i] = v_T[i] = v_p[i] = c_p[i] = at;
        if (!(at > 0.0)) continue;
        struct cubic_room room = cubic_room(par, at);
        struct cubic_attraction pull = CUBIC_ATTRACTION(par, T[i]);
        struct cubic_ideal ideal = cubic_ideal(par, T[i]);
        double p_T = cubic_p_T(par, room, pull.a1);
        double soft = 1.0 / (par->R * T[i] * room.dper_w - pull.a * room.dq); /* -(dv/dp)_T */
        double cv = par->R * ideal.cv + T[i] * pull.a2 * room.L;
        v[i] = room.v;
        h[i] = par->R * ideal.e - (pull.a - T[i] * pull.a1) * room.L + p[i] * room.v;
        s[i] = cubic_entropy(par, room, pull.a1, T[i]);
        v_T[i] = p_T * soft;
        v_p[i] = -soft;
        c_p[i] = cv + T[i] * p_T * p_T * soft;
    }
}

static double cubic_thermal_gas(const void *instance)
{
    const struct cubic *par = instance;
    return par->R;
}

#endif
