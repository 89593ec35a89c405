/* power.c - mu = K g^(n - 1), between mu_min and mu_max. */
#define RATE_LAW_POINT power
#include "rate_law.h"

enum { CONSISTENCY, INDEX, MU_MIN, MU_MAX, ZETA };

/* Compared so that a NaN stays one. */
static inline double power(const struct rate_law *par, double rate)
{
    const double *number = par->number;
    double mu = number[CONSISTENCY] * pow(rate, number[INDEX] - 1.0);
    mu = mu > number[MU_MAX] ? number[MU_MAX] : mu;
    return mu < number[MU_MIN] ? number[MU_MIN] : mu;
}

static const struct bulla_param power_params[] = {
    {"consistency", "Pa s", 0.0, 1e9, NAN, "K: the viscosity at a rate of 1/s [Pa s^n]", BULLA_NUMBER, NULL},
    {"index", "1", 0.05, 3.0, NAN, "n: below 1 it thins in shear, above it thickens", BULLA_NUMBER, NULL},
    {"mu-min", "Pa s", 0.0, 1e9, 0.0, "the least viscosity, which ends the power law", BULLA_NUMBER, NULL},
    {"mu-max", "Pa s", 0.0, 1e9, NAN, "the largest, which ends it at the other side; the time step goes by it",
     BULLA_NUMBER, NULL},
    LAW_ZETA,
    {0},
};

static const struct bulla_preset power_presets[] = {
    {"blood", "human blood at 37 C, between the plateaus of its Carreau law",
     (const double[]){0.017, 0.708, 0.00345, 0.056, 0.0}},
    {0},
};

static int power_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    struct rate_law par = rate_law_make(values, ZETA);
    par.most = par.number[MU_MAX];
    if (par.number[MU_MIN] > par.number[MU_MAX]) {
        host->fail("mu-min is above mu-max");
        return 1;
    }
    return law_keep(host, &par, sizeof par, ret_self);
}

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "viscosity",
    .name = "power",
    .version = "1.0",
    .doc = "Power law: mu = K rate^(n - 1) between two bounds. Where neither plateau of a liquid matters.",
    .cite = "de Waele, Oil Color Chem. Assoc. J. 6 (1923) 33-88; Ostwald, Kolloid-Z. 36 (1925) 99-117",
    .params = power_params,
    .presets = power_presets,
    .open = power_open,
    .close = free,
    .table = &rate_law_table,
};
