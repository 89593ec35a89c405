/* nasg.c - Noble-Abel stiffened gas: p = (gamma - 1)(e - q)/(v - b) - gamma p_inf. */
#include "nasg_module.h"

static const struct bulla_param nasg_params[] = NASG_PARAMS(1.19, 7028e5, 6.61e-4, -1177788.0, 3610.0);

static const struct bulla_preset nasg_presets[] = {
    {"water", "liquid water, 300 K to 500 K", (const double[]){1.19, 7028e5, 6.61e-4, -1177788.0, 3610.0, 0.0}},
    {"water-2016", "liquid water with steam (ideal-gas, water-2016), gamma = cp/cv (Le Metayer & Saurel 2016)",
     (const double[]){1.186980609, 7028e5, 6.61e-4, -1177788.0, 3610.0, 0.0}},
    {0},
};

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "eos",
    .name = "nasg",
    .version = "1.0",
    .doc = "Noble-Abel stiffened gas: a stiffened gas with a co-volume. Liquid water (the defaults) with sound "
           "speed and temperatures that are both useful from 300 K to 500 K.",
    .cite = "Le Metayer & Saurel, Phys. Fluids 28 (2016) 046102, equations 13-20",
    .params = nasg_params,
    .presets = nasg_presets,
    .open = nasg_module_open,
    .close = family_rows_close,
    .table = &nasg_module_table,
};
