/* tait.c - Tait's liquid as the reference curve of a Mie-Grueneisen law.
 *
 *     p_T = rho0 c0^2/n (x^n - 1) + p0,   c_T^2 = c0^2 x^(n-1),   x = rho/rho0,   e_T = integral of p_T/rho^2.
 *
 * Alone the curve says nothing about energy: (de/dp) at constant rho is 0, and a mixture cannot be closed
 * with it. So it goes on off the curve with a constant Grueneisen coefficient G (0.11: water at 20 C) and a
 * constant cv (shared/reference_rows.h). */
#include "bulla/eos.h"
#include "shared/elementary.h"

struct reference {
    double rho0, c0, n, p0, G, T0, cv, scale;
    double stiffness; /* rho0 c0^2 */
};

/* The curve at one density; `energy` is per volume. */
struct reference_curve {
    double x, p, energy, stiffness;
};

/* rho e_T = rho0 c0^2/n ((x^n - x)/(n - 1) + 1 - x) + p0 (x - 1) */
ELEMENTARY_INLINE struct reference_curve tait_curve(const struct reference *par, double rho)
{
    double x = rho / par->rho0, power = elementary_pow(x, par->n), scale = par->stiffness / par->n;
    double energy = scale * ((power - x) / (par->n - 1.0) + (1.0 - x)) + par->p0 * (x - 1.0);
    return (struct reference_curve){x, scale * (power - 1.0) + par->p0, energy, par->stiffness * power};
}

/* The density of the curve alone. */
ELEMENTARY_INLINE double tait_guess(const struct reference *par, double p, double T)
{
    double ratio = 1.0 + par->n * (p - par->p0) / par->stiffness;
    (void)T;
    return par->rho0 * elementary_pow(ratio > 1e-6 ? ratio : 1e-6, 1.0 / par->n);
}

#define REFERENCE_CURVE tait_curve
#define REFERENCE_GUESS tait_guess
#include "shared/reference_rows.h"

/* Water between freezing and boiling, in tension down to what it bears, and up to where the curve is measured. */
static void tait_range(const void *self, struct bulla_eos_range *ret_range)
{
    const struct reference *par = self;
    *ret_range = (struct bulla_eos_range){.rho_min = 0.95 * par->rho0,
                                          .rho_max = 1.35 * par->rho0,
                                          .p_min = -3e7,
                                          .p_max = 2.5e9,
                                          .T_min = par->T0 - 20.0 > 1.0 ? par->T0 - 20.0 : 1.0,
                                          .T_max = par->T0 + 80.0};
}

static const struct bulla_eos tait_table = REFERENCE_TABLE(tait_range);

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
    struct reference par = {.rho0 = values[RHO0].number,
                            .c0 = values[C0].number,
                            .n = values[EXPONENT].number,
                            .p0 = values[P0].number,
                            .G = values[GRUENEISEN].number,
                            .T0 = values[T0].number,
                            .cv = values[CV].number,
                            .scale = values[T0].number};
    par.stiffness = par.rho0 * par.c0 * par.c0;
    return reference_rows_keep(host, &par, ret_self);
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
