/* jwl.c - products of a detonation: the law of Jones, Wilkins and Lee,
 *
 *     p = A (1 - w x/R1) exp(-R1/x) + B (1 - w x/R2) exp(-R2/x) + w rho e,   x = rho/rho0,
 *
 * as an isentrope, p_r = A exp(-R1/x) + B exp(-R2/x), with a constant Grueneisen coefficient w off it
 * (shared/reference_rows.h); T = (e - e_r)/cv, so that the isentrope is the one of T = 0. At low density it is an ideal
 * gas of gamma = 1 + w; beyond some 3.5 rho0 the exponentials no longer stiffen, and states of low pressure end. */
#include "bulla/eos.h"
#include "shared/elementary.h"

struct reference {
    double rho0, A, B, R1, R2, G, cv;
    double T0, scale; /* 0, 1 K */
};

struct reference_curve {
    double x, p, energy, stiffness;
};

ELEMENTARY_INLINE struct reference_curve jwl_curve(const struct reference *par, double rho)
{
    double x = rho / par->rho0, a = par->A * elementary_exp(-par->R1 / x), b = par->B * elementary_exp(-par->R2 / x);
    double energy = x * (a / par->R1 + b / par->R2);
    return (struct reference_curve){x, a + b, energy, (par->R1 * a + par->R2 * b) / x};
}

/* Of the gas, or that of the charge. */
ELEMENTARY_INLINE double jwl_guess(const struct reference *par, double p, double T)
{
    double gas = p / (par->G * par->cv * T);
    return gas < par->rho0 ? gas > 1e-9 ? gas : 1e-9 : par->rho0;
}

#define REFERENCE_CURVE jwl_curve
#define REFERENCE_GUESS jwl_guess
#include "shared/reference_rows.h"

/* From the products of the charge (its density and a third more) to their expansion. */
static void jwl_range(const void *self, struct bulla_eos_range *ret_range)
{
    const struct reference *par = self;
    *ret_range = (struct bulla_eos_range){
        .rho_min = 0.1, .rho_max = 1.35 * par->rho0, .p_min = 0.0, .p_max = 5e10, .T_min = 500.0, .T_max = 6000.0};
}

static const struct bulla_eos jwl_table = REFERENCE_TABLE(jwl_range);

enum { RHO0, A, B, R1, R2, OMEGA, CV };

static const struct bulla_param jwl_params[] = {
    {"reference-density", "kg/m3", 1.0, 1e5, NAN, "density of the charge", BULLA_NUMBER, NULL},
    {"a", "Pa", 0.0, 1e14, NAN, "A", BULLA_NUMBER, NULL},
    {"b", "Pa", 0.0, 1e14, NAN, "B", BULLA_NUMBER, NULL},
    {"r1", "1", 0.1, 100.0, NAN, "R1", BULLA_NUMBER, NULL},
    {"r2", "1", 0.1, 100.0, NAN, "R2", BULLA_NUMBER, NULL},
    {"omega", "1", 0.01, 5.0, NAN, "Grueneisen coefficient; gamma - 1 of the expanded gas", BULLA_NUMBER, NULL},
    {"cv", "J/kg/K", 1.0, 1e6, 1000.0, "specific heat at constant volume; only temperatures depend on it", BULLA_NUMBER,
     NULL},
    {0},
};

/* Dobratz & Crawford, LLNL Explosives Handbook, UCRL-52997 (1985). cv is not theirs. */
static const struct bulla_preset jwl_presets[] = {
    {"tnt", "products of TNT, 1630 kg/m3", (const double[]){1630.0, 371.2e9, 3.231e9, 4.15, 0.95, 0.30, 1000.0}},
    {"c4", "products of C-4, 1601 kg/m3", (const double[]){1601.0, 609.77e9, 12.95e9, 4.5, 1.4, 0.25, 1000.0}},
    {"petn", "products of PETN, 1770 kg/m3", (const double[]){1770.0, 617.0e9, 16.926e9, 4.4, 1.2, 0.25, 1000.0}},
    {0},
};

static int jwl_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    struct reference par = {.rho0 = values[RHO0].number,
                            .A = values[A].number,
                            .B = values[B].number,
                            .R1 = values[R1].number,
                            .R2 = values[R2].number,
                            .G = values[OMEGA].number,
                            .cv = values[CV].number,
                            .scale = 1.0};
    return reference_rows_keep(host, &par, ret_self);
}

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "eos",
    .name = "jwl",
    .version = "1.0",
    .doc = "Jones-Wilkins-Lee: products of a detonation, from the density of the charge to the expanded gas. Its "
           "temperatures are rough.",
    .cite = "Lee, Hornig & Kury, UCRL-50422 (1968); Menikoff, LA-UR-15-29536 (2015)",
    .params = jwl_params,
    .presets = jwl_presets,
    .open = jwl_open,
    .close = free,
    .table = &jwl_table,
};
