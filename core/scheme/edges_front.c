/* edges_front.c - see edges_front.h. */
#include "scheme/edges_front.h"

#include "bulla/module.h"
#include "phys/phase_pair.h"
#include "phys/row.h"

#include <math.h>
#include <string.h>

/* From behind the surface to before it at a face: the mean of `line` and of what the cell before and the next one
 * before it go on to, which lies between the cell behind and the cell before. */
static inline double edges_front_between(double line, double behind, double before, double next)
{
    double slope = 1.5 * before - 0.5 * next, low = behind < before ? behind : before,
           high = behind < before ? before : behind;
    slope = slope > low ? slope : low;
    slope = slope < high ? slope : high;
    return 0.5 * (line + slope);
}

static BULLA_KERNEL void edges_front_meet(size_t n, size_t step, double front, const double *restrict thin,
                                          const double *restrict liquid, const double *restrict rho,
                                          double *restrict upper, double *restrict lower)
{
    const double *thin_r = thin + step, *liquid_r = liquid + step, *rho_r = rho + step;
    const double *rho_ll = rho - step, *rho_rr = rho_r + step;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = thin[i], b = thin_r[i], l = rho[i], r = rho_r[i], ll = rho_ll[i], rr = rho_rr[i];
        double before = a < b ? a : b, behind = a < b ? b : a, wet = liquid[i] * liquid_r[i], up = upper[i];
        double low = lower[i], part = 1.0 - 0.5 * (behind - before) / (front - before), line = part > 0.0 ? part : 0.0;
        int meets = (before < front) & (behind >= front) & (wet > 0.0);
        double left = edges_front_between(l + (r - l) * line, l, r, rr);
        double right = edges_front_between(r + (l - r) * line, r, l, ll);
        upper[i] = (meets & (b < a)) ? left : up;
        lower[i] = (meets & (a < b)) ? right : low;
    }
}

/* Less than this of vapour and gases in a cell is none. */
#define EDGES_FRONT_TRACE 1e-6

/* At least so much of them, and the velocity of a cell is theirs. */
#define EDGES_FRONT_DRY 0.99

/* Over this, the part of the vapour's sqrt(p/rho) at which cells that move apart keep their velocities. */
#define EDGES_FRONT_MACH 10.0

/* Is the second cell wet beside a dry first one? */
static inline int edges_front_ends(double dry, double thin_dry, double thin_wet, double liquid_wet)
{
    return (thin_dry >= dry) & (thin_wet < dry) & (thin_wet > EDGES_FRONT_TRACE) & (liquid_wet > 1.0 - dry);
}

/* The velocity of a wet edge beside a dry one. rho: of the vapour. */
static BULLA_KERNEL void edges_front_still(size_t n, size_t step, double dry, const double *restrict thin,
                                           const double *restrict liquid, const double *restrict rho,
                                           const double *restrict p, const double *restrict mask,
                                           double *restrict upper, double *restrict lower)
{
    const double *thin_r = thin + step, *liquid_r = liquid + step, *rho_r = rho + step, *p_r = p + step;
    const double *mask_r = mask + step;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = thin[i], b = thin_r[i], wet_l = liquid[i], wet_r = liquid_r[i], pl = p[i], pr = p_r[i];
        double up = upper[i], low = lower[i], held = mask[i] + mask_r[i], vapour = a > b ? rho[i] : rho_r[i];
        double gap = pl < pr ? pr - pl : pl - pr, least = pl < pr ? pl : pr, apart = low - up;
        double rest = 1.0 - gap / least - EDGES_FRONT_MACH * sqrt(apart * apart * vapour / least);
        int calm = (least > 0.0) & (rest > 0.0) & (apart > 0.0) & !(held > 0.0);
        int right = calm & edges_front_ends(dry, a, b, wet_r), left = calm & edges_front_ends(dry, b, a, wet_l);
        double from_l = low + rest * (up - low), from_r = up + rest * (low - up);
        lower[i] = right ? from_l : low;
        upper[i] = left ? from_r : up;
    }
}

static void edges_front_pair(const struct edges_front *row, const struct model_phase *phase)
{
    const struct model *model = row->model;
    const double *alpha = row->w + model->i_alpha * row->pitch, *liquid = alpha + phase->member[0] * row->pitch;
    size_t q = model->i_m + phase->member[0], n = row->n - row->step;
    double front = phase_pair_front(phase->scene), *upper = row->state + 2 * q * row->pitch, *thin = row->thin;
    const double *rho = row->w + q * row->pitch;
    memset(thin, 0, row->n * sizeof *thin);
    for (unsigned j = 1; j < phase->n; j++) row_add(row->n, alpha + phase->member[j] * row->pitch, thin);
    if (row_most(row->n, thin) < front) return;
    unsigned normal = model->i_u + (unsigned)row->axis;
    double *u = row->state + 2 * normal * row->pitch;
    double dry = phase->scene->onset > EDGES_FRONT_DRY ? phase->scene->onset : EDGES_FRONT_DRY;
    const double *vapour = row->w + (model->i_m + phase->member[1]) * row->pitch;
    edges_front_still(n, row->step, dry, thin, liquid, vapour, row->w + model->i_E * row->pitch, row->mask, u,
                      u + row->n + row->step);
    edges_front_meet(n, row->step, front, thin, liquid, rho, upper, upper + row->n + row->step);
}

void edges_front(const struct edges_front *row)
{
    for (unsigned k = 0; k < row->model->n_phase; k++)
        if (row->model->phases[k].scene->onset > 0.0) edges_front_pair(row, &row->model->phases[k]);
}
