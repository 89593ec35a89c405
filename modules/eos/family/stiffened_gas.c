/* stiffened_gas.c - p = (gamma - 1) rho (e - q) - gamma p_inf: a gas with an attraction p_inf that
 * gives liquids and soft solids their sound speed. The family without co-volume.
 *
 * Water has many parameter sets in the literature. The mechanical ones (sg4, sg44, sg659, sg659b)
 * give no temperature of their own; their cv is set so that T = 300 K at 998.2 kg/m3 and 1e5 Pa.
 *
 * Other liquids: gamma = 1 + B/A, p_inf = rho0 c0^2/gamma - 1e5 Pa from the density and the sound speed at rest, cv
 * such that the temperature there is right; docs/thermodynamics.md says which of these numbers are from where. */
#define FAMILY_ROOM family_room_all
#include "family_rows.h"

enum { GAMMA, P_INF, CV, HEAT_BOND, ENTROPY_ZERO };

static const struct bulla_param stiffened_gas_params[] = {
    {"gamma", "1", 1.0001, 100.0, NAN, "exponent; with p-inf it sets the sound speed", BULLA_NUMBER, NULL},
    {"p-inf", "Pa", 0.0, 1e13, NAN, "attraction: the pressure -p-inf is where the sound speed is zero", BULLA_NUMBER,
     NULL},
    {"cv", "J/kg/K", 1e-3, 1e9, 1000.0, "specific heat at constant volume; only temperatures depend on it",
     BULLA_NUMBER, NULL},
    {"heat-bond", "J/kg", -1e12, 1e12, 0.0, "energy at zero temperature; shifts the zero of energy", BULLA_NUMBER,
     NULL},
    {"entropy-zero", "J/kg/K", -1e12, 1e12, 0.0, FAMILY_ENTROPY_ZERO, BULLA_NUMBER, NULL},
    {0},
};

static const struct bulla_preset stiffened_gas_presets[] = {
    {"sg44", "water, gamma 4.4, p-inf 600 MPa (mechanical)", (const double[]){4.4, 6e8, 589.394243, 0.0, 0.0}},
    {"sg4", "water, gamma 4, p-inf 600 MPa (mechanical)", (const double[]){4.0, 6e8, 667.980142, 0.0, 0.0}},
    {"sg659", "water, gamma 6.59, p-inf 4049 atm (mechanical)",
     (const double[]){6.59, 4.10264925e8, 245.143061, 0.0, 0.0}},
    {"sg659b", "water, gamma 6.59, p-inf 410 MPa (mechanical)", (const double[]){6.59, 4.1e8, 244.984801, 0.0, 0.0}},
    {"sg3", "water, gamma 3, p-inf 853.3 MPa, with temperatures", (const double[]){3.0, 8.533e8, 1395.0, -1148e3, 0.0}},
    {"sg235", "water, gamma 2.35, p-inf 1 GPa (Le Metayer et al. 2004)",
     (const double[]){2.35, 1e9, 1816.0, -1167e3, 0.0}},
    {"water-2004", "water with steam (ideal-gas, water-2004), gamma = cp/cv (Le Metayer et al. 2004)",
     (const double[]){2.35, 1e9, 1816.0, -1167e3, 0.0}},
    {"water-2017", "water with steam (ideal-gas, water-2017), boils right at 1 atm (Chiapolino et al. 2017)",
     (const double[]){2.62, 9.05829e8, 1606.97, -1150975.0, 0.0}},
    {"dodecane-2004", "dodecane with its vapour (ideal-gas, dodecane-2004), gamma = cp/cv (Le Metayer et al. 2004)",
     (const double[]){2.352831941, 4e8, 1077.0, -755269.0, 0.0}},
    {"ethanol", "ethanol at 20 C: 789 kg/m3, 1159 m/s", (const double[]){11.5, 92060757.3, 37.9480823, 0.0, 0.0}},
    {"glycerol", "glycerol at 25 C: 1261 kg/m3, 1920 m/s", (const double[]){10.0, 464755040.0, 137.380513, 0.0, 0.0}},
    {"castor-oil", "castor oil at 25 C: 961 kg/m3, 1490 m/s",
     (const double[]){12.0, 177693008.3, 56.4109991, 0.0, 0.0}},
    {"mercury", "mercury at 25 C: 13534 kg/m3, 1450 m/s", (const double[]){8.8, 3233449431.8, 102.736299, 0.0, 0.0}},
    {"blood", "blood at 37 C: 1060 kg/m3, 1571 m/s", (const double[]){7.1, 368368093.0, 183.735215, 0.0, 0.0}},
    {"begostone", "BegoStone 15:3, its bulk modulus: 1995 kg/m3, 20.2 GPa (Esch et al. 2010)",
     (const double[]){4.4, 4590809090.9, 2308.80353, 0.0, 0.0}},
    {"begostone-15-6", "BegoStone 15:6, its bulk modulus: 1563 kg/m3, 8.6 GPa (Esch et al. 2010)",
     (const double[]){4.4, 1954445454.5, 1254.63668, 0.0, 0.0}},
    {"gypsum", "Ultracal-30 gypsum, an artificial stone, its bulk modulus: 1800 kg/m3, 11.75 GPa",
     (const double[]){4.4, 2671045454.5, 1488.86807, 0.0, 0.0}},
    {"pmma", "PMMA, its bulk modulus: 1180 kg/m3, 6.44 GPa; gamma from its Hugoniot (Kinslow 1970)",
     (const double[]){5.144, 1251554873.0, 873.158210, 0.0, 0.0}},
    {"gelatin", "gelatin in water, 10 %: 1030 kg/m3, 1520 m/s",
     (const double[]){6.2, 383724516.1, 244.456869, 0.0, 0.0}},
    {0},
};

static int stiffened_gas_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    struct family par = {.gamma = values[GAMMA].number,
                         .p_inf = values[P_INF].number,
                         .cv = values[CV].number,
                         .q = values[HEAT_BOND].number,
                         .q_s = values[ENTROPY_ZERO].number};
    return family_rows_open(host, par, ret_self);
}

/* Liquid water; in tension down to where the sound speed ends. */
static void stiffened_gas_range(const void *self, struct bulla_eos_range *ret_range)
{
    const struct family *par = self;
    *ret_range = (struct bulla_eos_range){
        .rho_min = 0.0, .rho_max = 3000.0, .p_min = -par->p_inf, .p_max = 1e10, .T_min = 273.0, .T_max = 500.0};
}

static const struct bulla_eos stiffened_gas_table = FAMILY_TABLE(stiffened_gas_range);

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "eos",
    .name = "stiffened-gas",
    .version = "1.0",
    .doc = "Stiffened gas: p = (gamma - 1) rho (e - q) - gamma p-inf. For liquids and soft solids under shocks; "
           "its temperatures are rough.",
    .cite = "Le Metayer, Massoni & Saurel, Int. J. Therm. Sci. 43 (2004) 265-276",
    .params = stiffened_gas_params,
    .presets = stiffened_gas_presets,
    .open = stiffened_gas_open,
    .close = family_rows_close,
    .table = &stiffened_gas_table,
};
