/* helmholtz_air.c - dry air as one fluid, by the reference formulation of Lemmon et al. (2000).
 *
 * The formulation holds from 60 K to 2000 K and to 2 GPa, and extrapolates smoothly to some 20 000 K; near 30 000 K its
 * heat capacity turns negative. The domain ends below at the isotherm of 140 K, a little above the critical point
 * (132.6 K), so that air does not condense; above at 20 000 K and at 1900 kg/m3. Beyond, the continuations of
 * helmholtz_state.h hold. No dissociation, which real air shows above some 4000 K. */
#define HELMHOLTZ_GAS 1
#include "helmholtz_open.h"
#include "lemmon_air_terms.h"

static const struct bulla_param helmholtz_air_params[] = HELMHOLTZ_PARAMS(256.0);

static const struct bulla_preset helmholtz_air_presets[] = {
    {"air", "dry air", (const double[]){256.0, NAN, NAN}},
    {0},
};

static double helmholtz_air_T_low(const struct helmholtz_law *law, double rho)
{
    (void)law, (void)rho;
    return 140.0;
}

static const struct helmholtz_law helmholtz_air_law = {
    .name = "helmholtz-air",
    .fluid = &lemmon_air_fluid,
    .rho_low = 0.0,
    .rho_high = 1900.0,
    .T_high = 2e4,
    .grid_T = 135.0,
    .grid_T_high = 20500.0,
    .gamma = 1.4,
    .pull = 0.0,
    .p_min = 0.0,
    .T_min = 60.0,
    .gas = 1,
    .T_low = helmholtz_air_T_low,
};

static int helmholtz_air_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    return helmholtz_open(&helmholtz_air_law, host, values, ret_self);
}

/* As the paper states it, down to where the domain ends. */
static void helmholtz_air_range(const void *self, struct bulla_eos_range *ret_range)
{
    (void)self;
    *ret_range = (struct bulla_eos_range){
        .rho_min = 0.0, .rho_max = 1300.0, .p_min = 0.0, .p_max = 2e9, .T_min = 140.0, .T_max = 2000.0};
}

static const struct bulla_eos helmholtz_air_table = HELMHOLTZ_TABLE(helmholtz_air_range);

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "eos",
    .name = "helmholtz-air",
    .version = "1.0",
    .doc = "Dry air by the reference formulation of Lemmon et al., tabulated at the start. From near vacuum to bubbles "
           "at the end of a collapse; no condensation, no dissociation.",
    .cite = "Lemmon, Jacobsen, Penoncello & Friend, J. Phys. Chem. Ref. Data 29 (2000) 331-385",
    .params = helmholtz_air_params,
    .presets = helmholtz_air_presets,
    .open = helmholtz_air_open,
    .close = free,
    .table = &helmholtz_air_table,
};
