/* reference_rows.h - functions of kind "eos" for laws that are a reference curve, an isentrope, with a constant
 * Grueneisen coefficient off it:
 *
 *     p = p_r(rho) + G rho (e - e_r),   p_r = -de_r/dv,   T = T0 x^G + (e - e_r)/cv,   x = rho/rho0,
 *     s = cv ln(T/T0 x^-G),   rho c^2 = rho c_r^2 + (1 + G)(p - p_r)
 *
 * (Menikoff & Plohr 1989, Rev. Mod. Phys. 61, 75, section IV). rho c^2 is positive above p_min = p_r - rho c_r^2/(1 +
 * G) at every density: nothing needs a continuation but T, which stays at 1 K where the formula falls below.
 *
 * The including module first defines `struct reference` with rho0, G, T0, cv and scale (of temperatures in the entropy:
 * T0 where that is not 0) among its members, `struct reference_curve` with x, p, energy (rho e_r) and stiffness (rho
 * c_r^2), REFERENCE_CURVE(par, rho) and, of a density to begin with, REFERENCE_GUESS(par, p, T); then it includes this,
 * and fills its table with REFERENCE_TABLE(range). */
#ifndef REFERENCE_ROWS_H
#define REFERENCE_ROWS_H

#include <math.h>
#include <stdlib.h>

#define REFERENCE_COLDEST 1.0 /* K */

ELEMENTARY_INLINE double reference_rows_rest(const struct reference *par, struct reference_curve curve)
{
    return curve.energy - curve.p / par->G;
}

ELEMENTARY_INLINE double reference_rows_heat(const struct reference *par, struct reference_curve curve, double rho,
                                             double p)
{
    double T = par->T0 * elementary_pow(curve.x, par->G) + (p - curve.p) / (par->G * rho * par->cv);
    return T > REFERENCE_COLDEST || T != T ? T : REFERENCE_COLDEST;
}

BULLA_KERNEL static void reference_rows_state(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                              const double *BULLA_RESTRICT p, double *BULLA_RESTRICT rho_e,
                                              double *BULLA_RESTRICT rho_c2)
{
    const struct reference par = *(const struct reference *)self;
    const double slope = 1.0 / par.G;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double density = rho[i], pressure = p[i];
        struct reference_curve curve = REFERENCE_CURVE(&par, density);
        rho_e[i] = slope * pressure + reference_rows_rest(&par, curve);
        rho_c2[i] = curve.stiffness + (pressure - curve.p) * (1.0 + par.G);
    }
}

/* d(rho e)/drho = e_r + p_r/rho - c_r^2/G at constant p */
BULLA_KERNEL static void reference_rows_derivatives(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                                    const double *BULLA_RESTRICT p, double *BULLA_RESTRICT de_dp,
                                                    double *BULLA_RESTRICT de_drho)
{
    const struct reference par = *(const struct reference *)self;
    const double slope = 1.0 / par.G;
    (void)p;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double density = rho[i];
        struct reference_curve curve = REFERENCE_CURVE(&par, density);
        de_dp[i] = slope;
        de_drho[i] = (curve.energy + curve.p - curve.stiffness / par.G) / density;
    }
}

BULLA_KERNEL static void reference_rows_temperature(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                                    const double *BULLA_RESTRICT p, double *BULLA_RESTRICT T)
{
    const struct reference par = *(const struct reference *)self;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double density = rho[i], pressure = p[i];
        T[i] = reference_rows_heat(&par, REFERENCE_CURVE(&par, density), density, pressure);
    }
}

BULLA_KERNEL static void reference_rows_entropy(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                                const double *BULLA_RESTRICT p, double *BULLA_RESTRICT s)
{
    const struct reference par = *(const struct reference *)self;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double density = rho[i], pressure = p[i];
        struct reference_curve curve = REFERENCE_CURVE(&par, density);
        double T = reference_rows_heat(&par, curve, density, pressure);
        s[i] = par.cv * (elementary_log(T / par.scale) - par.G * elementary_log(curve.x));
    }
}

/* Newton in rho on p_r + G rho cv (T - T0 x^G) = p from REFERENCE_GUESS; a step
 * changes it by a factor of 2 at most. */
static double reference_rows_density_at(const struct reference *par, double p, double T)
{
    double rho = REFERENCE_GUESS(par, p, T), heat = par->G * par->cv;
    for (int step = 0; step < 50; step++) {
        struct reference_curve curve = REFERENCE_CURVE(par, rho);
        double cold = par->T0 * elementary_pow(curve.x, par->G);
        double slope = curve.stiffness / rho + heat * (T - (1.0 + par->G) * cold);
        double next = rho - (curve.p + heat * rho * (T - cold) - p) / slope;
        next = slope > 0.0 ? next : 2.0 * rho;
        next = next > 0.5 * rho ? next : 0.5 * rho;
        next = next < 2.0 * rho ? next : 2.0 * rho;
        if (fabs(next - rho) <= 1e-15 * rho) return next;
        rho = next;
    }
    return rho;
}

static void reference_rows_density(const void *self, size_t n, const double *BULLA_RESTRICT p,
                                   const double *BULLA_RESTRICT T, double *BULLA_RESTRICT rho)
{
    for (size_t i = 0; i < n; i++) rho[i] = reference_rows_density_at(self, p[i], T[i]);
}

BULLA_KERNEL static void reference_rows_p_min(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                              double *BULLA_RESTRICT p)
{
    const struct reference par = *(const struct reference *)self;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        struct reference_curve curve = REFERENCE_CURVE(&par, rho[i]);
        p[i] = curve.p - curve.stiffness / (1.0 + par.G);
    }
}

BULLA_KERNEL static void reference_rows_linear(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                               double *BULLA_RESTRICT a, double *BULLA_RESTRICT b)
{
    const struct reference par = *(const struct reference *)self;
    const double slope = 1.0 / par.G;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double density = rho[i];
        a[i] = slope;
        b[i] = reference_rows_rest(&par, REFERENCE_CURVE(&par, density));
    }
}

/* Where T is held. */
static size_t reference_rows_count_outside(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                           const double *BULLA_RESTRICT p)
{
    size_t count = 0;
    for (size_t i = 0; i < n; i++)
        count += reference_rows_heat(self, REFERENCE_CURVE(self, rho[i]), rho[i], p[i]) <= REFERENCE_COLDEST;
    return count;
}

#define REFERENCE_TABLE(range_function)                                                                             \
    {                                                                                                               \
        .size = sizeof(struct bulla_eos), .state = reference_rows_state, .derivatives = reference_rows_derivatives, \
        .temperature = reference_rows_temperature, .entropy = reference_rows_entropy,                               \
        .density = reference_rows_density, .p_min = reference_rows_p_min, .linear = reference_rows_linear,          \
        .range = (range_function), .count_outside = reference_rows_count_outside                                    \
    }

/* Keeps an instance. */
static int reference_rows_keep(const struct bulla_host *host, const struct reference *par, void **ret_self)
{
    struct reference *self = malloc(sizeof *self);
    if (!self) {
        host->fail("out of memory");
        return 1;
    }
    *self = *par;
    *ret_self = self;
    return 0;
}

#endif
