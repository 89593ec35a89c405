/* power_law.c - Y = (Y0 + H eps) (1 + (rate/rate0)^m): the overstress of Cowper and Symonds, of Perzyna with a
 * power. */
#include "strength.h"

#include <math.h>

enum { YIELD, HARDENING, REFERENCE_RATE, SENSITIVITY };

struct power_law {
    double yield, hardening, per_rate, m;
};

static const struct bulla_param power_law_params[] = {
    {"yield", "Pa", 1e-6, 1e13, NAN, "Y0: strength of the unstrained solid at rest", BULLA_NUMBER, NULL},
    {"hardening", "Pa", 0.0, 1e13, 0.0, "H: what a plastic strain of 1 adds", BULLA_NUMBER, NULL},
    {"reference-rate", "1/s", 1e-9, 1e15, NAN, "rate at which the strength is twice the static one", BULLA_NUMBER,
     NULL},
    {"sensitivity", "1", 1e-3, 1.0, NAN, "m: exponent of the rate", BULLA_NUMBER, NULL},
    {0}};

static int power_law_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    const struct power_law par = {values[YIELD].number, values[HARDENING].number, 1.0 / values[REFERENCE_RATE].number,
                                  values[SENSITIVITY].number};
    return strength_keep(host, &par, sizeof par, ret_self);
}

static void power_law_strength(const void *self, size_t n, const double *BULLA_RESTRICT eps,
                               const double *BULLA_RESTRICT rate, const double *BULLA_RESTRICT p,
                               const double *BULLA_RESTRICT T, const double *BULLA_RESTRICT rho,
                               double *BULLA_RESTRICT Y)
{
    const struct power_law par = *(const struct power_law *)self;
    (void)p, (void)T, (void)rho;
    for (size_t i = 0; i < n; i++)
        Y[i] = (par.yield + par.hardening * eps[i]) * (1.0 + pow(rate[i] * par.per_rate, par.m));
}

static uint32_t power_law_needs(const void *self)
{
    return BULLA_INELASTIC_RATE | (((const struct power_law *)self)->hardening > 0.0 ? BULLA_INELASTIC_STRAIN : 0u);
}

static const struct bulla_inelastic power_law_table = {.size = sizeof(struct bulla_inelastic),
                                                       .strength = power_law_strength,
                                                       .needs = power_law_needs};

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "inelastic",
    .name = "power-law",
    .version = "1.0",
    .doc = "Strength (Y0 + H eps)(1 + (rate/rate0)^m). For solids whose strength grows with a power of the rate.",
    .cite = "Perzyna, Adv. Appl. Mech. 9 (1966) 243-377; Cowper & Symonds, Brown University TR 28 (1957)",
    .params = power_law_params,
    .open = power_law_open,
    .close = strength_close,
    .table = &power_law_table,
};
