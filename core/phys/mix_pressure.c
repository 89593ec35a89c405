/* mix_pressure.c - see mix_pressure.h.
 *
 * Newton on all points of a batch together: each round asks the laws once for the points that still move, which then
 * close ranks. F(p) = A p + B + sum alpha_l rho_l e_l - rho e, where A and B hold the materials that are linear in p:
 * they are asked once. The sign of F moves one end of the bracket [low, high]; a step that leaves it is replaced by
 * bisection, or doubling while there is no such end. */
#include "phys/mix_pressure.h"

#include "phys/present.h"
#include "phys/row.h"
#include "phys/traction.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#define MIX_PRESSURE_NEAR 1e-12 /* of p: a step that small is none */

/* Of p: a bracket that narrow holds nothing but the noise of a law that is iterated itself (IAPWS-95 as it stands has
 * 5e-14 of its energies, hundreds of times what round-off has). */
#define MIX_PRESSURE_NOISE 1e-9

struct mix_pressure_row {
    double value[MIX_PRESSURE_BATCH];
};

/* The points that still move, without gaps. */
struct mix_pressure_points {
    size_t n;
    unsigned short at[MIX_PRESSURE_BATCH]; /* place in the batch */
    struct mix_pressure_row p, target, a, b, floor, low, high;
    unsigned n_law;
    const struct model_eos *law[SCENE_MATERIALS]; /* not linear in p */
    struct mix_pressure_row alpha[SCENE_MATERIALS], rho[SCENE_MATERIALS];
    struct mix_pressure_row lag[SCENE_MATERIALS], own; /* split models: p_l - p, and one material's p_l (traction.h) */
    bool split;
    struct mix_pressure_row f, slope, size; /* F and F' at p, and the sum of the magnitudes that F is made of */
};

void mix_pressure_sum(struct mix_effort *sum, struct mix_effort more)
{
    sum->solved += more.solved;
    sum->steps += more.steps;
    sum->failed += more.failed;
    sum->most = sum->most > more.most ? sum->most : more.most;
}

static BULLA_KERNEL void mix_pressure_weigh(size_t n, const double *restrict alpha, const double *restrict a,
                                            const double *restrict b, double *restrict sum_a, double *restrict sum_b)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double weight = alpha[i], s = sum_a[i], t = sum_b[i];
        sum_a[i] = s + weight * a[i];
        sum_b[i] = t + weight * b[i];
    }
}

/* p = (rho e - b)/a. */
static BULLA_KERNEL void mix_pressure_divide(size_t n, const double *restrict rho_e, const double *restrict a,
                                             const double *restrict b, double *restrict p)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) p[i] = (rho_e[i] - b[i]) / a[i];
}

/* b of a material whose pressure is p + lag: a (p + lag) + b. */
static BULLA_KERNEL void mix_pressure_shift(size_t n, const double *restrict a, const double *restrict lag,
                                            double *restrict b)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) b[i] += a[i] * lag[i];
}

/* A and B of the materials that are linear in p: rho e = A p + B. */
static void mix_pressure_linear(const struct model *model, size_t n, size_t stride, const double *w,
                                const struct traction_pressures *parts, double *ret_a, double *ret_b)
{
    struct mix_pressure_row a, b;
    memset(ret_a, 0, n * sizeof *ret_a);
    memset(ret_b, 0, n * sizeof *ret_b);
    for (unsigned l = 0; l < model->n_material; l++) {
        const struct model_eos *eos = &model->eos[l];
        if (!eos->law->linear) continue;
        eos->law->linear(eos->self, n, w + (model->i_m + l) * stride, a.value, b.value);
        if (model->lagged) mix_pressure_shift(n, a.value, parts->lag[l], b.value);
        if (model->n_alpha) {
            mix_pressure_weigh(n, w + (model->i_alpha + l) * stride, a.value, b.value, ret_a, ret_b);
        } else {
            memcpy(ret_a, a.value, n * sizeof *ret_a);
            memcpy(ret_b, b.value, n * sizeof *ret_b);
        }
    }
}

/* Share of the materials that are not linear in p. */
static void mix_pressure_curved(const struct model *model, size_t n, size_t stride, const double *w, double *ret)
{
    memset(ret, 0, n * sizeof *ret);
    for (unsigned l = 0; l < model->n_alpha; l++)
        if (!model->eos[l].law->linear) row_add(n, w + (model->i_alpha + l) * stride, ret);
    for (size_t i = 0; i < n && !model->n_alpha; i++) ret[i] = 1.0;
}

static void mix_pressure_gather(const struct mix_pressure_points *points, const double *from,
                                struct mix_pressure_row *to)
{
    for (size_t k = 0; k < points->n; k++) to->value[k] = from[points->at[k]];
}

/* Lowest pressure at which the materials of each point are well-posed. */
static void mix_pressure_floor(const struct model *model, size_t stride, const double *w,
                               const struct traction_pressures *parts, struct mix_pressure_points *points)
{
    struct mix_pressure_row rho, least;
    for (size_t k = 0; k < points->n; k++) points->floor.value[k] = -HUGE_VAL;
    for (unsigned l = 0; l < model->n_material; l++) {
        const struct model_eos *eos = &model->eos[l];
        mix_pressure_gather(points, w + (model->i_m + l) * stride, &rho);
        eos->law->p_min(eos->self, points->n, rho.value, least.value);
        for (size_t k = 0; k < points->n; k++) {
            double alpha = model->n_alpha ? w[(model->i_alpha + l) * stride + points->at[k]] : 1.0;
            double own = model->lagged ? least.value[k] - parts->lag[l][points->at[k]] : least.value[k];
            bool raised = alpha > MIX_PRESSURE_FELT && own > points->floor.value[k];
            points->floor.value[k] = raised ? own : points->floor.value[k];
        }
    }
}

/* The points that have to be iterated, each at its pressure of before if that is one. */
static void mix_pressure_begin(const struct model *model, size_t stride, const double *w, const double *rho_e,
                               const double *a, const double *b, const struct traction_pressures *parts,
                               struct mix_pressure_points *points)
{
    points->n_law = 0;
    points->split = model->lagged;
    for (unsigned l = 0; l < model->n_material; l++) {
        if (model->eos[l].law->linear) continue;
        unsigned k = points->n_law++;
        points->law[k] = &model->eos[l];
        mix_pressure_gather(points, w + (model->i_m + l) * stride, &points->rho[k]);
        if (model->lagged) mix_pressure_gather(points, parts->lag[l], &points->lag[k]);
        if (model->n_alpha) mix_pressure_gather(points, w + (model->i_alpha + l) * stride, &points->alpha[k]);
        for (size_t i = 0; i < points->n && !model->n_alpha; i++) points->alpha[k].value[i] = 1.0;
    }
    mix_pressure_gather(points, rho_e, &points->target);
    mix_pressure_gather(points, a, &points->a);
    mix_pressure_gather(points, b, &points->b);
    mix_pressure_gather(points, w + model->i_E * stride, &points->p);
    mix_pressure_floor(model, stride, w, parts, points);
    for (size_t k = 0; k < points->n; k++) {
        double least = points->floor.value[k], p = points->p.value[k];
        points->low.value[k] = least;
        points->high.value[k] = HUGE_VAL;
        if (!(p > least) || !isfinite(p)) points->p.value[k] = least < 0.0 ? 1e5 : 2.0 * least + 1e5;
    }
}

static BULLA_KERNEL void mix_pressure_base(size_t n, const double *restrict p, const double *restrict a,
                                           const double *restrict b, double *restrict f, double *restrict slope,
                                           double *restrict size)
{
#pragma omp simd
    for (size_t k = 0; k < n; k++) {
        double steep = a[k], value = steep * p[k] + b[k];
        f[k] = value;
        slope[k] = steep;
        size[k] = value < 0.0 ? -value : value;
    }
}

static BULLA_KERNEL void mix_pressure_more(size_t n, const double *restrict alpha, const double *restrict e,
                                           const double *restrict de_dp, double *restrict f, double *restrict slope,
                                           double *restrict size)
{
#pragma omp simd
    for (size_t k = 0; k < n; k++) {
        double weight = alpha[k], value = weight * e[k], old_f = f[k], old_slope = slope[k], old_size = size[k];
        f[k] = old_f + value;
        slope[k] = old_slope + weight * de_dp[k];
        size[k] = old_size + (value < 0.0 ? -value : value);
    }
}

static void mix_pressure_residual(struct mix_pressure_points *points)
{
    struct mix_pressure_row e, de_dp;
    size_t n = points->n;
    mix_pressure_base(n, points->p.value, points->a.value, points->b.value, points->f.value, points->slope.value,
                      points->size.value);
    for (unsigned l = 0; l < points->n_law; l++) {
        const double *p = points->p.value;
        if (points->split) {
            memcpy(points->own.value, p, n * sizeof *p);
            row_add(n, points->lag[l].value, points->own.value);
            p = points->own.value;
        }
        struct present present = {n, points->alpha[l].value, points->rho[l].value, p};
        present_energy(points->law[l], &present, e.value, de_dp.value);
        mix_pressure_more(n, points->alpha[l].value, e.value, de_dp.value, points->f.value, points->slope.value,
                          points->size.value);
    }
}

enum mix_pressure_end { MIX_PRESSURE_MOVES, MIX_PRESSURE_DONE, MIX_PRESSURE_LOST };

/* Of a point that cannot be moved on. Nothing is known of its floor, so that is no end of a bracket. */
static enum mix_pressure_end mix_pressure_end(const struct mix_pressure_points *points, size_t k)
{
    double low = points->low.value[k], width = points->high.value[k] - low;
    bool found = low > points->floor.value[k] && width <= MIX_PRESSURE_NOISE * fabs(points->p.value[k]);
    return found ? MIX_PRESSURE_DONE : MIX_PRESSURE_LOST;
}

/* Judges point k at its p, and moves it on if need be. */
static enum mix_pressure_end mix_pressure_step(struct mix_pressure_points *points, size_t k)
{
    double p = points->p.value[k], target = points->target.value[k], slope = points->slope.value[k];
    double excess = points->f.value[k] - target, step = excess / slope, next = p - step;
    double blur = 4.0 * DBL_EPSILON * (points->size.value[k] + fabs(target)) / slope,
           near = MIX_PRESSURE_NEAR * fabs(p);
    if (!isfinite(excess)) return MIX_PRESSURE_LOST;
    if (fabs(step) <= (near > blur ? near : blur)) return MIX_PRESSURE_DONE;
    if (excess > 0.0) points->high.value[k] = p;
    else points->low.value[k] = p;
    double low = points->low.value[k], high = points->high.value[k], stride = 2.0 * fabs(p) + 1e5;
    if (!(next > low && next < high)) {
        next = excess > 0.0 ? p - stride : p + stride;
        if (isfinite(low) && isfinite(high)) next = 0.5 * (low + high);
    }
    if (!(next > low && next < high)) return mix_pressure_end(points, k); /* a bracket may shrink to nothing */
    points->p.value[k] = next;
    return MIX_PRESSURE_MOVES;
}

/* Point k takes the place of another that is done. */
static void mix_pressure_move(struct mix_pressure_points *points, size_t k, size_t to)
{
    struct mix_pressure_row *rows[] = {&points->p,     &points->target, &points->a,   &points->b,
                                       &points->floor, &points->low,    &points->high};
    points->at[to] = points->at[k];
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) rows[r]->value[to] = rows[r]->value[k];
    for (unsigned l = 0; l < points->n_law; l++) {
        points->alpha[l].value[to] = points->alpha[l].value[k];
        points->rho[l].value[to] = points->rho[l].value[k];
        if (points->split) points->lag[l].value[to] = points->lag[l].value[k];
    }
}

double mix_pressure_none(double floor)
{
    return isfinite(floor) ? floor - (1.0 + 1e-3 * fabs(floor)) : -DBL_MAX;
}

/* One round for all points that still move. */
static void mix_pressure_round(struct mix_pressure_points *points, double *p, struct mix_effort *effort)
{
    size_t left = 0;
    mix_pressure_residual(points);
    for (size_t k = 0; k < points->n; k++) {
        enum mix_pressure_end end = mix_pressure_step(points, k);
        if (end == MIX_PRESSURE_MOVES) {
            if (left != k) mix_pressure_move(points, k, left);
            left++;
            continue;
        }
        effort->failed += end == MIX_PRESSURE_LOST;
        p[points->at[k]] = end == MIX_PRESSURE_DONE ? points->p.value[k] : mix_pressure_none(points->floor.value[k]);
    }
    points->n = left;
    effort->steps += (long long)left;
    effort->most += left > 0;
}

static struct mix_effort mix_pressure_iterate(struct mix_pressure_points *points, double *p)
{
    struct mix_effort effort = {.solved = (long long)points->n};
    for (int round = 0; round <= MIX_PRESSURE_ROUNDS && points->n > 0; round++) mix_pressure_round(points, p, &effort);
    for (size_t k = 0; k < points->n; k++) {
        bool lost = mix_pressure_end(points, k) == MIX_PRESSURE_LOST;
        p[points->at[k]] = lost ? mix_pressure_none(points->floor.value[k]) : points->p.value[k];
        effort.failed += lost;
    }
    return effort;
}

struct mix_effort mix_pressure_close(const struct model *model, size_t n, size_t stride, const double *rho_e, double *w)
{
    struct mix_pressure_row a, b, curved;
    struct mix_pressure_points points;
    struct traction_pressures parts;
    double *p = w + model->i_E * stride;
    traction_part(model, n, stride, w, &parts);
    mix_pressure_linear(model, n, stride, w, &parts, a.value, b.value);
    if (model->linear) {
        mix_pressure_divide(n, rho_e, a.value, b.value, p);
        return (struct mix_effort){0};
    }
    mix_pressure_curved(model, n, stride, w, curved.value);
    points.n = 0;
    for (size_t i = 0; i < n; i++) {
        if (curved.value[i] == 0.0) p[i] = (rho_e[i] - b.value[i]) / a.value[i];
        else points.at[points.n++] = (unsigned short)i;
    }
    if (points.n == 0) return (struct mix_effort){0};
    mix_pressure_begin(model, stride, w, rho_e, a.value, b.value, &parts, &points);
    return mix_pressure_iterate(&points, p);
}
