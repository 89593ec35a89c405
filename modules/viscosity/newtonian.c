/* newtonian.c - two constants: mu and zeta. */
#include "law.h"

enum { MU, ZETA };

static const struct bulla_param newtonian_params[] = {
    {"mu", "Pa s", 0.0, 1e9, NAN, "shear viscosity", BULLA_NUMBER, NULL},
    LAW_ZETA,
    {0},
};

/* At 25 C and 1 atm. */
static const struct bulla_preset newtonian_presets[] = {
    {"water", "water at 25 C; the bulk viscosity is 2.8 times mu", (const double[]){0.890e-3, 2.492e-3}},
    {"air", "dry air at 25 C; the bulk viscosity is 0.6 times mu", (const double[]){18.5e-6, 11.1e-6}},
    {"ethanol", "ethanol at 25 C, without bulk viscosity", (const double[]){1.074e-3, 0.0}},
    {"glycerol", "glycerol at 25 C, without bulk viscosity", (const double[]){0.934, 0.0}},
    {"plasma", "blood plasma at 37 C, without bulk viscosity", (const double[]){1.2e-3, 0.0}},
    {"blood", "whole blood at 37 C in fast shear, without bulk viscosity", (const double[]){3.5e-3, 0.0}},
    {0},
};

static int newtonian_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    const double par[] = {values[MU].number, values[ZETA].number};
    return law_keep(host, par, sizeof par, ret_self);
}

static void newtonian_mu(const void *self, size_t n, const double *BULLA_RESTRICT rate, const double *BULLA_RESTRICT T,
                         const double *BULLA_RESTRICT p, const double *BULLA_RESTRICT rho, double *BULLA_RESTRICT mu)
{
    (void)rate, (void)T, (void)p, (void)rho;
    law_fill(n, ((const double *)self)[MU], mu);
}

static void newtonian_zeta(const void *self, size_t n, const double *BULLA_RESTRICT T, const double *BULLA_RESTRICT p,
                           const double *BULLA_RESTRICT rho, double *BULLA_RESTRICT zeta)
{
    (void)T, (void)p, (void)rho;
    law_fill(n, ((const double *)self)[ZETA], zeta);
}

static const struct bulla_viscosity newtonian_table = {.mu = {.size = sizeof(struct bulla_viscosity),
                                                              .value = newtonian_mu},
                                                       .zeta = newtonian_zeta};

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "viscosity",
    .name = "newtonian",
    .version = "1.0",
    .doc = "Constant viscosities. A number in place of the section, `viscosity: 0.89 mPa s`, means this law.",
    .cite =
        "Stokes, Trans. Camb. Phil. Soc. 8 (1845) 287-319; values of water: Huber et al., J. Phys. Chem. Ref. Data 38 "
        "(2009) 101-125 (mu), Holmes, Parker & Povey, J. Phys.: Conf. Ser. 269 (2011) 012011 (zeta)",
    .params = newtonian_params,
    .presets = newtonian_presets,
    .open = newtonian_open,
    .close = free,
    .table = &newtonian_table,
};
