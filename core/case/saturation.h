/* saturation.h - where a liquid and its vapour are in equilibrium: g_l(p, T) = g_v(p, T), g = h - T s of their laws.
 *
 * The difference D = g_v - g_l grows with p as long as the vapour is the thinner one (D_p = v_v - v_l) and falls with T
 * (D_T = s_l - s_v), so each pressure has one temperature and back. Stiffened gases have a second root where the vapour
 * would be denser than the liquid; the curve ends where v_v < 2 v_l, before that. */
#ifndef SATURATION_H
#define SATURATION_H

#include "plug/instance.h"

#include <stdbool.h>

struct bulla_eos;

struct saturation {
    const struct bulla_eos *law[2]; /* liquid, vapour; both offer `thermal` */
    const void *self[2];
    double rho[2]; /* densities that searches of the laws may start from, or 0 */
    double jump;   /* by how much the liquid has more pressure than the vapour, for saturation_at [Pa] */
};

struct saturation_state {
    double v[2], h[2], s[2]; /* of liquid and vapour, per mass */
    double drive;            /* D [J/kg]: below 0 liquid evaporates */
};

enum { SATURATION_POINTS = 451 };

struct saturation_range {
    double T_min, T_max, p_min, p_max; /* ends of the curve [K, Pa] */
    unsigned n;
    double p[SATURATION_POINTS]; /* psat [Pa] every SATURATION_STEP from T_min to T_max */
};

/* False: a law has no `thermal`. */
bool saturation_of(const struct instance *liquid, const struct instance *vapour, struct saturation *ret_pair);

/* p: that of the vapour. */
struct saturation_state saturation_at(const struct saturation *pair, double p, double T);

/* psat(T) [Pa] and Tsat(p) [K]; NaN: there is none, or the vapour is not twice as thin as the liquid there. */
double saturation_pressure(const struct saturation *pair, double T);
double saturation_temperature(const struct saturation *pair, double p);

/* psat of water by the auxiliary equation of IAPWS (Wagner & Pruss, J. Phys. Chem. Ref. Data 31 (2002) 387, eq. 2.5)
 * [Pa]; NaN outside of 273 to 647 K. */
double saturation_water(double T);

/* The part of the curve between 200 and 2000 K. False: there is none, or none that reaches 10 kPa. */
bool saturation_ends(const struct saturation *pair, struct saturation_range *ret_range);

/* A pressure [Pa] that psat(T) is surely below, some percent above it: the next point of the curve. Infinite outside.
 */
double saturation_ceiling(const struct saturation_range *range, double T);

/* Is it water, by the name of the liquid, or by what it takes to boil at 1 atm: 1.9 to 2.6 MJ/kg (2.26) at 300 to 450
 * K? No other liquid in use does. */
bool saturation_is_water(const struct saturation *pair, const char *name);

#endif
