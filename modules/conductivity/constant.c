/* constant.c - one number. */
#include "bulla/conductivity.h"

#include <math.h>
#include <stdlib.h>

static const struct bulla_param constant_params[] = {
    {"k", "W/m/K", 0.0, 1e9, NAN, "conductivity of heat", BULLA_NUMBER, NULL},
    {0},
};

/* At 25 C and 1 atm. */
static const struct bulla_preset constant_presets[] = {
    {"water", "water at 25 C", (const double[]){0.607}},
    {"air", "dry air at 25 C", (const double[]){0.0262}},
    {0},
};

static int constant_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    double *self = malloc(sizeof *self);
    if (!self) {
        host->fail("out of memory");
        return 1;
    }
    *self = values[0].number;
    *ret_self = self;
    return 0;
}

static void constant_k(const void *self, size_t n, const double *BULLA_RESTRICT rate, const double *BULLA_RESTRICT T,
                       const double *BULLA_RESTRICT p, const double *BULLA_RESTRICT rho, double *BULLA_RESTRICT k)
{
    const double number = *(const double *)self;
    (void)rate, (void)T, (void)p, (void)rho;
    for (size_t i = 0; i < n; i++) k[i] = number;
}

static const struct bulla_conductivity constant_table = {
    .k = {.size = sizeof(struct bulla_conductivity), .value = constant_k}};

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "conductivity",
    .name = "constant",
    .version = "1.0",
    .doc = "A constant conductivity. A number in place of the section, `conductivity: 0.607 W/m/K`, means this law.",
    .cite =
        "Fourier, Theorie analytique de la chaleur, 1822; water: IAPWS R15-11 (2011); air: Lemmon & Jacobsen, Int. J. "
        "Thermophys. 25 (2004) 21-69",
    .params = constant_params,
    .presets = constant_presets,
    .open = constant_open,
    .close = free,
    .table = &constant_table,
};
