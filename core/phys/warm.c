/* warm.c - see warm.h. Mixed cells are gathered; each stands still once its own fractions do. */
#include "phys/warm.h"

#include "phys/mix.h"
#include "phys/row.h"
#include "phys/traction.h"

#include <math.h>
#include <string.h>

enum { WARM_BATCH = 256, WARM_ROUNDS = 40 };
_Static_assert(WARM_BATCH <= (int)TRACTION_BATCH, "lags of a batch are found at once");

/* A fraction stands still when it moves by less than this part of itself, or by what is round-off in its liquid. */
#define WARM_STILL 1e-12
#define WARM_NOISE 1e-15

/* No step of Newton's method takes more than this part of a fraction, or of what a pressure is above the least of a
 * material. */
#define WARM_MOST 0.75

/* A material in the gathered cells. Where it is not, its fraction is 0. */
struct warm_material {
    double alpha[WARM_BATCH], before[WARM_BATCH], mass[WARM_BATCH], fill[WARM_BATCH];
    double energy[WARM_BATCH];                 /* (alpha rho e)^0 + H */
    double lag[WARM_BATCH], work[WARM_BATCH];  /* of its pressure, and of that at which it pushes */
    double want[WARM_BATCH], give[WARM_BATCH]; /* d alpha = want - give dp */
};

struct warm {
    const struct model *model;
    size_t n, at[WARM_BATCH];
    double p[WARM_BATCH], before[WARM_BATCH], part[WARM_BATCH], moves[WARM_BATCH];
    double room[WARM_BATCH]; /* that p has to fall */
    struct warm_material of[SCENE_MATERIALS];
};

/* Is a cell mixed, and has somebody in it got heat? */
static bool warm_wanted(const struct model *model, size_t stride, const double *w, const double *heat)
{
    unsigned present = 0;
    bool warm = false;
    for (unsigned l = 0; l < model->n_alpha; l++) {
        if (!(w[(model->i_alpha + l) * stride] > MIX_ABSENT)) continue;
        present++;
        warm = warm || heat[l * stride] != 0.0;
    }
    return warm && present > 1;
}

/* rho_l, its fill density where there is nothing of it, and p_l. */
static BULLA_KERNEL void warm_state(size_t n, const double *restrict alpha, const double *restrict mass,
                                    const double *restrict fill, const double *restrict p, const double *restrict lag,
                                    double *restrict rho, double *restrict own)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], there = a > 0.0 ? a : 1.0, density = mass[i] / there;
        rho[i] = a > 0.0 ? density : fill[i];
        own[i] = p[i] + lag[i];
    }
}

/* What a material lacks of its energy, as volume: d alpha = want - give dp from
 * d(alpha rho e) = alpha e_p dp + (e_p rho c^2 - p_l) d alpha and the work of pi. */
static BULLA_KERNEL void warm_slope(size_t n, const double *restrict alpha, const double *restrict before,
                                    const double *restrict energy, const double *restrict work,
                                    const double *restrict pi, const double *restrict p, const double *restrict rho_e,
                                    const double *restrict rho_c2, const double *restrict e_p, double *restrict want,
                                    double *restrict give)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], moved = a - before[i], push = pi[i] + work[i], slope = e_p[i];
        double lacks = energy[i] - push * moved - a * rho_e[i], stiff = slope * rho_c2[i] - p[i] + push;
        double more = lacks / stiff, less = (a * slope + 0.5 * moved) / stiff;
        want[i] = a > 0.0 ? more : 0.0;
        give[i] = a > 0.0 ? less : 0.0;
    }
}

static BULLA_KERNEL void warm_push(size_t n, const double *restrict before, const double *restrict p,
                                   double *restrict pi)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) pi[i] = 0.5 * (before[i] + p[i]);
}

/* The largest part of a step that leaves something of a fraction. */
static BULLA_KERNEL void warm_part(size_t n, const double *restrict alpha, const double *restrict want,
                                   const double *restrict give, const double *restrict dp, double *restrict part)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double step = want[i] - give[i] * dp[i], most = -WARM_MOST * alpha[i], own = most / step, least = part[i];
        own = step < most ? own : 1.0;
        part[i] = own < least ? own : least;
    }
}

/* How far a pressure may fall: a gas that its cell expands is thin at last, not in tension. */
static BULLA_KERNEL void warm_space(size_t n, const double *restrict alpha, const double *restrict p,
                                    const double *restrict least, double *restrict room)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double above = p[i] - least[i], own = above > 0.0 ? above : HUGE_VAL, r = room[i];
        own = alpha[i] > 0.0 ? own : HUGE_VAL;
        room[i] = own < r ? own : r;
    }
}

static BULLA_KERNEL void warm_fall(size_t n, const double *restrict room, const double *restrict dp,
                                   double *restrict part)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double most = -WARM_MOST * room[i], step = dp[i], own = most / step, least = part[i];
        own = step < most ? own : 1.0;
        part[i] = own < least ? own : least;
    }
}

/* alpha += part (want - give dp) where a cell moves; whether it moved by much. */
static BULLA_KERNEL void warm_move(size_t n, const double *restrict want, const double *restrict give,
                                   const double *restrict dp, const double *restrict part, const double *restrict moves,
                                   double *restrict alpha, double *restrict far)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], step = part[i] * (want[i] - give[i] * dp[i]), f = far[i];
        double size = step < 0.0 ? -step : step, more = size > part[i] * (WARM_STILL * a + WARM_NOISE) ? 1.0 : f,
               next = a + step;
        far[i] = more;
        alpha[i] = moves[i] > 0.0 ? next : a;
    }
}

static BULLA_KERNEL void warm_rise(size_t n, const double *restrict dp, const double *restrict part,
                                   const double *restrict far, double *restrict p, double *restrict moves)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double before = p[i], next = before + part[i] * dp[i], still = moves[i], on = far[i] > 0.0 ? still : 0.0;
        p[i] = still > 0.0 ? next : before;
        moves[i] = on;
    }
}

/* want and give of all materials, and dp, which keeps the sum of the fractions. */
static void warm_look(struct warm *warm, double *dp)
{
    size_t n = warm->n;
    double pi[WARM_BATCH], rho[WARM_BATCH], p[WARM_BATCH], rho_e[WARM_BATCH], rho_c2[WARM_BATCH], e_p[WARM_BATCH],
        e_rho[WARM_BATCH], sum[WARM_BATCH], least[WARM_BATCH];
    for (size_t i = 0; i < n; i++) warm->room[i] = HUGE_VAL;
    warm_push(n, warm->before, warm->p, pi);
    memset(dp, 0, n * sizeof *dp);
    memset(sum, 0, n * sizeof *sum);
    for (unsigned l = 0; l < warm->model->n_alpha; l++) {
        struct warm_material *m = &warm->of[l];
        const struct model_eos *eos = &warm->model->eos[l];
        warm_state(n, m->alpha, m->mass, m->fill, warm->p, m->lag, rho, p);
        eos->law->state(eos->self, n, rho, p, rho_e, rho_c2);
        eos->law->derivatives(eos->self, n, rho, p, e_p, e_rho);
        eos->law->p_min(eos->self, n, rho, least);
        warm_space(n, m->alpha, p, least, warm->room);
        warm_slope(n, m->alpha, m->before, m->energy, m->work, pi, p, rho_e, rho_c2, e_p, m->want, m->give);
        row_add(n, m->want, dp);
        row_add(n, m->give, sum);
    }
    row_divide(n, sum, dp);
}

/* One step of Newton's method; returns how many cells still move. */
static double warm_round(struct warm *warm)
{
    size_t n = warm->n;
    double dp[WARM_BATCH], far[WARM_BATCH], count = 0.0;
    warm_look(warm, dp);
    memset(far, 0, n * sizeof *far);
    for (size_t i = 0; i < n; i++) warm->part[i] = 1.0;
    warm_fall(n, warm->room, dp, warm->part);
    for (unsigned l = 0; l < warm->model->n_alpha; l++)
        warm_part(n, warm->of[l].alpha, warm->of[l].want, warm->of[l].give, dp, warm->part);
    for (unsigned l = 0; l < warm->model->n_alpha; l++)
        warm_move(n, warm->of[l].want, warm->of[l].give, dp, warm->part, warm->moves, warm->of[l].alpha, far);
    warm_rise(n, dp, warm->part, far, warm->p, warm->moves);
    for (size_t i = 0; i < n; i++) count += warm->moves[i];
    return count;
}

/* Adds a cell to the batch. */
static void warm_take(struct warm *warm, size_t stride, size_t cell, const double *w, const double *heat,
                      const struct traction_pressures *parts)
{
    const struct model *model = warm->model;
    size_t k = warm->n++;
    warm->at[k] = cell;
    warm->p[k] = warm->before[k] = w[model->i_E * stride + cell];
    warm->moves[k] = 1.0;
    for (unsigned l = 0; l < model->n_alpha; l++) {
        struct warm_material *m = &warm->of[l];
        double alpha = w[(model->i_alpha + l) * stride + cell], rho = w[(model->i_m + l) * stride + cell];
        bool there = alpha > MIX_ABSENT;
        m->alpha[k] = m->before[k] = there ? alpha : 0.0;
        m->mass[k] = alpha * rho;
        m->fill[k] = rho;
        m->energy[k] = there ? heat[l * stride + cell] : 0.0;
        m->lag[k] = model->lagged ? parts->lag[l][cell] : 0.0;
        m->work[k] = model->split ? 0.0 : m->lag[k];
    }
}

/* (alpha rho e)^0 to the heat. */
static void warm_begin(struct warm *warm)
{
    size_t n = warm->n;
    double rho[WARM_BATCH], p[WARM_BATCH], rho_e[WARM_BATCH], rho_c2[WARM_BATCH];
    for (unsigned l = 0; l < warm->model->n_alpha; l++) {
        struct warm_material *m = &warm->of[l];
        const struct model_eos *eos = &warm->model->eos[l];
        warm_state(n, m->alpha, m->mass, m->fill, warm->p, m->lag, rho, p);
        eos->law->state(eos->self, n, rho, p, rho_e, rho_c2);
        row_add_product(n, m->alpha, rho_e, m->energy);
    }
}

/* Fractions of cell k of the batch into u, and what its surfaces have stored out of its energy. */
static void warm_give(const struct warm *warm, size_t k, size_t stride, double *u)
{
    const struct model *model = warm->model;
    bool good = warm->moves[k] == 0.0;
    for (unsigned l = 0; l < model->n_alpha; l++) good = good && isfinite(warm->of[l].alpha[k]);
    if (!good) return;
    for (unsigned l = 0; l < model->n_alpha; l++) {
        const struct warm_material *m = &warm->of[l];
        double moved = m->alpha[k] - m->before[k];
        u[(model->i_alpha + l) * stride + warm->at[k]] += moved;
        u[model->i_E * stride + warm->at[k]] -= m->work[k] * moved;
    }
}

static void warm_batch(const struct model *model, size_t n, size_t stride, const double *w, const double *heat,
                       double *u)
{
    struct warm warm; /* large: filled as far as it is used */
    struct traction_pressures parts;
    warm.model = model;
    warm.n = 0;
    for (size_t i = 0; i < n; i++) {
        if (!warm_wanted(model, stride, w + i, heat + i)) continue;
        if (!warm.n) traction_part(model, n, stride, w, &parts);
        warm_take(&warm, stride, i, w, heat, &parts);
    }
    if (!warm.n) return;
    warm_begin(&warm);
    for (int round = 0; round < WARM_ROUNDS && warm_round(&warm) > 0.0; round++) {
    }
    for (size_t k = 0; k < warm.n; k++) warm_give(&warm, k, stride, u);
}

void warm_mix(const struct model *model, size_t n, size_t stride, const double *w, const double *heat, double *u)
{
    for (size_t i = 0; i < n; i += WARM_BATCH)
        warm_batch(model, n - i < WARM_BATCH ? n - i : WARM_BATCH, stride, w + i, heat + i, u + i);
}
