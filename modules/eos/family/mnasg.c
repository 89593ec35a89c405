/* mnasg.c - modified NASG: the formulas of nasg.c with p_inf and b fitted anew so that density and
 * sound speed of water at 300 K and 1e5 Pa are right (997.0 kg/m3, 1500 m/s). */
#include "nasg_module.h"

static const struct bulla_param mnasg_params[] = NASG_PARAMS(1.19, 6217.8e5, 6.7212e-4, -1177788.0, 3610.0);

static const struct bulla_preset mnasg_presets[] = {
    {"water", "liquid water, density and sound speed right at 300 K",
     (const double[]){1.19, 6217.8e5, 6.7212e-4, -1177788.0, 3610.0, 0.0}},
    {0},
};

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "eos",
    .name = "mnasg",
    .version = "1.0",
    .doc = "Modified Noble-Abel stiffened gas: NASG with density and sound speed of water right at 300 K (the "
           "defaults). For bubble collapse in water up to a few GPa.",
    .cite = "Le Metayer & Saurel, Phys. Fluids 28 (2016) 046102, equations 13-20, with refitted p_inf and b",
    .params = mnasg_params,
    .presets = mnasg_presets,
    .open = nasg_module_open,
    .close = family_rows_close,
    .table = &nasg_module_table,
};
