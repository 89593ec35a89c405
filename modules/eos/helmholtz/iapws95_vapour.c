/* iapws95_vapour.c - water vapour by the reference formulation IAPWS-95: the same Helmholtz energy as iapws95.c, on the
 * other side of the dome, so that both have one zero of energy and of entropy and liquid and vapour meet on the true
 * saturation curve.
 *
 * All of the stable vapour of 300 K lies below 0.026 kg/m3, beside states far within the dome. Rows of the table are
 * therefore equally spaced in ln(rho + 0.02 kg/m3), and the domain ends below, at each density, at the highest T with
 * (dp/drho)_T = 0.02 R T, beside the spinodal of the metastable vapour: 0.022 kg/m3 at 250 K, 0.37 at 300 K, 28 at 500
 * K, 193 at 640 K. Above the critical density it ends at 657.5 K, at any density at 250 K and 3200 K, at 1720 kg/m3.
 * Beyond, the continuations of helmholtz_state.h hold. No liquid: a state of less volume below the critical temperature
 * is iapws95's. */
#define HELMHOLTZ_GAS 1
#define HELMHOLTZ_SKEW 0.02
#include "helmholtz_open.h"
#include "iapws95_terms.h"

static const struct bulla_param iapws95_vapour_params[] = HELMHOLTZ_PARAMS(256.0);

static const struct bulla_preset iapws95_vapour_presets[] = {
    {"water-vapour", "ordinary water", (const double[]){256.0, NAN, NAN}},
    {0},
};

/* The lower end of the domain, K at kg/m3, from scans of (dp/drho)_T. */
static const double iapws95_vapour_knots[][2] = {{0.0223, 250},    {0.03538, 257.2}, {0.05381, 263.8}, {0.08183, 270.6},
                                                 {0.12446, 277.7}, {0.18928, 285.3}, {0.28788, 294.2}, {0.43783, 305.3},
                                                 {0.66588, 319},   {1.01272, 334.7}, {1.54022, 351.6}, {2.34248, 369.6},
                                                 {3.56261, 388.6}, {5.41829, 408.6}, {8.24054, 429.8}, {12.5328, 452.2},
                                                 {19.0609, 476},   {28.9892, 501.6}, {44.0889, 529.3}, {67.0538, 559.8},
                                                 {101.98, 593},    {134.869, 615.4}, {178.364, 635.6}, {235.887, 650.4},
                                                 {271.27, 655.4},  {312, 657.5}};

static double iapws95_vapour_T_low(const struct helmholtz_law *law, double rho)
{
    size_t n = sizeof iapws95_vapour_knots / sizeof *iapws95_vapour_knots, i = 0;
    (void)law;
    if (rho <= iapws95_vapour_knots[0][0]) return iapws95_vapour_knots[0][1];
    if (rho >= iapws95_vapour_knots[n - 1][0]) return iapws95_vapour_knots[n - 1][1];
    while (rho > iapws95_vapour_knots[i + 1][0]) i++;
    const double *low = iapws95_vapour_knots[i], *high = iapws95_vapour_knots[i + 1];
    return low[1] + log(rho / low[0]) / log(high[0] / low[0]) * (high[1] - low[1]);
}

static const struct helmholtz_law iapws95_vapour_law = {
    .name = "iapws95-vapour",
    .fluid = &iapws95_fluid,
    .rho_low = 0.0,
    .rho_high = 1720.0,
    .T_high = 3200.0,
    .grid_T = 240.0,
    .grid_T_high = 3300.0,
    .gamma = 1.33,
    .pull = 0.0,
    .p_min = 0.0,
    .T_min = 100.0,
    .gas = 1,
    .T_low = iapws95_vapour_T_low,
};

static int iapws95_vapour_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    return helmholtz_open(&iapws95_vapour_law, host, values, ret_self);
}

/* As the formulation states it; the dome is cut off the box (count_outside). */
static void iapws95_vapour_range(const void *self, struct bulla_eos_range *ret_range)
{
    (void)self;
    *ret_range = (struct bulla_eos_range){
        .rho_min = 0.0, .rho_max = 1000.0, .p_min = 0.0, .p_max = 1e9, .T_min = 273.16, .T_max = 1273.0};
}

static const struct bulla_eos iapws95_vapour_table = HELMHOLTZ_TABLE(iapws95_vapour_range);

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "eos",
    .name = "iapws95-vapour",
    .version = "1.0",
    .doc = "Water vapour by the reference formulation IAPWS-95, tabulated at the start: from near vacuum to the "
           "spinodal of "
           "metastable vapour, and supercritical. With a liquid of iapws95 a pair with the true saturation curve.",
    .cite = "Wagner & Pruss, J. Phys. Chem. Ref. Data 31 (2002) 387-535; IAPWS R6-95(2018)",
    .params = iapws95_vapour_params,
    .presets = iapws95_vapour_presets,
    .open = iapws95_vapour_open,
    .close = free,
    .table = &iapws95_vapour_table,
};
