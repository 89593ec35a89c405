/* equilibrium.c - see equilibrium.h.
 *
 * All cells of a block take Newton's steps together: each round asks every law once for the row. A cell that has
 * converged is left as it is while others go on, so its bits are its own. dT is eliminated by the enthalpy equation. */
#include "phys/equilibrium.h"

#include "phys/equilibrium_search.h"
#include "phys/squeeze.h"

#include <math.h>
#include <string.h>

enum { EQUILIBRIUM_ROUNDS = 16, EQUILIBRIUM_LAST = 1, EQUILIBRIUM_DONE = 2 };

#define EQUILIBRIUM_NEAR 1e-8 /* steps that small are the last but one */

typedef double equilibrium_row[EQUILIBRIUM_BLOCK];

/* Residuals of volume V, enthalpy H and D, with their slopes over p, T and m_v. */
struct equilibrium_newton {
    equilibrium_row V, V_p, V_T, V_m, H, H_p, H_T, H_m, D, D_p, D_T, D_m;
    equilibrium_row rho, v[2], h[2], s[2], v_T, v_p, c_p; /* of the phases; later laws go over the second ones */
    equilibrium_row lead_T[2], lead_p[2];                 /* v_T and v_p of phases that search their volumes */
    equilibrium_row gas, share;                           /* sum m R of the gases; ln x_v */
    equilibrium_row fixed_v, fixed_h;                     /* others: volume, and sum m v0 */
    equilibrium_row state;                                /* 0 moves, EQUILIBRIUM_LAST, EQUILIBRIUM_DONE */
};

static BULLA_KERNEL void equilibrium_reset(size_t n, const double *restrict p, const double *restrict energy,
                                           struct equilibrium_newton *restrict at)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        at->V[i] = -1.0;
        at->V_p[i] = at->V_T[i] = at->H_T[i] = 0.0;
        at->H[i] = -energy[i] - p[i];
        at->H_p[i] = -1.0;
    }
}

static BULLA_KERNEL void equilibrium_add(size_t n, const double *restrict m, const double *restrict T,
                                         const double *restrict v, const double *restrict h,
                                         struct equilibrium_newton *restrict at)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double mass = m[i], v_T = at->v_T[i], v_p = at->v_p[i], c_p = at->c_p[i];
        at->V[i] += mass * v[i];
        at->V_p[i] += mass * v_p;
        at->V_T[i] += mass * v_T;
        at->H[i] += mass * h[i];
        at->H_p[i] += mass * (v[i] - T[i] * v_T);
        at->H_T[i] += mass * c_p;
    }
}

/* D and what follows from the difference of the phases. */
static BULLA_KERNEL void equilibrium_differ(size_t n, double R, const double *restrict T, const double *restrict m_v,
                                            struct equilibrium_newton *restrict at)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double dv = at->v[1][i] - at->v[0][i], dh = at->h[1][i] - at->h[0][i], ds = at->s[1][i] - at->s[0][i];
        double gas = at->gas[i], mix = R * at->share[i], temperature = T[i], m = m_v[i];
        at->V_m[i] = dv;
        at->H_m[i] = dh;
        at->D[i] = dh - temperature * ds + temperature * mix;
        at->D_p[i] = dv;
        at->D_T[i] = mix - ds;
        at->D_m[i] = R * temperature * gas / (m * (m * R + gas));
    }
}

static inline double equilibrium_within(double x, double low, double high)
{
    double raised = x < low ? low : x;
    return raised > high ? high : raised;
}

/* One step of p, m and T; without exchange dm is 0. A cell whose last step was small takes one more. */
static BULLA_KERNEL void equilibrium_step(size_t n, double exchange, struct equilibrium_newton *restrict at,
                                          double *restrict p, double *restrict T, double *restrict m_l,
                                          double *restrict m_v)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double pressure = p[i], liquid = m_l[i], vapour = m_v[i], warm = 1.0 / at->H_T[i], state = at->state[i];
        double a = at->V_p[i] - at->V_T[i] * at->H_p[i] * warm, b = at->V_m[i] - at->V_T[i] * at->H_m[i] * warm;
        double c = at->D_p[i] - at->D_T[i] * at->H_p[i] * warm, d = at->D_m[i] - at->D_T[i] * at->H_m[i] * warm;
        double r = at->V[i] - at->V_T[i] * at->H[i] * warm, q = at->D[i] - at->D_T[i] * at->H[i] * warm;
        double both = 1.0 / (a * d - b * c), alone = -r / a;
        double dp = exchange > 0.0 ? (q * b - r * d) * both : alone, dm = exchange > 0.0 ? (r * c - q * a) * both : 0.0;
        double small = vapour < liquid ? vapour : liquid, size = dp < 0.0 ? -dp : dp, moved = dm < 0.0 ? -dm : dm;
        double near = size <= EQUILIBRIUM_NEAR * pressure && moved <= EQUILIBRIUM_NEAR * small ? 1.0 : 0.0;
        dp = equilibrium_within(dp, -0.7 * pressure, 2.0 * pressure);
        dm = equilibrium_within(dm, -0.95 * vapour, 19.0 * vapour);
        dm = dm > 0.95 * liquid ? 0.95 * liquid : dm;
        double dT = -(at->H[i] + at->H_p[i] * dp + at->H_m[i] * dm) * warm, hot = T[i];
        dT = equilibrium_within(dT, -0.5 * hot, hot);
        double goes = state < EQUILIBRIUM_DONE ? 1.0 : 0.0;
        p[i] = goes > 0.0 ? pressure + dp : pressure;
        T[i] = goes > 0.0 ? hot + dT : hot;
        m_v[i] = goes > 0.0 ? vapour + dm : vapour;
        m_l[i] = goes > 0.0 ? liquid - dm : liquid;
        double next = state >= EQUILIBRIUM_LAST ? 2.0 : 1.0;
        at->state[i] = near > 0.0 ? next : state >= EQUILIBRIUM_DONE ? state : 0.0;
    }
}

/* Other k at p. */
static double equilibrium_other(const struct equilibrium_cells *cells, unsigned k, size_t i, double *ret_slope)
{
    double own = cells->jumps ? cells->own[k][i] : 0.0;
    return squeeze_solid(&cells->other[k], cells->v0[k][i], cells->e0[k][i], own, cells->p[i], ret_slope);
}

/* Others follow p; scalar, since they are few. */
static void equilibrium_others(struct equilibrium_cells *cells, struct equilibrium_newton *at)
{
    for (unsigned k = 0; k < cells->n_other; k++) {
        for (size_t i = 0; i < cells->n; i++) {
            double m = cells->m_other[k][i], v0 = cells->v0[k][i], slope;
            if (!(m > 0.0) || at->state[i] >= EQUILIBRIUM_DONE) continue;
            at->V[i] += m * equilibrium_other(cells, k, i, &slope);
            at->V_p[i] += m * slope;
            at->H[i] += cells->p[i] * m * v0;
            at->H_p[i] += m * v0;
        }
    }
}

/* ln x_v; 0 without gases. */
static void equilibrium_mix(const struct equilibrium_family *family, const struct equilibrium_cells *cells,
                            struct equilibrium_newton *at)
{
    double R = family->R[EQUILIBRIUM_VAPOUR];
    if (!family->mixing) return;
    for (size_t i = 0; i < cells->n; i++) {
        double vapour = cells->m[EQUILIBRIUM_VAPOUR][i] * R;
        if (at->gas[i] > 0.0 && at->state[i] < EQUILIBRIUM_DONE) at->share[i] = log(vapour / (vapour + at->gas[i]));
    }
}

/* The pressures of member k: those of the vapour, but of a liquid behind a curved surface. */
static const double *equilibrium_pressure(const struct equilibrium_cells *cells, unsigned k, double *own)
{
    if (!cells->jumps || k != EQUILIBRIUM_LIQUID) return cells->p;
    for (size_t i = 0; i < cells->n; i++) own[i] = cells->p[i] + cells->jump[i];
    return own;
}

/* A row of pressures and temperatures asked of a law that has formulas; volumes are answers alone. */
static void equilibrium_row_of(const struct model_eos *eos, size_t n, const double *p, const double *T, double *v,
                               double *h, double *s, struct equilibrium_newton *at)
{
    memset(at->rho, 0, n * sizeof(double));
    eos->law->thermal(eos->self, n, p, T, at->rho, v, h, s, at->v_T, at->v_p, at->c_p);
}

/* A law that searches is asked only about cells that move, each from the volume it has: those that are done neither
 * cost, nor change with the rounds that others take. */
static void equilibrium_seek(const struct model_eos *eos, size_t n, const double *p, const double *T, double *v,
                             double *h, double *s, struct equilibrium_newton *at)
{
    size_t place[EQUILIBRIUM_BLOCK], count = 0;
    equilibrium_row from_p, from_T, rho, to[6];
    double *const into[6] = {v, h, s, at->v_T, at->v_p, at->c_p};
    for (size_t i = 0; i < n; i++) {
        if (at->state[i] >= EQUILIBRIUM_DONE) continue;
        place[count] = i;
        from_p[count] = p[i];
        from_T[count] = T[i];
        rho[count++] = v[i] > 0.0 ? 1.0 / v[i] : 0.0;
    }
    eos->law->thermal(eos->self, count, from_p, from_T, rho, to[0], to[1], to[2], to[3], to[4], to[5]);
    for (int q = 0; q < 6; q++)
        for (size_t i = 0; i < count; i++) into[q][place[i]] = to[q][i];
}

/* Where the volumes of phases that search will be after the step from (p, T): the next search begins there. */
static void equilibrium_lead(const struct equilibrium_family *family, const double *p, const double *T,
                             struct equilibrium_cells *cells, const struct equilibrium_newton *at)
{
    for (unsigned k = 0; k < 2; k++) {
        if (family->eos[k].law->linear) continue;
        for (size_t i = 0; i < cells->n; i++) {
            double v = cells->v[k][i], dv = at->lead_p[k][i] * (cells->p[i] - p[i]);
            dv += at->lead_T[k][i] * (cells->T[i] - T[i]);
            cells->v[k][i] = v + equilibrium_within(dv, -0.5 * v, v);
        }
    }
}

/* One round for all cells of a block; `energy` is without that of the others. */
static void equilibrium_round(const struct equilibrium_family *family, struct equilibrium_cells *cells,
                              const double *energy, struct equilibrium_newton *at)
{
    size_t n = cells->n;
    equilibrium_row own, p_from, T_from;
    memcpy(p_from, cells->p, n * sizeof(double));
    memcpy(T_from, cells->T, n * sizeof(double));
    equilibrium_reset(n, cells->p, energy, at);
    for (unsigned k = 0; k < family->n; k++) {
        equilibrium_row spare[2];
        double *v = cells->v[k], *h = k < 2 ? at->h[k] : spare[0], *s = k < 2 ? at->s[k] : spare[1];
        const double *p = equilibrium_pressure(cells, k, own);
        if (family->eos[k].law->linear) equilibrium_row_of(&family->eos[k], n, p, cells->T, v, h, s, at);
        else equilibrium_seek(&family->eos[k], n, p, cells->T, v, h, s, at);
        equilibrium_add(n, cells->m[k], cells->T, v, h, at);
        if (k >= 2) continue;
        memcpy(at->v[k], v, n * sizeof(double));
        memcpy(at->lead_T[k], at->v_T, n * sizeof(double));
        memcpy(at->lead_p[k], at->v_p, n * sizeof(double));
    }
    equilibrium_others(cells, at);
    equilibrium_mix(family, cells, at);
    equilibrium_differ(n, family->R[EQUILIBRIUM_VAPOUR], cells->T, cells->m[EQUILIBRIUM_VAPOUR], at);
    equilibrium_step(n, family->exchange ? 1.0 : 0.0, at, cells->p, cells->T, cells->m[EQUILIBRIUM_LIQUID],
                     cells->m[EQUILIBRIUM_VAPOUR]);
    equilibrium_lead(family, p_from, T_from, cells, at);
}

/* What cells came with, of what the steps change. */
struct equilibrium_came {
    equilibrium_row liquid, vapour, p, T;
};

static void equilibrium_remember(const struct equilibrium_cells *cells, struct equilibrium_came *ret_came)
{
    size_t size = cells->n * sizeof(double);
    memcpy(ret_came->liquid, cells->m[EQUILIBRIUM_LIQUID], size);
    memcpy(ret_came->vapour, cells->m[EQUILIBRIUM_VAPOUR], size);
    memcpy(ret_came->p, cells->p, size);
    memcpy(ret_came->T, cells->T, size);
}

/* Where the steps begin: the cell's own p and m_v, with a trace of what is missing. */
static void equilibrium_begin(const struct equilibrium_family *family, struct equilibrium_cells *cells, double *energy,
                              struct equilibrium_newton *at)
{
    for (size_t i = 0; i < cells->n; i++) {
        double *liquid = &cells->m[EQUILIBRIUM_LIQUID][i], *vapour = &cells->m[EQUILIBRIUM_VAPOUR][i],
               all = *liquid + *vapour, least = EQUILIBRIUM_NOTHING * all;
        energy[i] = cells->energy[i];
        for (unsigned k = 0; k < cells->n_other; k++) energy[i] -= cells->m_other[k][i] * cells->e0[k][i];
        if (!(cells->p[i] > 0.0)) cells->p[i] = 1e3;
        if (!(cells->T[i] > 0.0)) cells->T[i] = 300.0;
        at->state[i] = at->share[i] = 0.0;
        at->gas[i] = cells->apart && family->mixing ? cells->moles[i] : 0.0;
        for (unsigned k = EQUILIBRIUM_GAS; k < family->n && family->mixing; k++)
            at->gas[i] += cells->m[k][i] * family->R[k];
        if (!family->exchange) continue;
        if (*vapour < least) *vapour = least, *liquid = all - least;
        if (*liquid < least) *liquid = least, *vapour = all - least;
    }
}

/* What the steps did not settle, from the state that the cell came with. */
static void equilibrium_settle(const struct equilibrium_family *family, const struct equilibrium_came *came,
                               struct equilibrium_cells *cells, size_t i)
{
    struct equilibrium_point point;
    equilibrium_point_take(family, cells, i, &point);
    point.m[EQUILIBRIUM_LIQUID] = came->liquid[i];
    point.m[EQUILIBRIUM_VAPOUR] = came->vapour[i];
    point.p = came->p[i];
    point.T = came->T[i];
    cells->regime[i] = (unsigned char)equilibrium_search(&point);
    cells->p[i] = point.p;
    cells->T[i] = point.T;
    for (unsigned k = 0; k < family->n; k++) cells->m[k][i] = point.m[k], cells->v[k][i] = point.v[k];
}

/* Volumes of one material at (p, T), from those close by where the law has to search. */
static void equilibrium_volume(const struct model_eos *eos, size_t n, const double *p, const double *T,
                               struct equilibrium_newton *at, double *v)
{
    if (eos->law->linear) {
        eos->law->density(eos->self, n, p, T, at->rho);
        for (size_t i = 0; i < n; i++) v[i] = 1.0 / at->rho[i];
        return;
    }
    for (size_t i = 0; i < n; i++) at->rho[i] = v[i] > 0.0 ? 1.0 / v[i] : 0.0;
    eos->law->thermal(eos->self, n, p, T, at->rho, v, at->h[0], at->s[0], at->v_T, at->v_p, at->c_p);
}

/* Volumes at the answers, for rows that stand at a point a step ago. */
static void equilibrium_volumes(const struct equilibrium_family *family, struct equilibrium_cells *cells,
                                struct equilibrium_newton *at)
{
    size_t n = cells->n;
    equilibrium_row own;
    double slope;
    for (unsigned k = 0; k < family->n; k++)
        equilibrium_volume(&family->eos[k], n, equilibrium_pressure(cells, k, own), cells->T, at, cells->v[k]);
    for (unsigned k = 0; k < cells->n_other; k++)
        for (size_t i = 0; i < n; i++) cells->v_other[k][i] = equilibrium_other(cells, k, i, &slope);
}

static bool equilibrium_moves(size_t n, const double *state)
{
    bool moves = false;
    for (size_t i = 0; i < n; i++) moves = moves || state[i] < EQUILIBRIUM_DONE;
    return moves;
}

void equilibrium_solve(const struct equilibrium_family *family, struct equilibrium_cells *cells,
                       struct equilibrium_effort *effort)
{
    struct equilibrium_newton at;
    struct equilibrium_came came;
    equilibrium_row energy;
    equilibrium_remember(cells, &came);
    equilibrium_begin(family, cells, energy, &at);
    effort->cells += (long long)cells->n;
    for (int round = 0; round < EQUILIBRIUM_ROUNDS && equilibrium_moves(cells->n, at.state); round++) {
        for (size_t i = 0; i < cells->n; i++) effort->steps += at.state[i] < EQUILIBRIUM_DONE;
        equilibrium_round(family, cells, energy, &at);
    }
    for (size_t i = 0; i < cells->n; i++) {
        cells->regime[i] = EQUILIBRIUM_TWO_PHASE;
        if (at.state[i] >= EQUILIBRIUM_DONE && cells->p[i] > 0.0 && cells->T[i] > 0.0) continue;
        equilibrium_settle(family, &came, cells, i);
        effort->searched++;
        effort->refused += cells->regime[i] == EQUILIBRIUM_NONE;
    }
    equilibrium_volumes(family, cells, &at);
}
