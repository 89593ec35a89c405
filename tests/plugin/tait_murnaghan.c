/* tait_murnaghan.c - a module written outside the source tree: water whose cold compression
 * follows Tait and Murnaghan, completed to a Mie-Grueneisen law.
 *
 *     p = p_T(rho) + G rho (e - e_T(rho)),   x = rho/rho0,
 *     p_T = rho0 c0^2/n (x^n - 1) + p0,      e_T = integral of p_T/rho^2,   c_T^2 = c0^2 x^(n-1).
 * Linear in p at fixed density, so core closes mixtures without iteration. With T = T0 x^G on the
 * reference curve, T = T0 x^G + (e - e_T)/cv and s = cv ln(T x^-G). */
#include <bulla/eos.h>

#include <math.h>
#include <stdlib.h>

struct tait {
    double rho0, c0, n, p0, G, T0, cv;
};

/* The reference curve at one density. */
struct curve {
    double x, p, e, c2;
};

static struct curve curve_at(const struct tait *par, double rho)
{
    double x = rho / par->rho0, power = pow(x, par->n - 1.0), scale = par->c0 * par->c0 / par->n;
    double e = scale * ((power - 1.0) / (par->n - 1.0) + 1.0 / x - 1.0) + par->p0 / par->rho0 * (1.0 - 1.0 / x);
    return (struct curve){x, par->rho0 * scale * (power * x - 1.0) + par->p0, e, par->c0 * par->c0 * power};
}

/* rho e = p/G + rest */
static double rest(const struct tait *par, struct curve curve, double rho)
{
    return rho * curve.e - curve.p / par->G;
}

/* Floored at 1 K: far below the curve the formula would go negative; nothing else depends on it. */
static double temperature_at(const struct tait *par, double rho, double p)
{
    struct curve curve = curve_at(par, rho);
    double T = par->T0 * pow(curve.x, par->G) + (p - curve.p) / (par->G * rho * par->cv);
    return T > 1.0 ? T : 1.0;
}

static void tait_state(const void *self, size_t n, const double *BULLA_RESTRICT rho, const double *BULLA_RESTRICT p,
                       double *BULLA_RESTRICT rho_e, double *BULLA_RESTRICT rho_c2)
{
    const struct tait *par = self;
    for (size_t i = 0; i < n; i++) {
        struct curve curve = curve_at(par, rho[i]);
        rho_e[i] = 1.0 / par->G * p[i] + rest(par, curve, rho[i]);
        rho_c2[i] = rho[i] * curve.c2 + (p[i] - curve.p) * (1.0 + par->G);
    }
}

static void tait_derivatives(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                             const double *BULLA_RESTRICT p, double *BULLA_RESTRICT de_dp,
                             double *BULLA_RESTRICT de_drho)
{
    const struct tait *par = self;
    (void)p;
    for (size_t i = 0; i < n; i++) {
        struct curve curve = curve_at(par, rho[i]);
        de_dp[i] = 1.0 / par->G;
        de_drho[i] = curve.e + curve.p / rho[i] - curve.c2 / par->G;
    }
}

static void tait_temperature(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                             const double *BULLA_RESTRICT p, double *BULLA_RESTRICT T)
{
    for (size_t i = 0; i < n; i++) T[i] = temperature_at(self, rho[i], p[i]);
}

static void tait_entropy(const void *self, size_t n, const double *BULLA_RESTRICT rho, const double *BULLA_RESTRICT p,
                         double *BULLA_RESTRICT s)
{
    const struct tait *par = self;
    for (size_t i = 0; i < n; i++)
        s[i] = par->cv * (log(temperature_at(par, rho[i], p[i])) - par->G * log(rho[i] / par->rho0));
}

/* Newton from the density on the reference curve: a few steps suffice, T - T0 x^G is a small part of p. */
static void tait_density(const void *self, size_t n, const double *BULLA_RESTRICT p, const double *BULLA_RESTRICT T,
                         double *BULLA_RESTRICT rho)
{
    const struct tait *par = self;
    for (size_t i = 0; i < n; i++) {
        double ratio = 1.0 + par->n * (p[i] - par->p0) / (par->rho0 * par->c0 * par->c0);
        double guess = par->rho0 * pow(ratio > 1e-6 ? ratio : 1e-6, 1.0 / par->n);
        for (int step = 0; step < 8; step++) {
            struct curve curve = curve_at(par, guess);
            double cold = par->T0 * pow(curve.x, par->G), heat = par->G * par->cv;
            double slope = curve.c2 + heat * (T[i] - (1.0 + par->G) * cold);
            guess -= (curve.p + heat * guess * (T[i] - cold) - p[i]) / slope;
        }
        rho[i] = guess;
    }
}

/* Where c^2 ends. */
static void tait_p_min(const void *self, size_t n, const double *BULLA_RESTRICT rho, double *BULLA_RESTRICT p)
{
    const struct tait *par = self;
    for (size_t i = 0; i < n; i++) {
        struct curve curve = curve_at(par, rho[i]);
        p[i] = curve.p - rho[i] * curve.c2 / (1.0 + par->G);
    }
}

static void tait_linear(const void *self, size_t n, const double *BULLA_RESTRICT rho, double *BULLA_RESTRICT a,
                        double *BULLA_RESTRICT b)
{
    const struct tait *par = self;
    for (size_t i = 0; i < n; i++) {
        a[i] = 1.0 / par->G;
        b[i] = rest(par, curve_at(par, rho[i]), rho[i]);
    }
}

static void tait_range(const void *self, struct bulla_eos_range *ret_range)
{
    const struct tait *par = self;
    *ret_range = (struct bulla_eos_range){.rho_min = 0.9 * par->rho0,
                                          .rho_max = 1.3 * par->rho0,
                                          .p_min = -1e8,
                                          .p_max = 2e9,
                                          .T_min = 273.0,
                                          .T_max = 373.0};
}

static const struct bulla_eos tait_table = {.size = sizeof(struct bulla_eos),
                                            .state = tait_state,
                                            .derivatives = tait_derivatives,
                                            .temperature = tait_temperature,
                                            .entropy = tait_entropy,
                                            .density = tait_density,
                                            .p_min = tait_p_min,
                                            .linear = tait_linear,
                                            .range = tait_range};

/* The keys of a case file, in the order in which `open` gets their values. */
static const struct bulla_param tait_params[] = {
    {"reference-density", "kg/m3", 1.0, 1e5, 998.2, "density on the curve at the reference pressure", BULLA_NUMBER, 0},
    {"sound-speed", "m/s", 1.0, 1e5, 1482.0, "sound speed there", BULLA_NUMBER, 0},
    {"exponent", "1", 1.01, 20.0, 7.15, "Murnaghan's exponent n", BULLA_NUMBER, 0},
    {"reference-pressure", "Pa", 0.0, 1e12, 1e5, "pressure where the curve begins", BULLA_NUMBER, 0},
    {"grueneisen", "1", 0.01, 5.0, 0.11, "Grueneisen coefficient G, constant", BULLA_NUMBER, 0},
    {"reference-temperature", "K", 1.0, 1e4, 300.0, "temperature there", BULLA_NUMBER, 0},
    {"cv", "J/kg/K", 1.0, 1e6, 4150.0, "specific heat at constant volume", BULLA_NUMBER, 0},
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
    *self = (struct tait){.rho0 = values[0].number,
                          .c0 = values[1].number,
                          .n = values[2].number,
                          .p0 = values[3].number,
                          .G = values[4].number,
                          .T0 = values[5].number,
                          .cv = values[6].number};
    *ret_self = self;
    return 0;
}

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof(struct bulla_module),
    .kind = "eos",
    .name = "tait-murnaghan",
    .version = "0.1",
    .doc = "Liquid on a Tait-Murnaghan curve with a constant Grueneisen coefficient. For water up to 1 GPa.",
    .cite = "Murnaghan, Proc. Natl. Acad. Sci. 30 (1944) 244-247; Menikoff & Plohr, Rev. Mod. Phys. 61 (1989) 75-130",
    .params = tait_params,
    .presets = tait_presets,
    .open = tait_open,
    .close = free,
    .table = &tait_table,
};
