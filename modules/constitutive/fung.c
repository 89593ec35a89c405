/* fung.c - e^s = mu/(2 rho0 b) (exp(b (I1 - 3)) - 1): the isotropic exponential law of soft tissue. At b (I1 - 3) = 12
 * the solid is 1.6e5 times as stiff as at rest, a tissue of 10 kPa as stiff in shear as water in compression: from
 * there on the continuation of stiffening.h, long before anything overflows. */
#define STIFFENING_POINT fung
#include "series.h"
#include "stiffening.h"

#define FUNG_EDGE 12.0

static inline struct stiffening_point fung(const struct stiffening *par, double x)
{
    double b = par->law.own, k = par->law.k, grown = series_expm1(b * x), slope = k * (grown + 1.0);
    return (struct stiffening_point){k / b * grown, slope, b * slope};
}

static const struct bulla_param fung_params[] = {
    LAW_PARAMS,
    {"stiffening", "1", 1e-6, 1e3, 1.0, "b: growth of the stiffness with I1 - 3; arteries have about 8", BULLA_NUMBER,
     NULL},
    {0},
};

static const struct bulla_preset fung_presets[] = {
    LAW_PRESETS(1.0),
    {"carotid", "human carotid artery (Delfino et al., J. Biomech. 30 (1997) 777-786)",
     (const double[]){4.42e4, 1060.0, 8.35}},
    {0},
};

static int fung_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    return stiffening_open(host, values, FUNG_EDGE / values[LAW_OWN].number, ret_self);
}

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "constitutive",
    .name = "fung",
    .version = "1.0",
    .doc = "Fung solid, isotropic: e = mu/(2 rho0 b) (exp(b (I1 - 3)) - 1). Soft tissue that stiffens exponentially; "
           "continued with constant second derivative from b (I1 - 3) = 12 on.",
    .cite = "Fung, Am. J. Physiol. 213 (1967) 1532-1544; Demiray, J. Biomech. 5 (1972) 309-311",
    .params = fung_params,
    .presets = fung_presets,
    .open = fung_open,
    .close = law_close,
    .table = &stiffening_table,
};
