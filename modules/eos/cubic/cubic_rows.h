/* cubic_rows.h - the functions of kind "eos" for the laws of cubic.h.
 *
 * The including module first defines CUBIC_ATTRACTION(par, T), which gives a struct cubic_attraction,
 * makes its instances with cubic_rows_open and lists these functions. All temperatures of a block come from a Newton
 * iteration in which a point that has converged no longer moves, so that its neighbours do not matter; implicit_rows.h
 * does the rest. */
#ifndef CUBIC_ROWS_H
#define CUBIC_ROWS_H

#include "bulla/eos.h"
#include "shared/continuation.h"
#include "cubic.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { IMPLICIT_BLOCK = 128, CUBIC_BLOCK = IMPLICIT_BLOCK, CUBIC_ROUNDS = 24 };

/* T = (p + ac q) w/R: the temperature if alpha were 1. */
BULLA_KERNEL static void cubic_rows_guess(const struct cubic *self, size_t n, const double *BULLA_RESTRICT rho,
                                          const double *BULLA_RESTRICT p, double *BULLA_RESTRICT T)
{
    const struct cubic par = *self;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        struct cubic_room room = cubic_room(&par, rho[i]);
        double guess = (p[i] + par.ac * room.q) / (par.R * room.per_w);
        T[i] = guess < par.T_min ? par.T_min : guess;
    }
}

/* A step for the points that still move; a step below 1e-8 is the last. Returns how many go on. */
BULLA_KERNEL static double cubic_rows_step(const struct cubic *self, size_t n, const double *BULLA_RESTRICT rho,
                                           const double *BULLA_RESTRICT p, double *BULLA_RESTRICT T,
                                           double *BULLA_RESTRICT moving)
{
    const struct cubic par = *self;
    double going = 0.0;
#pragma omp simd reduction(+ : going)
    for (size_t i = 0; i < n; i++) {
        double pressure = p[i], old = T[i], moves = moving[i];
        struct cubic_room room = cubic_room(&par, rho[i]);
        struct cubic_attraction pull = CUBIC_ATTRACTION(&par, old);
        double next = old + (pressure - cubic_pressure(&par, room, pull.a, old)) / cubic_p_T(&par, room, pull.a1);
        next = next < par.T_min ? par.T_min : next;
        double change = next - old, size = change < 0.0 ? -change : change;
        T[i] = moves > 0.0 ? next : old;
        moves = size > 1e-8 * old ? moves : 0.0;
        moving[i] = moves;
        going += moves;
    }
    return going;
}

static void cubic_rows_solve(const struct cubic *par, size_t n, const double *rho, const double *p, double *aid,
                             double *T)
{
    double moving[IMPLICIT_BLOCK];
    for (size_t i = 0; i < n; i++) aid[i] = 0.0; /* nobody asks for it */
    for (size_t i = 0; i < n; i++) moving[i] = 1.0;
    cubic_rows_guess(par, n, rho, p, T);
    for (int round = 0; round < CUBIC_ROUNDS; round++)
        if (cubic_rows_step(par, n, rho, p, T, moving) == 0.0) break;
    for (size_t i = 0; i < n; i++) T[i] = T[i] > par->T_min ? elementary_coarse(T[i]) : T[i];
}

/* A state with its continuation below T_min; the residual of the iteration goes the same way. */
ELEMENTARY_INLINE struct continuation_state cubic_rows_state_at(const struct cubic *par, double rho, double p,
                                                                double aid, double T)
{
    (void)aid;
    struct cubic_room room = cubic_room(par, rho);
    struct cubic_point at = cubic_point(par, room, CUBIC_ATTRACTION(par, T), T);
    double beyond = p - at.p, slope = room.v / at.G;
    double stiffening = at.stiffening < CUBIC_STIFFENING ? CUBIC_STIFFENING : at.stiffening;
    double e = at.e + beyond * slope, c2 = at.c2 + beyond * room.v * stiffening;
    c2 = p > 0.0 ? c2 : p * room.v;                        /* no tension */
    double e_c2 = at.c2 + beyond * room.v * at.stiffening; /* what this e says, positive or not */
    double warm = T + beyond * slope / at.cv;
    warm = warm < CUBIC_COLDEST ? CUBIC_COLDEST : warm;
    return (struct continuation_state){e, slope, c2, e + p * room.v - e_c2 / at.G, warm};
}

/* That of the potential where it ends, from there with cv. */
ELEMENTARY_INLINE double cubic_rows_entropy_at(const struct cubic *par, double rho, double aid, double T, double warm)
{
    (void)aid;
    struct cubic_room room = cubic_room(par, rho);
    struct cubic_attraction pull = CUBIC_ATTRACTION(par, T);
    double cv = par->R * cubic_ideal(par, T).cv + T * pull.a2 * room.L;
    return cubic_entropy(par, room, pull.a1, T) + cv * elementary_log(warm / T);
}

#define IMPLICIT(name) cubic_rows_##name
#define IMPLICIT_LAW struct cubic
#include "shared/implicit_rows.h"

/* rho(p, T) at a temperature of the law: Newton from a hard-core gas. NAN where it does not converge, as
 * it may below the critical point. */
static double cubic_rows_isotherm(const struct cubic *par, double p, double T)
{
    struct cubic_attraction pull = CUBIC_ATTRACTION(par, T);
    double rho = 1.0 / (par->b + par->R * T / (p > 1.0 ? p : 1.0));
    for (int i = 0; i < 40; i++) {
        struct cubic_room room = cubic_room(par, rho);
        double p_rho = room.v * room.v * (par->R * T * room.dper_w - pull.a * room.dq);
        double step = (p - cubic_pressure(par, room, pull.a, T)) / p_rho, least = -0.5 * rho;
        if (!(p_rho > 0.0)) return NAN;
        rho += step < least ? least : step;
        if (fabs(step) <= 1e-15 * rho) return rho;
    }
    return rho;
}

/* Where that does not help, by bisection. */
static double cubic_rows_density_at(const struct cubic *par, double p, double T)
{
    double rho = T > par->T_min ? cubic_rows_isotherm(par, p, T) : NAN;
    return rho > 0.0 ? rho : cubic_rows_bisect(par, p, T, (const double[2]){1e-12 / par->b, 20.0 / par->b}, 60);
}

/* Where c^2 ends in the continuation below T_min, but no tension: a gas bears none, however dense and cold it is. */
BULLA_KERNEL static void cubic_rows_p_min(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                          double *BULLA_RESTRICT p)
{
    const struct cubic par = *(const struct cubic *)self;
    const struct cubic_attraction pull = CUBIC_ATTRACTION(&par, par.T_min);
    const double cv0 = par.R * cubic_ideal(&par, par.T_min).cv, R = par.R, T = par.T_min;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        struct cubic_room room = cubic_room(&par, rho[i]);
        double v = room.v, p_T = cubic_p_T(&par, room, pull.a1), cv = cv0 + T * pull.a2 * room.L, G = v * p_T / cv;
        double c2 = v * v * (R * T * room.dper_w - pull.a * room.dq) + v * T * p_T * G;
        double stiffening = G + v * (R * room.dper_w - pull.a1 * room.dq) / p_T - v * T * pull.a2 * room.q / cv;
        stiffening = stiffening < CUBIC_STIFFENING ? CUBIC_STIFFENING : stiffening;
        double low = cubic_pressure(&par, room, pull.a, T) - c2 / (v * stiffening);
        p[i] = low > 0.0 ? low : 0.0;
    }
}

/* Beyond the edge of the co-volume, or colder than T_min. */
static size_t cubic_rows_count_outside(const void *instance, size_t n, const double *BULLA_RESTRICT rho,
                                       const double *BULLA_RESTRICT p)
{
    const struct cubic *self = instance;
    double a = CUBIC_ATTRACTION(self, self->T_min).a;
    size_t count = 0;
    for (size_t i = 0; i < n; i++) {
        int within = rho[i] * self->vx <= 1.0 && p[i] >= cubic_pressure(self, cubic_room(self, rho[i]), a, self->T_min);
        count += !within;
    }
    return count;
}

/* Up to where the co-volume takes over; from above the critical point, where one density belongs to p and T,
 * to temperatures at which real molecules break. */
static void cubic_rows_range(const void *self, struct bulla_eos_range *ret_range)
{
    const struct cubic *par = self;
    double dense = 0.85 / par->b, warm = 1.01 * (par->T_min > par->Tc ? par->T_min : par->Tc), least;
    cubic_rows_p_min(self, 1, &dense, &least);
    *ret_range = (struct bulla_eos_range){.rho_min = 0.0,
                                          .rho_max = dense,
                                          .p_min = least > 1.0 ? least : 1.0,
                                          .p_max = 1e10,
                                          .T_min = warm,
                                          .T_max = warm > 3000.0 ? 2.0 * warm : 6000.0};
}

/* dp/dT > 0 at all densities and temperatures, c^2 > 0 on the coldest isotherm: looked at on a grid. */
static int cubic_rows_check(const struct bulla_host *host, const struct cubic *par)
{
    char text[200];
    for (int i = 0; i <= 400; i++) {
        struct cubic_room room = cubic_room(par, 1e-3 / par->b * pow(5000.0, i / 400.0));
        for (double T = par->T_min; T < 1e5; T *= 1.3) {
            struct cubic_point at = cubic_point(par, room, CUBIC_ATTRACTION(par, T), T);
            if (at.G > 0.0 && at.cv > 0.0 && at.c2 > 0.0) continue;
            snprintf(text, sizeof text,
                     "at %.5g kg/m3, %.5g K the law has cv %.3g, Grueneisen coefficient %.3g, c^2 %.3g: raise t-min",
                     1.0 / room.v, T, at.cv, at.G, at.c2);
            host->fail(text);
            return 1;
        }
    }
    return 0;
}

/* Completes `par` (the edges of its continuations and the zero of entropy) and makes an instance of
 * `size` bytes that begins with it. */
static int cubic_rows_open(const struct bulla_host *host, struct cubic par, size_t size, void **ret_self)
{
    par.vx = par.b / CUBIC_EDGE;
    par.d = par.vx - par.b;
    par.v_pole = par.d2 < 0.0 ? par.vx : 0.0;
    par.entropy = par.R * log(CUBIC_ZERO_P / (par.R * CUBIC_ZERO_T)) - par.R * cubic_ideal(&par, CUBIC_ZERO_T).s;
    if (cubic_rows_check(host, &par)) return 1;
    struct cubic *self = calloc(1, size);
    if (!self) {
        host->fail("out of memory");
        return 1;
    }
    *self = par;
    *ret_self = self;
    return 0;
}

/* The parameters that the laws share, and their values for air; cp0 fitted to NASA's tables of N2, O2
 * and Ar within 0.15 % from 200 K to 6000 K. */
#define CUBIC_PARAMS                                                                                                \
    {"molar-mass", "kg/mol", 1e-4, 10.0, 0.02896546, "mass of a mole", BULLA_NUMBER, NULL},                         \
        {"critical-temperature", "K", 1.0, 1e4, 132.6306, "temperature of the critical point", BULLA_NUMBER, NULL}, \
        {"critical-pressure", "Pa", 1e3, 1e10, 3.786e6, "pressure of the critical point", BULLA_NUMBER, NULL},      \
        {"acentric-factor", "1", -1.0, 2.0, 0.0335, "acentric factor", BULLA_NUMBER, NULL},                         \
        {"heat", "1", 1.5, 100.0, 3.490888, "cp0/R of the ideal gas without vibrations", BULLA_NUMBER, NULL},       \
        {"vibration-1", "1", 0.0, 100.0, 0.90564, "weight of the first vibration in cp0/R", BULLA_NUMBER, NULL},    \
        {"vibration-1-at", "K", 1.0, 1e6, 2899.0, "its temperature", BULLA_NUMBER, NULL},                           \
        {"vibration-2", "1", 0.0, 100.0, 0.25385, "weight of the second vibration", BULLA_NUMBER, NULL},            \
        {"vibration-2-at", "K", 1.0, 1e6, 6847.6, "its temperature", BULLA_NUMBER, NULL},                           \
        {"vibration-3", "1", 0.0, 100.0, 0.35106, "weight of the third vibration", BULLA_NUMBER, NULL},             \
        {"vibration-3-at", "K", 1.0, 1e6, 22104.0, "its temperature", BULLA_NUMBER, NULL},                          \
    {                                                                                                               \
        "t-min", "K", 1.0, 1e4, 100.0, "coldest state of the law; below it goes on linearly in pressure",           \
            BULLA_NUMBER, NULL                                                                                      \
    }
#define CUBIC_AIR \
    0.02896546, 132.6306, 3.786e6, 0.0335, 3.490888, 0.90564, 2899.0, 0.25385, 6847.6, 0.35106, 22104.0, 100.0

enum { CUBIC_MASS, CUBIC_TC, CUBIC_PC, CUBIC_OMEGA, CUBIC_HEAT, CUBIC_FIRST, CUBIC_T_MIN = 11, CUBIC_OWN };

/* What the shared parameters say. */
static struct cubic cubic_rows_read(const struct bulla_value *values)
{
    struct cubic par = {.R = CUBIC_GAS / values[CUBIC_MASS].number,
                        .Tc = values[CUBIC_TC].number,
                        .heat = values[CUBIC_HEAT].number,
                        .T_min = values[CUBIC_T_MIN].number};
    for (int i = 0; i < CUBIC_MODES; i++) {
        par.n[i] = values[CUBIC_FIRST + 2 * i].number;
        par.theta[i] = values[CUBIC_FIRST + 2 * i + 1].number;
    }
    return par;
}

#endif
