/* ideal_gas.c - p = (gamma - 1) rho e, T = p/((gamma - 1) cv rho). The family without attraction
 * and co-volume. */
#define FAMILY_ROOM family_room_all
#include "family_rows.h"

enum { GAMMA, CV, HEAT_BOND, ENTROPY_ZERO };

static const struct bulla_param ideal_gas_params[] = {
    {"gamma", "1", 1.0001, 100.0, NAN, "ratio of specific heats", BULLA_NUMBER, NULL},
    {"cv", "J/kg/K", 1e-3, 1e9, 717.5, "specific heat at constant volume; only temperatures depend on it", BULLA_NUMBER,
     NULL},
    {"heat-bond", "J/kg", -1e12, 1e12, 0.0, "energy at zero temperature; of a vapour, what its liquid is held by",
     BULLA_NUMBER, NULL},
    {"entropy-zero", "J/kg/K", -1e12, 1e12, 0.0, FAMILY_ENTROPY_ZERO, BULLA_NUMBER, NULL},
    {0},
};

static const struct bulla_preset ideal_gas_presets[] = {
    {"air", "dry air at room temperature", (const double[]){1.4, 717.5, 0.0, 0.0}},
    {"air-r287", "dry air with the gas constant 287.05 J/(kg K)", (const double[]){1.4, 717.625, 0.0, 0.0}},
    {"helium", "helium: gamma 5/3, gas constant 2077.26 J/(kg K)", (const double[]){5.0 / 3.0, 3115.9, 0.0, 0.0}},
    {"nitrogen", "nitrogen: gamma 1.4, 28.0135 g/mol", (const double[]){1.4, 742.0055, 0.0, 0.0}},
    {"argon", "argon: gamma 5/3, 39.948 g/mol", (const double[]){5.0 / 3.0, 312.1982, 0.0, 0.0}},
    {"krypton", "krypton: gamma 5/3, 83.798 g/mol", (const double[]){5.0 / 3.0, 148.8304, 0.0, 0.0}},
    {"carbon-dioxide", "carbon dioxide at 20 C (Span & Wagner 1996), 44.0098 g/mol",
     (const double[]){1.29076, 649.756, 0.0, 0.0}},
    {"sf6", "sulfur hexafluoride at 20 C (Guder & Wagner 2009), 146.0554 g/mol",
     (const double[]){1.094964, 599.453, 0.0, 0.0}},
    {"r22", "chlorodifluoromethane at 20 C (Kamei et al. 1995), 86.468 g/mol",
     (const double[]){1.175612, 547.550, 0.0, 0.0}},
    {"water-vapour", "water vapour at 20 C: gamma 1.33, 18.01527 g/mol", (const double[]){1.33, 1398.55, 0.0, 0.0}},
    {"water-2016", "steam of nasg, water-2016 (Le Metayer & Saurel 2016), gamma = cp/cv",
     (const double[]){1.467015707, 955.0, 2077616.0, 14317.0}},
    {"water-2004", "steam of stiffened-gas, water-2004 (Le Metayer et al. 2004)",
     (const double[]){1.43, 1040.0, 2030e3, -23.4e3}},
    {"water-2017", "steam of stiffened-gas, water-2017 (Chiapolino et al. 2017)",
     (const double[]){1.38, 1192.51, 2060759.0, -27238.6}},
    {"dodecane-2004", "vapour of stiffened-gas, dodecane-2004 (Le Metayer et al. 2004), gamma = cp/cv",
     (const double[]){1.025051125, 1956.0, -237547.0, -24485.0}},
    {0},
};

static int ideal_gas_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    struct family par = {.gamma = values[GAMMA].number,
                         .cv = values[CV].number,
                         .q = values[HEAT_BOND].number,
                         .q_s = values[ENTROPY_ZERO].number};
    return family_rows_open(host, par, ret_self);
}

/* Air: below 100 K it condenses, above 2000 K vibration and dissociation change gamma. */
static void ideal_gas_range(const void *self, struct bulla_eos_range *ret_range)
{
    (void)self;
    *ret_range = (struct bulla_eos_range){
        .rho_min = 0.0, .rho_max = 300.0, .p_min = 0.0, .p_max = 3e7, .T_min = 100.0, .T_max = 2000.0};
}

static const struct bulla_eos ideal_gas_table = FAMILY_TABLE(ideal_gas_range);

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "eos",
    .name = "ideal-gas",
    .version = "1.0",
    .doc = "Calorically perfect gas: p = (gamma - 1) rho e. For gases far from condensation and dissociation.",
    .cite = "Toro 2009, Riemann Solvers and Numerical Methods for Fluid Dynamics, section 1.2",
    .params = ideal_gas_params,
    .presets = ideal_gas_presets,
    .open = ideal_gas_open,
    .close = family_rows_close,
    .table = &ideal_gas_table,
};
