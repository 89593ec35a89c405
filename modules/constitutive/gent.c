/* gent.c - e^s = -mu/(2 rho0) J_m ln(1 - (I1 - 3)/J_m): chains of limited length; the stiffness has a pole where I1 - 3
 * reaches J_m. From 95 % of the way on, where the solid is 20 times as stiff as at rest, the continuation of
 * stiffening.h takes over: a limit for the stretch still, but one that a wave can be computed with. */
#define STIFFENING_POINT gent
#include "series.h"
#include "stiffening.h"

#define GENT_EDGE 0.95

static inline struct stiffening_point gent(const struct stiffening *par, double x)
{
    double limit = par->law.own, k = par->law.k, left = limit / (limit - x);
    return (struct stiffening_point){-k * limit * series_log1m(x / limit), k * left, k / limit * (left * left)};
}

static const struct bulla_param gent_params[] = {
    LAW_PARAMS,
    {"limit", "1", 1e-2, 1e6, 97.2, "J_m: I1 - 3 where the chains are at full length; rubber has 30 to 100",
     BULLA_NUMBER, NULL},
    {0},
};

static const struct bulla_preset gent_presets[] = {LAW_PRESETS(97.2), {0}};

static int gent_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    return stiffening_open(host, values, GENT_EDGE * values[LAW_OWN].number, ret_self);
}

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "constitutive",
    .name = "gent",
    .version = "1.0",
    .doc = "Gent solid: e = -mu/(2 rho0) Jm ln(1 - (I1 - 3)/Jm). Stiffens towards a largest stretch; continued with "
           "constant second derivative from 95 % of Jm on.",
    .cite = "Gent, Rubber Chem. Technol. 69 (1996) 59-61",
    .params = gent_params,
    .presets = gent_presets,
    .open = gent_open,
    .close = law_close,
    .table = &stiffening_table,
};
