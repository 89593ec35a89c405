/* quadratic.c - e^s = mu/(2 rho0) (J + a J^2/2), J = I1 - 3: the first term of every law that stiffens, which is what a
 * bubble's first collapse can tell of a gel. It has no pole, so stiffening.h never continues it. From a J = -1/2 down,
 * where no stretch is (limited face values are none), the slope is held, so that it stays positive. */
#define STIFFENING_POINT quadratic
#include "stiffening.h"

#include <stdbool.h>

static inline struct stiffening_point quadratic(const struct stiffening *par, double x)
{
    double a = par->law.own, k = par->law.k, grown = a * x, least = -0.5 / a; /* -infinity where a is 0 */
    bool held = grown < -0.5;
    double from = held ? least : x, slope = held ? 0.5 * k : k * (1.0 + grown);
    double e = k * (from + 0.5 * a * from * from) + slope * (x - from);
    return (struct stiffening_point){e, slope, held ? 0.0 : k * a};
}

static const struct bulla_param quadratic_params[] = {
    LAW_PARAMS,
    {"stiffening", "1", 0.0, 1e3, 1.0, "a: growth of the stiffness with I1 - 3; to this order b of Fung's law",
     BULLA_NUMBER, NULL},
    {0},
};

static const struct bulla_preset quadratic_presets[] = {
    LAW_PRESETS(1.0),
    {0},
};

static int quadratic_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    return stiffening_open(host, values, (double)INFINITY, ret_self);
}

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "constitutive",
    .name = "quadratic",
    .version = "1.0",
    .doc = "Quadratic solid: e = mu/(2 rho0) (J + a J^2/2), J = I1 - 3. For gels and tissue that stiffen, as fitted to "
           "bubbles in them (with a viscosity: the quadratic Kelvin-Voigt model).",
    .cite = "Yang, Cramer & Franck, Extreme Mech. Lett. 39 (2020) 100839",
    .params = quadratic_params,
    .presets = quadratic_presets,
    .open = quadratic_open,
    .close = law_close,
    .table = &stiffening_table,
};
