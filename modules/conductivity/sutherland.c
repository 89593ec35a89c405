/* sutherland.c - gases: k = k0 (T/T0)^(3/2) (T0 + S)/(T + S). */
#include "bulla/conductivity.h"

#include <math.h>
#include <stdlib.h>

enum { K0, T0, S };

static const struct bulla_param sutherland_params[] = {
    {"k0", "W/m/K", 0.0, 1e9, NAN, "conductivity at the reference temperature", BULLA_NUMBER, NULL},
    {"temperature", "K", 1.0, 1e6, 273.15, "reference temperature T0", BULLA_NUMBER, NULL},
    {"constant", "K", 0.0, 1e6, NAN, "Sutherland's constant S", BULLA_NUMBER, NULL},
    {0},
};

static const struct bulla_preset sutherland_presets[] = {
    {"air", "dry air, within 2 % from 250 to 1000 K", (const double[]){0.0241, 273.15, 194.0}},
    {0},
};

static int sutherland_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    double *self = malloc(3 * sizeof *self);
    if (!self) {
        host->fail("out of memory");
        return 1;
    }
    for (int i = 0; i < 3; i++) self[i] = values[i].number;
    *ret_self = self;
    return 0;
}

/* (T/T0)^(3/2) as a product: no pow in the loop. */
static void sutherland_k(const void *self, size_t n, const double *BULLA_RESTRICT rate, const double *BULLA_RESTRICT T,
                         const double *BULLA_RESTRICT p, const double *BULLA_RESTRICT rho, double *BULLA_RESTRICT k)
{
    const double *par = self, k0 = par[K0], per_T0 = 1.0 / par[T0], c = par[S], sum = par[T0] + par[S];
    (void)rate, (void)p, (void)rho;
    for (size_t i = 0; i < n; i++) {
        double t = T[i] * per_T0;
        k[i] = k0 * (t * sqrt(t)) * (sum / (T[i] + c));
    }
}

static const struct bulla_conductivity sutherland_table = {
    .k = {.size = sizeof(struct bulla_conductivity), .needs = BULLA_NEEDS_TEMPERATURE, .value = sutherland_k}};

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "conductivity",
    .name = "sutherland",
    .version = "1.0",
    .doc = "Gases: k0 (T/T0)^1.5 (T0 + S)/(T + S). Beyond the fit it grows as the square root of T.",
    .cite = "Sutherland, Phil. Mag. 36 (1893) 507-531; air: White, Viscous Fluid Flow, 2nd ed., McGraw-Hill 1991, "
            "table 1-3",
    .params = sutherland_params,
    .presets = sutherland_presets,
    .open = sutherland_open,
    .close = free,
    .table = &sutherland_table,
};
