/* equilibrium_point.c - see equilibrium_point.h.
 *
 * T follows from the enthalpy equation at each p: sum m h grows with T. F(p) = sum m v(p, T(p)) - 1 is +inf at the
 * least pressure and negative at infinity; its root is the only one (entropy), though F need not be monotone, so the
 * bracket is kept. Where T would be negative there is no state at any p: T grows with p. */
#include "phys/equilibrium_point.h"

#include "phys/squeeze.h"

#include <float.h>
#include <math.h>

enum { EQUILIBRIUM_POINT_ROUNDS = 200, EQUILIBRIUM_POINT_HEAT = 60 };

#define EQUILIBRIUM_POINT_NEAR 1e-14
#define EQUILIBRIUM_POINT_COLD 1e-3 /* [K] */

void equilibrium_point_take(const struct equilibrium_family *family, const struct equilibrium_cells *cells, size_t i,
                            struct equilibrium_point *ret_point)
{
    *ret_point = (struct equilibrium_point){.family = family,
                                            .energy = cells->energy[i],
                                            .n_other = cells->n_other,
                                            .other = cells->other,
                                            .jump = cells->jumps ? cells->jump[i] : 0.0,
                                            .moles = cells->apart ? cells->moles[i] : 0.0,
                                            .p = cells->p[i],
                                            .T = cells->T[i]};
    for (unsigned k = 0; k < family->n; k++) ret_point->m[k] = cells->m[k][i];
    for (unsigned k = 0; k < cells->n_other; k++) {
        ret_point->m_other[k] = cells->m_other[k][i];
        ret_point->v0[k] = cells->v0[k][i];
        ret_point->e0[k] = cells->e0[k][i];
        ret_point->own[k] = cells->jumps ? cells->own[k][i] : 0.0;
        ret_point->energy -= ret_point->m_other[k] * ret_point->e0[k];
    }
}

/* Everything of the family at (p, T), and the residual of enthalpy. */
static void equilibrium_point_look(struct equilibrium_point *point)
{
    const struct equilibrium_family *family = point->family;
    double p = point->p, T = point->T;
    point->heat = -point->energy - p;
    point->heat_p = -1.0;
    point->heat_T = 0.0;
    for (unsigned k = 0; k < point->n_other; k++) {
        point->heat += p * point->m_other[k] * point->v0[k];
        point->heat_p += point->m_other[k] * point->v0[k];
    }
    for (unsigned k = 0; k < family->n; k++) {
        double rho = point->v[k] > 0.0 ? 1.0 / point->v[k] : 0.0, m = point->m[k];
        double own = k == EQUILIBRIUM_LIQUID ? p + point->jump : p;
        family->eos[k].law->thermal(family->eos[k].self, 1, &own, &T, &rho, &point->v[k], &point->h[k], &point->s[k],
                                    &point->v_T[k], &point->v_p[k], &point->c_p[k]);
        if (!(m > 0.0)) continue;
        point->heat += m * point->h[k];
        point->heat_p += m * (point->v[k] - T * point->v_T[k]);
        point->heat_T += m * point->c_p[k];
    }
}

/* T at p. */
static bool equilibrium_point_warm(struct equilibrium_point *point)
{
    for (int i = 0; i < EQUILIBRIUM_POINT_HEAT; i++) {
        equilibrium_point_look(point);
        double T = point->T, step = -point->heat / point->heat_T;
        if (!isfinite(step)) return false;
        if (fabs(step) <= EQUILIBRIUM_POINT_NEAR * T) return true;
        if (step < -0.9 * T) step = -0.9 * T;
        if (step > 9.0 * T) step = 9.0 * T;
        point->T = T + step;
        if (point->T < EQUILIBRIUM_POINT_COLD) return false;
    }
    return true;
}

/* F(p) and its slope along T(p). */
static bool equilibrium_point_room(struct equilibrium_point *point)
{
    if (!equilibrium_point_warm(point)) return false;
    const struct equilibrium_family *family = point->family;
    double warming = -point->heat_p / point->heat_T;
    point->volume = -1.0;
    point->volume_p = 0.0;
    for (unsigned k = 0; k < family->n; k++) {
        double m = point->m[k];
        if (!(m > 0.0)) continue;
        point->volume += m * point->v[k];
        point->volume_p += m * (point->v_p[k] + point->v_T[k] * warming);
    }
    for (unsigned k = 0; k < point->n_other; k++) {
        double slope, v = squeeze_solid(&point->other[k], point->v0[k], point->e0[k], point->own[k], point->p, &slope);
        point->v_other[k] = v;
        point->volume += point->m_other[k] * v;
        point->volume_p += point->m_other[k] * slope;
    }
    return isfinite(point->volume);
}

/* The least pressure that all materials of the cell bear. */
static double equilibrium_point_least(const struct equilibrium_point *point)
{
    const struct equilibrium_family *family = point->family;
    double floor = -HUGE_VAL, least;
    for (unsigned k = 0; k < family->n; k++) {
        if (!(point->m[k] > 0.0)) continue;
        double rho = point->v[k] > 0.0 ? 1.0 / point->v[k] : family->eos[k].rho_fill;
        family->eos[k].law->p_min(family->eos[k].self, 1, &rho, &least);
        if (k == EQUILIBRIUM_LIQUID) least -= point->jump;
        floor = least > floor ? least : floor;
    }
    for (unsigned k = 0; k < point->n_other; k++) {
        double rho = 1e-9 / point->v0[k];
        point->other[k].law->p_min(point->other[k].self, 1, &rho, &least);
        least -= point->own[k];
        floor = least > floor ? least : floor;
    }
    return floor;
}

/* What a change of p by rounding does: a stiff liquid has 1e-7 Pa of it. */
static double equilibrium_point_blur(const struct equilibrium_point *point)
{
    return 4.0 * DBL_EPSILON / fabs(point->volume_p);
}

bool equilibrium_point_solve(struct equilibrium_point *point)
{
    double floor = equilibrium_point_least(point), low = 0.0, high = HUGE_VAL; /* of p - floor */
    if (!(point->p > floor)) point->p = floor + (floor < 0.0 ? -floor : 1e3);
    if (!(point->T > 0.0)) point->T = 300.0;
    for (int i = 0; i < EQUILIBRIUM_POINT_ROUNDS; i++) {
        double above = point->p - floor;
        if (!equilibrium_point_room(point)) return false;
        if (point->volume > 0.0) low = above;
        else high = above;
        double step = -point->volume / point->volume_p, next = above + step, blur = equilibrium_point_blur(point);
        double near = EQUILIBRIUM_POINT_NEAR * fabs(point->p);
        if (point->volume == 0.0 || fabs(step) <= (near > blur ? near : blur)) return true;
        double least = above / 16.0 > low ? above / 16.0 : low, most = above * 16.0 < high ? above * 16.0 : high;
        if (!(next > least && next < most))
            next = sqrt((point->volume > 0.0 ? above : least) * (point->volume > 0.0 ? most : above));
        if (!(next > 0.0) || !isfinite(next)) return false;
        if (next == above || floor + next == point->p) return true;
        point->p = floor + next;
    }
    return isfinite(high) && low > 0.0;
}

double equilibrium_point_share(const struct equilibrium_point *point)
{
    const struct equilibrium_family *family = point->family;
    double sum = point->moles, vapour = point->m[EQUILIBRIUM_VAPOUR] * family->R[EQUILIBRIUM_VAPOUR];
    if (!family->mixing) return 1.0;
    for (unsigned k = EQUILIBRIUM_GAS; k < family->n; k++) sum += point->m[k] * family->R[k];
    return sum > 0.0 ? vapour / (vapour + sum) : 1.0;
}

double equilibrium_point_drive(const struct equilibrium_point *point)
{
    const double *h = point->h, *s = point->s;
    double share = equilibrium_point_share(point), T = point->T;
    double drive = h[EQUILIBRIUM_VAPOUR] - h[EQUILIBRIUM_LIQUID] - T * (s[EQUILIBRIUM_VAPOUR] - s[EQUILIBRIUM_LIQUID]);
    if (!(point->p > 0.0)) return -HUGE_VAL;                                            /* stretched liquid */
    if (isnan(h[EQUILIBRIUM_VAPOUR]) && !isnan(h[EQUILIBRIUM_LIQUID])) return HUGE_VAL; /* no vapour so dense */
    if (!(share > 0.0) || !isfinite(drive)) return -HUGE_VAL;
    return drive + point->family->R[EQUILIBRIUM_VAPOUR] * T * log(share);
}
