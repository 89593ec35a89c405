/* cross.c - mu = mu_i + (mu_0 - mu_i)/(1 + (l g)^m). */
#define RATE_LAW_POINT cross
#include "rate_law.h"

enum { MU_0, MU_INFINITY, TIME, EXPONENT, ZETA };

static inline double cross(const struct rate_law *par, double rate)
{
    const double *number = par->number;
    return number[MU_INFINITY] +
           (number[MU_0] - number[MU_INFINITY]) / (1.0 + pow(number[TIME] * rate, number[EXPONENT]));
}

static const struct bulla_param cross_params[] = {
    {"mu-0", "Pa s", 0.0, 1e9, NAN, "viscosity at rest", BULLA_NUMBER, NULL},
    {"mu-infinity", "Pa s", 0.0, 1e9, NAN, "viscosity in fast shear", BULLA_NUMBER, NULL},
    {"time", "s", 0.0, 1e9, NAN, "l: one over the rate where half of the difference is left", BULLA_NUMBER, NULL},
    {"exponent", "1", 0.01, 10.0, NAN, "m: how steeply it falls", BULLA_NUMBER, NULL},
    LAW_ZETA,
    {0},
};

static const struct bulla_preset cross_presets[] = {
    {"blood", "human blood at 37 C", (const double[]){0.056, 0.00345, 1.007, 1.028, 0.0}},
    {0},
};

static int cross_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    struct rate_law par = rate_law_make(values, ZETA);
    par.most = par.number[MU_0] > par.number[MU_INFINITY] ? par.number[MU_0] : par.number[MU_INFINITY];
    return law_keep(host, &par, sizeof par, ret_self);
}

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "viscosity",
    .name = "cross",
    .version = "1.0",
    .doc = "Cross liquid: a plateau at rest, one in fast shear, a power of the rate between. For blood, paints, melts.",
    .cite = "Cross, J. Colloid Sci. 20 (1965) 417-437; blood: Cho & Kensey, Biorheology 28 (1991) 241-262",
    .params = cross_params,
    .presets = cross_presets,
    .open = cross_open,
    .close = free,
    .table = &rate_law_table,
};
