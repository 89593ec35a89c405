/* casson.c - sqrt(tau) = sqrt(t0) + sqrt(mu_c g), regularised: mu = (sqrt(mu_c) + sqrt(t0/g) (1 - exp(-sqrt(m g))))^2.
 * At rest that is (sqrt(mu_c) + sqrt(t0 m))^2. */
#define RATE_LAW_POINT casson
#include "rate_law.h"

enum { YIELD_STRESS, MU, REGULARISATION, ZETA };

static inline double casson(const struct rate_law *par, double rate)
{
    const double *number = par->number;
    double root = sqrt(number[REGULARISATION] * rate), part = -expm1(-root) / root;
    double shear = sqrt(number[YIELD_STRESS] * number[REGULARISATION]) * (root == 0.0 ? 1.0 : part);
    double both = sqrt(number[MU]) + shear;
    return both * both;
}

static const struct bulla_param casson_params[] = {
    {"yield-stress", "Pa", 0.0, 1e9, NAN, "t0: stress below which it hardly flows", BULLA_NUMBER, NULL},
    {"mu", "Pa s", 0.0, 1e9, NAN, "mu_c: viscosity in fast shear", BULLA_NUMBER, NULL},
    {"regularisation", "s", 1e-9, 1e9, NAN,
     "m: one over the rate below which it creeps; the viscosity at rest, and the time step, go by it", BULLA_NUMBER,
     NULL},
    LAW_ZETA,
    {0},
};

static const struct bulla_preset casson_presets[] = {
    {"blood", "human blood at 37 C, creeping below 0.01 1/s", (const double[]){5e-3, 3.5e-3, 100.0, 0.0}},
    {0},
};

static int casson_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    struct rate_law par = rate_law_make(values, ZETA);
    double both = sqrt(par.number[MU]) + sqrt(par.number[YIELD_STRESS] * par.number[REGULARISATION]);
    par.most = both * both;
    return law_keep(host, &par, sizeof par, ret_self);
}

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "viscosity",
    .name = "casson",
    .version = "1.0",
    .doc = "Casson liquid with a regularised yield stress. For blood and chocolate.",
    .cite =
        "Casson, in Rheology of Disperse Systems, Pergamon 1959, 84-104; regularised after Papanastasiou, J. Rheol. 31 "
        "(1987) 385-404",
    .params = casson_params,
    .presets = casson_presets,
    .open = casson_open,
    .close = free,
    .table = &rate_law_table,
};
