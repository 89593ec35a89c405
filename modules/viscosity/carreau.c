/* carreau.c - mu = mu_i + (mu_0 - mu_i) (1 + (l g)^2)^((n - 1)/2). */
#define RATE_LAW_POINT carreau
#include "rate_law.h"

enum { MU_0, MU_INFINITY, TIME, INDEX, ZETA };

static inline double carreau(const struct rate_law *par, double rate)
{
    const double *number = par->number;
    double x = number[TIME] * rate;
    return number[MU_INFINITY] + (number[MU_0] - number[MU_INFINITY]) * pow(1.0 + x * x, 0.5 * (number[INDEX] - 1.0));
}

static const struct bulla_param carreau_params[] = {
    {"mu-0", "Pa s", 0.0, 1e9, NAN, "viscosity at rest", BULLA_NUMBER, NULL},
    {"mu-infinity", "Pa s", 0.0, 1e9, NAN, "viscosity in fast shear", BULLA_NUMBER, NULL},
    {"time", "s", 0.0, 1e9, NAN, "l: one over the rate where it begins to thin", BULLA_NUMBER, NULL},
    {"index", "1", 0.0, 1.0, NAN, "n of the power law between the two viscosities", BULLA_NUMBER, NULL},
    LAW_ZETA,
    {0},
};

static const struct bulla_preset carreau_presets[] = {
    {"blood", "human blood at 37 C", (const double[]){0.056, 0.00345, 3.313, 0.3568, 0.0}},
    {0},
};

static int carreau_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
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
    .name = "carreau",
    .version = "1.0",
    .doc =
        "Carreau liquid: a plateau at rest, one in fast shear, a power law between. For blood and polymer solutions.",
    .cite = "Carreau, Trans. Soc. Rheol. 16 (1972) 99-127; blood: Cho & Kensey, Biorheology 28 (1991) 241-262",
    .params = carreau_params,
    .presets = carreau_presets,
    .open = carreau_open,
    .close = free,
    .table = &rate_law_table,
};
