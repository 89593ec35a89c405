/* herschel_bulkley.c - mu = (t0/g)(1 - exp(-m g)) + K g^(n - 1), the power taken no further than g = 1/m: at rest that
 * is m t0 + K m^(1 - n). */
#define RATE_LAW_POINT herschel_bulkley
#include "rate_law.h"

enum { YIELD_STRESS, CONSISTENCY, INDEX, REGULARISATION, ZETA };

static inline double herschel_bulkley(const struct rate_law *par, double rate)
{
    const double *number = par->number;
    double m = number[REGULARISATION], x = m * rate, part = -expm1(-x) / x, least = 1.0 / m;
    double g = rate < least ? least : rate;
    return m * number[YIELD_STRESS] * (x == 0.0 ? 1.0 : part) + number[CONSISTENCY] * pow(g, number[INDEX] - 1.0);
}

static const struct bulla_param herschel_bulkley_params[] = {
    {"yield-stress", "Pa", 0.0, 1e9, NAN, "t0: stress below which it hardly flows", BULLA_NUMBER, NULL},
    {"consistency", "Pa s", 0.0, 1e9, NAN, "K: of the power law beyond it [Pa s^n]", BULLA_NUMBER, NULL},
    {"index", "1", 0.05, 1.0, NAN, "n of the power law; 1: a Bingham liquid", BULLA_NUMBER, NULL},
    {"regularisation", "s", 1e-9, 1e9, NAN,
     "m: one over the rate below which it creeps; the viscosity at rest, m t0 + K m^(1 - n), sets the time step",
     BULLA_NUMBER, NULL},
    LAW_ZETA,
    {0},
};

static const struct bulla_preset herschel_bulkley_presets[] = {
    {"gel", "a soft gel, of the order of 0.1 % carbopol: 30 Pa, 8 Pa s^0.5, creeping below 10 1/s",
     (const double[]){30.0, 8.0, 0.5, 0.1, 0.0}},
    {0},
};

static int herschel_bulkley_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    struct rate_law par = rate_law_make(values, ZETA);
    par.most = herschel_bulkley(&par, 0.0);
    return law_keep(host, &par, sizeof par, ret_self);
}

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "viscosity",
    .name = "herschel-bulkley",
    .version = "1.0",
    .doc = "Herschel-Bulkley liquid with a regularised yield stress. For gels and pastes; with index 1 Bingham's.",
    .cite = "Herschel & Bulkley, Kolloid-Z. 39 (1926) 291-300; regularised after Papanastasiou, J. Rheol. 31 (1987) "
            "385-404",
    .params = herschel_bulkley_params,
    .presets = herschel_bulkley_presets,
    .open = herschel_bulkley_open,
    .close = free,
    .table = &rate_law_table,
};
