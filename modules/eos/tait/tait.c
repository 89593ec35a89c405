/* tait.c - Tait's liquid as the reference curve of a Mie-Grueneisen law.
 *
 *     p_T = rho0 c0^2/n (x^n - 1) + p0,   c_T^2 = c0^2 x^(n-1),   x = rho/rho0,   e_T = integral of p_T/rho^2.
 *
 * Alone the curve says nothing about energy: (de/dp) at constant rho is 0, and a mixture cannot be closed
 * with it. So p = p_T + G rho (e - e_T) with a constant Grueneisen coefficient G (0.11: water at 20 C), an
 * isentrope T = T0 x^G along the curve and a constant cv:
 *     rho e = p/G + rho e_T - p_T/G,   T = T0 x^G + (e - e_T)/cv,   s = cv ln(T/T0 x^-G),
 *     rho c^2 = rho c_T^2 + (1 + G)(p - p_T),
 * which is positive above p_min = p_T - rho c_T^2/(1 + G) at every density: nothing needs a continuation
 * but T, which stays at 1 K where the formula falls below (some 50 MPa under the curve). */
#include "bulla/eos.h"
#include "shared/elementary.h"

#include <math.h>
#include <stdlib.h>

#define TAIT_COLDEST 1.0 /* K */

struct tait {
    double rho0, c0, n, p0, G, T0, cv;
    double stiffness; /* rho0 c0^2 */
};

/* The curve at one density; `energy` is per volume. */
struct tait_curve {
    double x, p, energy, stiffness;
};

/* rho e_T = rho0 c0^2/n ((x^n - x)/(n - 1) + 1 - x) + p0 (x - 1) */
ELEMENTARY_INLINE struct tait_curve tait_curve(const struct tait *par, double rho)
{
    double x = rho / par->rho0, power = elementary_pow(x, par->n), scale = par->stiffness / par->n;
    double energy = scale * ((power - x) / (par->n - 1.0) + (1.0 - x)) + par->p0 * (x - 1.0);
    return (struct tait_curve){x, scale * (power - 1.0) + par->p0, energy, par->stiffness * power};
}

ELEMENTARY_INLINE double tait_rest(const struct tait *par, struct tait_curve curve)
{
    return curve.energy - curve.p / par->G;
}

ELEMENTARY_INLINE double tait_heat(const struct tait *par, struct tait_curve curve, double rho, double p)
{
    double T = par->T0 * elementary_pow(curve.x, par->G) + (p - curve.p) / (par->G * rho * par->cv);
    return T > TAIT_COLDEST || T != T ? T : TAIT_COLDEST;
}

BULLA_KERNEL static void tait_state(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                    const double *BULLA_RESTRICT p, double *BULLA_RESTRICT rho_e,
                                    double *BULLA_RESTRICT rho_c2)
{
    const struct tait par = *(const struct tait *)self;
    const double slope = 1.0 / par.G;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double density = rho[i], pressure = p[i];
        struct tait_curve curve = tait_curve(&par, density);
        rho_e[i] = slope * pressure + tait_rest(&par, curve);
        rho_c2[i] = curve.stiffness + (pressure - curve.p) * (1.0 + par.G);
    }
}

/* d(rho e)/drho = e_T + p_T/rho - c_T^2/G at constant p */
BULLA_KERNEL static void tait_derivatives(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                          const double *BULLA_RESTRICT p, double *BULLA_RESTRICT de_dp,
                                          double *BULLA_RESTRICT de_drho)
{
    const struct tait par = *(const struct tait *)self;
    const double slope = 1.0 / par.G;
    (void)p;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double density = rho[i];
        struct tait_curve curve = tait_curve(&par, density);
        de_dp[i] = slope;
        de_drho[i] = (curve.energy + curve.p - curve.stiffness / par.G) / density;
    }
}

BULLA_KERNEL static void tait_temperature(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                          const double *BULLA_RESTRICT p, double *BULLA_RESTRICT T)
{
    const struct tait par = *(const struct tait *)self;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double density = rho[i], pressure = p[i];
        T[i] = tait_heat(&par, tait_curve(&par, density), density, pressure);
    }
}

BULLA_KERNEL static void tait_entropy(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                      const double *BULLA_RESTRICT p, double *BULLA_RESTRICT s)
{
    const struct tait par = *(const struct tait *)self;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double density = rho[i], pressure = p[i];
        struct tait_curve curve = tait_curve(&par, density);
        double T = tait_heat(&par, curve, density, pressure);
        s[i] = par.cv * (elementary_log(T / par.T0) - par.G * elementary_log(curve.x));
    }
}

/* Newton in rho on p_T + G rho cv (T - T0 x^G) = p from the density that the curve alone gives; a step
 * changes it by a factor of 2 at most. */
static double tait_density_at(const struct tait *par, double p, double T)
{
    double ratio = 1.0 + par->n * (p - par->p0) / par->stiffness, heat = par->G * par->cv;
    double rho = par->rho0 * elementary_pow(ratio > 1e-6 ? ratio : 1e-6, 1.0 / par->n);
    for (int step = 0; step < 50; step++) {
        struct tait_curve curve = tait_curve(par, rho);
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

static void tait_density(const void *self, size_t n, const double *BULLA_RESTRICT p, const double *BULLA_RESTRICT T,
                         double *BULLA_RESTRICT rho)
{
    for (size_t i = 0; i < n; i++) rho[i] = tait_density_at(self, p[i], T[i]);
}

BULLA_KERNEL static void tait_p_min(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                    double *BULLA_RESTRICT p)
{
    const struct tait par = *(const struct tait *)self;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        struct tait_curve curve = tait_curve(&par, rho[i]);
        p[i] = curve.p - curve.stiffness / (1.0 + par.G);
    }
}

BULLA_KERNEL static void tait_linear(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                     double *BULLA_RESTRICT a, double *BULLA_RESTRICT b)
{
    const struct tait par = *(const struct tait *)self;
    const double slope = 1.0 / par.G;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double density = rho[i];
        a[i] = slope;
        b[i] = tait_rest(&par, tait_curve(&par, density));
    }
}

/* Where T is held. */
static size_t tait_count_outside(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                 const double *BULLA_RESTRICT p)
{
    size_t count = 0;
    for (size_t i = 0; i < n; i++) count += tait_heat(self, tait_curve(self, rho[i]), rho[i], p[i]) <= TAIT_COLDEST;
    return count;
}

/* Water between freezing and boiling, in tension down to what it bears, and up to where the curve is measured. */
static void tait_range(const void *self, struct bulla_eos_range *ret_range)
{
    const struct tait *par = self;
    *ret_range = (struct bulla_eos_range){.rho_min = 0.95 * par->rho0,
                                          .rho_max = 1.35 * par->rho0,
                                          .p_min = -3e7,
                                          .p_max = 2.5e9,
                                          .T_min = par->T0 - 20.0 > 1.0 ? par->T0 - 20.0 : 1.0,
                                          .T_max = par->T0 + 80.0};
}

static const struct bulla_eos tait_table = {.size = sizeof(struct bulla_eos),
                                            .state = tait_state,
                                            .derivatives = tait_derivatives,
                                            .temperature = tait_temperature,
                                            .entropy = tait_entropy,
                                            .density = tait_density,
                                            .p_min = tait_p_min,
                                            .linear = tait_linear,
                                            .range = tait_range,
                                            .count_outside = tait_count_outside};

enum { RHO0, C0, EXPONENT, P0, GRUENEISEN, T0, CV };

static const struct bulla_param tait_params[] = {
    {"reference-density", "kg/m3", 1.0, 1e5, 998.2, "density on the curve at the reference pressure", BULLA_NUMBER,
     NULL},
    {"sound-speed", "m/s", 1.0, 1e5, 1482.0, "sound speed there", BULLA_NUMBER, NULL},
    {"exponent", "1", 1.01, 20.0, 7.15, "exponent n: how fast the liquid stiffens", BULLA_NUMBER, NULL},
    {"reference-pressure", "Pa", 0.0, 1e10, 1e5, "pressure where the curve has the reference density", BULLA_NUMBER,
     NULL},
    {"grueneisen", "1", 0.01, 5.0, 0.11, "Grueneisen coefficient G off the curve; 0.11 is water at 20 C", BULLA_NUMBER,
     NULL},
    {"reference-temperature", "K", 1.0, 1e4, 293.15, "temperature at the reference state", BULLA_NUMBER, NULL},
    {"cv", "J/kg/K", 1.0, 1e6, 4150.0, "specific heat at constant volume; only temperatures depend on it", BULLA_NUMBER,
     NULL},
    {0},
};

static const struct bulla_preset tait_presets[] = {
    {"water", "liquid water at 20 C", (const double[]){998.2, 1482.0, 7.15, 1e5, 0.11, 293.15, 4150.0}},
    {0},
};

static int tait_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    struct tait *self = malloc(sizeof *self);
    if (!self) {
        host->fail("out of memory");
        return 1;
    }
    *self = (struct tait){.rho0 = values[RHO0].number,
                          .c0 = values[C0].number,
                          .n = values[EXPONENT].number,
                          .p0 = values[P0].number,
                          .G = values[GRUENEISEN].number,
                          .T0 = values[T0].number,
                          .cv = values[CV].number};
    self->stiffness = self->rho0 * self->c0 * self->c0;
    *ret_self = self;
    return 0;
}

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "eos",
    .name = "tait",
    .version = "1.0",
    .doc = "Tait's liquid, completed to a Mie-Grueneisen law. Pressure and sound speed of water (the defaults) "
           "up to a few GPa; its temperatures hardly rise.",
    .cite = "Li, Trans. Faraday Soc. 1967 (Tait's equation); Menikoff & Plohr, Rev. Mod. Phys. 61 (1989) 75-130",
    .params = tait_params,
    .presets = tait_presets,
    .open = tait_open,
    .close = free,
    .table = &tait_table,
};
