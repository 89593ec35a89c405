/* peng_robinson.c - the equation of state of Peng and Robinson: d1, d2 = 1 +- sqrt 2,
 *     alpha = (1 + m (1 - sqrt(T/Tc)))^2,   m = 0.37464 + 1.54226 omega - 0.26992 omega^2.
 * alpha is taken as it is above its zero (1487 K for air), where it grows again: dp/dT loses little. */
#include "shared/elementary.h"

#include <math.h>

#define CUBIC_ATTRACTION peng_robinson_attraction
#include "cubic.h"

/* d alpha/dT = -m g/sqrt(T Tc), d2 alpha/dT2 = m (1 + m) Tc^(1/2)/(2 T^(3/2)) /Tc */
ELEMENTARY_INLINE struct cubic_attraction peng_robinson_attraction(const struct cubic *par, double T)
{
    double m = par->shape, root = sqrt(T / par->Tc), g = 1.0 + m * (1.0 - root), scale = par->ac * m / par->Tc;
    return (struct cubic_attraction){par->ac * g * g, -scale * g / root,
                                     0.5 * scale * (1.0 + m) / (par->Tc * root * root * root)};
}

#include "cubic_open.h"

static const struct bulla_param peng_robinson_params[] = {CUBIC_PARAMS, CUBIC_TABLED_PARAMS, {0}};

static const struct bulla_preset peng_robinson_presets[] = {
    {"air", "air as one fluid", (const double[]){CUBIC_AIR, CUBIC_TABLED_AIR}},
    {0},
};

static int peng_robinson_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    struct cubic par = cubic_rows_read(values);
    double omega = values[CUBIC_OMEGA].number, RT = par.R * par.Tc, pc = values[CUBIC_PC].number;
    par.shape = 0.37464 + omega * (1.54226 - 0.26992 * omega);
    par.ac = 0.45723552892138218938 * RT * RT / pc;
    par.b = 0.077796073903888455972 * RT / pc;
    par.d1 = 1.0 + sqrt(2.0);
    par.d2 = 1.0 - sqrt(2.0);
    return cubic_tabled_open(host, par, "peng-robinson", values + CUBIC_OWN, ret_self);
}

static const struct bulla_eos peng_robinson_functions = CUBIC_TABLED_FUNCTIONS;

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "eos",
    .name = "peng-robinson",
    .version = "1.0",
    .doc = "Peng-Robinson gas with vibrating molecules. For gases that are compressed strongly; air (the defaults) "
           "up to some 500 MPa.",
    .cite = "Peng & Robinson, Ind. Eng. Chem. Fundam. 15 (1976) 59-64",
    .params = peng_robinson_params,
    .presets = peng_robinson_presets,
    .open = peng_robinson_open,
    .close = free,
    .table = &peng_robinson_functions,
};
