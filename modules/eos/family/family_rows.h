/* family_rows.h - the functions of kind "eos" for the family of family.h.
 *
 * The including module first defines FAMILY_ROOM, either family_room_all or family_room_left,
 * then opens its instances with family_rows_open and fills its table with FAMILY_TABLE(range). */
#ifndef FAMILY_ROWS_H
#define FAMILY_ROWS_H

#include "bulla/eos.h"
#include "family.h"

#include <stdlib.h>

/* What the parameter q' is for. */
#define FAMILY_ENTROPY_ZERO "zero of entropy; what it differs by between two phases decides where they boil"

BULLA_KERNEL static void family_rows_state(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                           const double *BULLA_RESTRICT p, double *BULLA_RESTRICT rho_e,
                                           double *BULLA_RESTRICT rho_c2)
{
    const struct family par = *(const struct family *)self;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double density = rho[i], pressure = p[i];
        struct family_room room = FAMILY_ROOM(&par, density);
        rho_e[i] = family_slope(&par, room) * pressure + family_rest(&par, room, density);
        rho_c2[i] = family_stiffness(&par, room, pressure);
    }
}

BULLA_KERNEL static void family_rows_derivatives(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                                 const double *BULLA_RESTRICT p, double *BULLA_RESTRICT de_dp,
                                                 double *BULLA_RESTRICT de_drho)
{
    const struct family par = *(const struct family *)self;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double density = rho[i], pressure = p[i];
        struct family_room room = FAMILY_ROOM(&par, density);
        de_dp[i] = family_slope(&par, room);
        de_drho[i] = family_de_drho(&par, room, density, pressure);
    }
}

BULLA_KERNEL static void family_rows_temperature(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                                 const double *BULLA_RESTRICT p, double *BULLA_RESTRICT T)
{
    const struct family par = *(const struct family *)self;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double density = rho[i], pressure = p[i];
        T[i] = family_temperature(&par, FAMILY_ROOM(&par, density), density, pressure);
    }
}

BULLA_KERNEL static void family_rows_density(const void *self, size_t n, const double *BULLA_RESTRICT p,
                                             const double *BULLA_RESTRICT T, double *BULLA_RESTRICT rho)
{
    const struct family par = *(const struct family *)self;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double pressure = p[i], temperature = T[i];
        rho[i] = family_density(&par, pressure, temperature);
    }
}

BULLA_KERNEL static void family_rows_linear(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                            double *BULLA_RESTRICT a, double *BULLA_RESTRICT b)
{
    const struct family par = *(const struct family *)self;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double density = rho[i];
        struct family_room room = FAMILY_ROOM(&par, density);
        a[i] = family_slope(&par, room);
        b[i] = family_rest(&par, room, density);
    }
}

/* log is no vector function without leave to change values, so this row stays scalar. */
static void family_rows_entropy(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                const double *BULLA_RESTRICT p, double *BULLA_RESTRICT s)
{
    const struct family *par = self;
    for (size_t i = 0; i < n; i++) s[i] = family_entropy(par, FAMILY_ROOM(par, rho[i]), rho[i], p[i]);
}

static void family_rows_p_min(const void *self, size_t n, const double *BULLA_RESTRICT rho, double *BULLA_RESTRICT p)
{
    const struct family *par = self;
    (void)rho;
    for (size_t i = 0; i < n; i++) p[i] = -par->p_inf;
}

/* Beyond the edge of the co-volume, where there is one. */
BULLA_KERNEL static size_t family_rows_count_outside(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                                     const double *BULLA_RESTRICT p)
{
    double b = ((const struct family *)self)->b, count = 0.0;
    (void)p;
    if (b == 0.0) return 0;
#pragma omp simd reduction(+ : count)
    for (size_t i = 0; i < n; i++) count += b * rho[i] > FAMILY_EDGE ? 1.0 : 0.0;
    return (size_t)count;
}

BULLA_KERNEL static void family_rows_thermal(const void *self, size_t n, const double *BULLA_RESTRICT p,
                                             const double *BULLA_RESTRICT T, double *BULLA_RESTRICT rho,
                                             double *BULLA_RESTRICT v, double *BULLA_RESTRICT h,
                                             double *BULLA_RESTRICT s, double *BULLA_RESTRICT v_T,
                                             double *BULLA_RESTRICT v_p, double *BULLA_RESTRICT c_p)
{
    const struct family par = *(const struct family *)self;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double pressure = p[i], temperature = T[i];
        struct family_thermal at = family_thermal(&par, pressure, temperature);
        rho[i] = 1.0 / at.v;
        v[i] = at.v;
        h[i] = at.h;
        s[i] = at.s;
        v_T[i] = at.v_T;
        v_p[i] = at.v_p;
        c_p[i] = at.c_p;
    }
}

/* A gas is what nothing holds together. */
static double family_rows_gas_constant(const void *self)
{
    const struct family *par = self;
    return par->p_inf > 0.0 ? 0.0 : par->cv / par->inverse;
}

/* Makes an instance; the caller's `par` needs no `inverse`. */
static int family_rows_open(const struct bulla_host *host, struct family par, void **ret_self)
{
    struct family *self = malloc(sizeof *self);
    if (!self) {
        host->fail("out of memory");
        return 1;
    }
    par.inverse = 1.0 / (par.gamma - 1.0);
    *self = par;
    *ret_self = self;
    return 0;
}

static void family_rows_close(void *self)
{
    free(self);
}

#define FAMILY_TABLE(range_function)                                                                            \
    {                                                                                                           \
        .size = sizeof(struct bulla_eos), .state = family_rows_state, .derivatives = family_rows_derivatives,   \
        .temperature = family_rows_temperature, .entropy = family_rows_entropy, .density = family_rows_density, \
        .p_min = family_rows_p_min, .linear = family_rows_linear, .range = (range_function),                    \
        .count_outside = family_rows_count_outside, .thermal = family_rows_thermal,                             \
        .gas_constant = family_rows_gas_constant                                                                \
    }

#endif
