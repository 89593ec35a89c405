/* powers.c - liquids: a sum of four powers of the temperature, constant beyond the ends of its fit. */
#include "bulla/conductivity.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

enum { POWERS_TERMS = 4, T0 = 0, FROM, TO, C, D = C + POWERS_TERMS, POWERS_COUNT = D + POWERS_TERMS };

static const struct bulla_param powers_params[] = {
    {"temperature", "K", 1.0, 1e6, NAN, "reference temperature T0", BULLA_NUMBER, NULL},
    {"from", "K", 1.0, 1e6, NAN, "least temperature of the fit; below, k is that at this one", BULLA_NUMBER, NULL},
    {"to", "K", 1.0, 1e6, NAN, "highest temperature of the fit; above, k is that at this one", BULLA_NUMBER, NULL},
    {"c1", "W/m/K", -1e9, 1e9, NAN, "factor of the first power", BULLA_NUMBER, NULL},
    {"c2", "W/m/K", -1e9, 1e9, 0.0, "factor of the second power", BULLA_NUMBER, NULL},
    {"c3", "W/m/K", -1e9, 1e9, 0.0, "factor of the third power", BULLA_NUMBER, NULL},
    {"c4", "W/m/K", -1e9, 1e9, 0.0, "factor of the fourth power", BULLA_NUMBER, NULL},
    {"d1", "1", -40.0, 40.0, 0.0, "exponent of the first power", BULLA_NUMBER, NULL},
    {"d2", "1", -40.0, 40.0, 0.0, "exponent of the second power", BULLA_NUMBER, NULL},
    {"d3", "1", -40.0, 40.0, 0.0, "exponent of the third power", BULLA_NUMBER, NULL},
    {"d4", "1", -40.0, 40.0, 0.0, "exponent of the fourth power", BULLA_NUMBER, NULL},
    {0},
};

static const struct bulla_preset powers_presets[] = {
    {"water", "liquid water at 0.1 MPa, 253 to 383 K",
     (const double[]){300.0, 253.15, 383.15, 0.80201, -0.25992, 0.10024, -0.032005, -0.32, -5.7, -12.0, -15.0}},
    {0},
};

static double powers_at(const double *par, double T)
{
    double t = T < par[FROM] ? par[FROM] : T, sum = 0.0;
    t = (t > par[TO] ? par[TO] : t) / par[T0];
    for (int i = 0; i < POWERS_TERMS; i++) sum += par[C + i] * pow(t, par[D + i]);
    return sum;
}

enum { POWERS_LOOKS = 200 };

static int powers_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    double *self = malloc(POWERS_COUNT * sizeof *self);
    if (!self) {
        host->fail("out of memory");
        return 1;
    }
    for (int i = 0; i < POWERS_COUNT; i++) self[i] = values[i].number;
    bool good = self[FROM] < self[TO];
    for (int i = 0; i <= POWERS_LOOKS; i++)
        good = good && powers_at(self, self[FROM] + (self[TO] - self[FROM]) * i / POWERS_LOOKS) >= 0.0;
    if (!good) {
        host->fail("the fit goes from a lower to a higher temperature, and is nowhere negative between them");
        free(self);
        return 1;
    }
    *ret_self = self;
    return 0;
}

static void powers_k(const void *self, size_t n, const double *BULLA_RESTRICT rate, const double *BULLA_RESTRICT T,
                     const double *BULLA_RESTRICT p, const double *BULLA_RESTRICT rho, double *BULLA_RESTRICT k)
{
    (void)rate, (void)p, (void)rho;
    for (size_t i = 0; i < n; i++) k[i] = powers_at(self, T[i]);
}

static const struct bulla_conductivity powers_table = {
    .k = {.size = sizeof(struct bulla_conductivity), .needs = BULLA_NEEDS_TEMPERATURE, .value = powers_k}};

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "conductivity",
    .name = "powers",
    .version = "1.0",
    .doc = "Liquids: c1 (T/T0)^d1 + ... + c4 (T/T0)^d4, constant beyond the ends of its fit.",
    .cite = "water: Patek, Hruby, Klomfar, Souckova & Harvey, J. Phys. Chem. Ref. Data 38 (2009) 21-29 (IAPWS SR6-08)",
    .params = powers_params,
    .presets = powers_presets,
    .open = powers_open,
    .close = free,
    .table = &powers_table,
};
