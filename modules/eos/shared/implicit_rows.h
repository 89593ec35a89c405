/* implicit_rows.h - the functions of kind "eos" for laws that are a potential in density and temperature, so that (rho,
 * p) -> T takes an iteration.
 *
 * A row is done in blocks: first all temperatures, then what is asked for at them. The including module first defines
 * IMPLICIT(name), which makes the names of its functions, IMPLICIT_LAW, its struct, IMPLICIT_BLOCK, the points of a
 * block, and void IMPLICIT(solve)(law, n, rho, p, aid, T)      temperatures of n <= IMPLICIT_BLOCK points; `aid`: a row
 * that it may fill for the next two, struct continuation_state IMPLICIT(state_at)(law, rho, p, aid, T), double
 * IMPLICIT(entropy_at)(law, rho, aid, T, warm)  at T, where the potential ends, and from there to `warm`, and finds
 * IMPLICIT(state), (derivatives), (energy), (temperature), (entropy) and (density) made; the last from double
 * IMPLICIT(density_at)(law, p, T), which it defines below, with the help of IMPLICIT(bisect). */
#ifndef IMPLICIT_ROWS_H
#define IMPLICIT_ROWS_H

#include "bulla/eos.h"
#include "continuation.h"

#include <math.h>

#define IMPLICIT_KERNEL(name)                                                                                   \
    BULLA_KERNEL static void IMPLICIT(name)(const IMPLICIT_LAW *self, size_t n,                                 \
                                            const double *const BULLA_RESTRICT *in, double *BULLA_RESTRICT one, \
                                            double *BULLA_RESTRICT two)

IMPLICIT_KERNEL(state_block)
{
    const IMPLICIT_LAW par = *self;
    const double *BULLA_RESTRICT rho = in[0], *BULLA_RESTRICT p = in[1], *BULLA_RESTRICT aid = in[2],
                                 *BULLA_RESTRICT T = in[3];
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double density = rho[i];
        struct continuation_state state = IMPLICIT(state_at)(&par, density, p[i], aid[i], T[i]);
        one[i] = density * state.e;
        two[i] = density * state.c2;
    }
}

IMPLICIT_KERNEL(derivatives_block)
{
    const IMPLICIT_LAW par = *self;
    const double *BULLA_RESTRICT rho = in[0], *BULLA_RESTRICT p = in[1], *BULLA_RESTRICT aid = in[2],
                                 *BULLA_RESTRICT T = in[3];
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double density = rho[i];
        struct continuation_state state = IMPLICIT(state_at)(&par, density, p[i], aid[i], T[i]);
        one[i] = density * state.e_p;
        two[i] = state.de_drho;
    }
}

IMPLICIT_KERNEL(energy_block)
{
    const IMPLICIT_LAW par = *self;
    const double *BULLA_RESTRICT rho = in[0], *BULLA_RESTRICT p = in[1], *BULLA_RESTRICT aid = in[2],
                                 *BULLA_RESTRICT T = in[3];
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double density = rho[i];
        struct continuation_state state = IMPLICIT(state_at)(&par, density, p[i], aid[i], T[i]);
        one[i] = density * state.e;
        two[i] = density * state.e_p;
    }
}

/* Temperature and entropy. */
IMPLICIT_KERNEL(thermal_block)
{
    const IMPLICIT_LAW par = *self;
    const double *BULLA_RESTRICT rho = in[0], *BULLA_RESTRICT p = in[1], *BULLA_RESTRICT aid = in[2],
                                 *BULLA_RESTRICT T = in[3];
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double density = rho[i], potential = T[i], help = aid[i];
        struct continuation_state state = IMPLICIT(state_at)(&par, density, p[i], help, potential);
        one[i] = state.T;
        two[i] = IMPLICIT(entropy_at)(&par, density, help, potential, state.T);
    }
}

typedef void IMPLICIT(block)(const IMPLICIT_LAW *self, size_t n, const double *const BULLA_RESTRICT *in,
                             double *BULLA_RESTRICT one, double *BULLA_RESTRICT two);

/* Runs `block` over a row; one of the results may be unwanted. */
static void IMPLICIT(run)(const IMPLICIT_LAW *self, size_t n, const double *const in[2], double *const out[2],
                          IMPLICIT(block) * block)
{
    double aid[IMPLICIT_BLOCK], T[IMPLICIT_BLOCK], spare[IMPLICIT_BLOCK];
    for (size_t i = 0; i < n; i += IMPLICIT_BLOCK) {
        size_t m = n - i < IMPLICIT_BLOCK ? n - i : IMPLICIT_BLOCK;
        IMPLICIT(solve)(self, m, in[0] + i, in[1] + i, aid, T);
        block(self, m, (const double *const[]){in[0] + i, in[1] + i, aid, T}, out[0] ? out[0] + i : spare,
              out[1] ? out[1] + i : spare);
    }
}

static void IMPLICIT(state)(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                            const double *BULLA_RESTRICT p, double *BULLA_RESTRICT rho_e, double *BULLA_RESTRICT rho_c2)
{
    IMPLICIT(run)(self, n, (const double *const[2]){rho, p}, (double *const[2]){rho_e, rho_c2}, IMPLICIT(state_block));
}

static void IMPLICIT(derivatives)(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                  const double *BULLA_RESTRICT p, double *BULLA_RESTRICT de_dp,
                                  double *BULLA_RESTRICT de_drho)
{
    IMPLICIT(run)
    (self, n, (const double *const[2]){rho, p}, (double *const[2]){de_dp, de_drho}, IMPLICIT(derivatives_block));
}

static void IMPLICIT(energy)(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                             const double *BULLA_RESTRICT p, double *BULLA_RESTRICT rho_e, double *BULLA_RESTRICT de_dp)
{
    IMPLICIT(run)(self, n, (const double *const[2]){rho, p}, (double *const[2]){rho_e, de_dp}, IMPLICIT(energy_block));
}

static void IMPLICIT(temperature)(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                  const double *BULLA_RESTRICT p, double *BULLA_RESTRICT T)
{
    IMPLICIT(run)(self, n, (const double *const[2]){rho, p}, (double *const[2]){T, NULL}, IMPLICIT(thermal_block));
}

static void IMPLICIT(entropy)(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                              const double *BULLA_RESTRICT p, double *BULLA_RESTRICT s)
{
    IMPLICIT(run)(self, n, (const double *const[2]){rho, p}, (double *const[2]){NULL, s}, IMPLICIT(thermal_block));
}

/* The density between two at which the temperature is T: it falls with rho at constant p. Halves ln rho. */
static double IMPLICIT(bisect)(const IMPLICIT_LAW *self, double p, double T, const double ends[2], int rounds)
{
    double low = log(ends[0]), high = log(ends[1]);
    for (int i = 0; i < rounds; i++) {
        double mean = 0.5 * (low + high), density = exp(mean), at;
        IMPLICIT(temperature)(self, 1, &density, &p, &at);
        if (at > T) low = mean;
        else high = mean;
    }
    return exp(0.5 * (low + high));
}

static double IMPLICIT(density_at)(const IMPLICIT_LAW *self, double p, double T);

static void IMPLICIT(density)(const void *self, size_t n, const double *BULLA_RESTRICT p,
                              const double *BULLA_RESTRICT T, double *BULLA_RESTRICT rho)
{
    for (size_t i = 0; i < n; i++) rho[i] = IMPLICIT(density_at)(self, p[i], T[i]);
}

#endif
