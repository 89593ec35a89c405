/* equilibrium_search.c - see equilibrium_search.h.
 *
 * D grows with m_v: first the ends, then bisection over y = ln(m_v/m_l), which resolves both phases down to 1e-17. A
 * mass of vapour that the energy does not suffice for is too much of it. */
#include "phys/equilibrium_search.h"

#include <math.h>

enum { EQUILIBRIUM_SEARCH_ROUNDS = 64 };

#define EQUILIBRIUM_SEARCH_REACH 40.0

/* The point with the masses of liquid and vapour divided in the ratio exp(y). */
static void equilibrium_search_split(struct equilibrium_point *point, double all, double y)
{
    double ratio = exp(-fabs(y)), less = all * ratio / (1.0 + ratio), more = all / (1.0 + ratio);
    point->m[EQUILIBRIUM_VAPOUR] = y < 0.0 ? less : more;
    point->m[EQUILIBRIUM_LIQUID] = y < 0.0 ? more : less;
}

/* Is there too little vapour? */
static bool equilibrium_search_grows(struct equilibrium_point *point, const struct equilibrium_point *start)
{
    point->p = start->p;
    point->T = start->T;
    return equilibrium_point_solve(point) && equilibrium_point_drive(point) < 0.0;
}

/* One phase alone has all the mass. False: that is not the equilibrium. */
static bool equilibrium_search_end(struct equilibrium_point *point, const struct equilibrium_point *start, double all,
                                   unsigned phase)
{
    *point = *start;
    point->m[EQUILIBRIUM_LIQUID] = phase == EQUILIBRIUM_LIQUID ? all : 0.0;
    point->m[EQUILIBRIUM_VAPOUR] = phase == EQUILIBRIUM_VAPOUR ? all : 0.0;
    if (!equilibrium_point_solve(point)) return false;
    double drive = equilibrium_point_drive(point);
    return phase == EQUILIBRIUM_VAPOUR ? drive <= 0.0 : drive >= 0.0;
}

static enum equilibrium_regime equilibrium_search_between(struct equilibrium_point *point,
                                                          const struct equilibrium_point *start, double all)
{
    double low = -EQUILIBRIUM_SEARCH_REACH, high = EQUILIBRIUM_SEARCH_REACH;
    *point = *start;
    for (int i = 0; i < EQUILIBRIUM_SEARCH_ROUNDS; i++) {
        double middle = 0.5 * (low + high);
        equilibrium_search_split(point, all, middle);
        if (equilibrium_search_grows(point, start)) low = middle;
        else high = middle;
    }
    equilibrium_search_split(point, all, low);
    return equilibrium_point_solve(point) ? EQUILIBRIUM_TWO_PHASE : EQUILIBRIUM_NONE;
}

enum equilibrium_regime equilibrium_search(struct equilibrium_point *point)
{
    const struct equilibrium_point start = *point;
    double all = start.m[EQUILIBRIUM_LIQUID] + start.m[EQUILIBRIUM_VAPOUR];
    if (!start.family->exchange) return equilibrium_point_solve(point) ? EQUILIBRIUM_TWO_PHASE : EQUILIBRIUM_NONE;
    if (equilibrium_search_end(point, &start, all, EQUILIBRIUM_VAPOUR)) return EQUILIBRIUM_ALL_VAPOUR;
    if (equilibrium_search_end(point, &start, all, EQUILIBRIUM_LIQUID)) return EQUILIBRIUM_ALL_LIQUID;
    return equilibrium_search_between(point, &start, all);
}
