/* johnson_cook.c - D is the integral of d eps/eps_f, with the plastic strain at fracture
 *     eps_f = (D1 + D2 exp(D3 s))(1 + D4 ln(1 + rate/rate0))(1 + D5 T*),   s = -p/q,   T* = (T - T0)/(Tm - T0).
 * The paper has ln(rate/rate0), which has no limit at rest; the one here is 0 there. s is taken from -1.5 to 1.5, the
 * range of the data, and eps_f is at least `least`. */
#include "criterion.h"

enum { D1, D2, D3, D4, D5, RATE, MELT, ROOM, LEAST, JC_NUMBERS };

#define JC_TRIAXIAL 1.5

static const struct bulla_param johnson_cook_params[] = {
    {"d1", "1", -10.0, 100.0, NAN, "strain at fracture without triaxiality, first part", BULLA_NUMBER, NULL},
    {"d2", "1", 0.0, 1000.0, NAN, "its second part, which falls with tension", BULLA_NUMBER, NULL},
    {"d3", "1", -100.0, 0.0, NAN, "how fast it falls", BULLA_NUMBER, NULL},
    {"d4", "1", -1.0, 10.0, 0.0, "how it grows with the rate", BULLA_NUMBER, NULL},
    {"d5", "1", 0.0, 100.0, 0.0, "how it grows with temperature", BULLA_NUMBER, NULL},
    {"reference-rate", "1/s", 1e-9, 1e12, 1.0, "rate of the tests", BULLA_NUMBER, NULL},
    {"melting-temperature", "K", 0.0, 1e5, 0.0, "Tm; 0: temperature does not matter", BULLA_NUMBER, NULL},
    {"room-temperature", "K", 0.0, 1e5, 298.0, "T0", BULLA_NUMBER, NULL},
    {"least", "1", 1e-6, 10.0, 0.01, "eps_f is never less", BULLA_NUMBER, NULL},
    {0}};

static int johnson_cook_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    double par[JC_NUMBERS];
    for (int i = 0; i < JC_NUMBERS; i++) par[i] = values[i].number;
    if (par[MELT] > 0.0 && par[MELT] <= par[ROOM]) {
        host->fail("'melting-temperature' is not above 'room-temperature'");
        return 1;
    }
    return criterion_keep(host, par, sizeof par, ret_self);
}

/* eps_f at one point. */
static double johnson_cook_strain(const double *par, double tension, double mises, double rate, double T)
{
    double most = JC_TRIAXIAL * mises, mean = tension > most ? most : tension;
    mean = mean < -most ? -most : mean;
    double s = mises > 0.0 ? mean / mises : 0.0, warm = 0.0;
    if (par[MELT] > 0.0) warm = (T - par[ROOM]) / (par[MELT] - par[ROOM]);
    warm = warm < 0.0 ? 0.0 : warm > 1.0 ? 1.0 : warm;
    double eps =
        (par[D1] + par[D2] * exp(par[D3] * s)) * (1.0 + par[D4] * log1p(rate / par[RATE])) * (1.0 + par[D5] * warm);
    return eps < par[LEAST] ? par[LEAST] : eps;
}

static void johnson_cook_grow(const void *self, size_t n, const struct bulla_damage_state *state,
                              double *BULLA_RESTRICT aim, double *BULLA_RESTRICT rate)
{
    const double *par = self;
    for (size_t i = 0; i < n; i++) {
        double r = state->rate[i] /
                   johnson_cook_strain(par, state->tension[i], state->mises[i], state->rate[i], state->temperature[i]);
        aim[i] = 1.0;
        rate[i] = !(r > 0.0) ? 0.0 : r < BULLA_DAMAGE_AT_ONCE ? r : BULLA_DAMAGE_AT_ONCE;
    }
}

static uint32_t johnson_cook_needs(const void *self)
{
    const double *par = self;
    uint32_t needs = BULLA_DAMAGE_RATE | BULLA_DAMAGE_TENSION | BULLA_DAMAGE_MISES;
    return par[MELT] > 0.0 ? needs | BULLA_DAMAGE_TEMPERATURE : needs;
}

static const struct bulla_preset johnson_cook_presets[] = {
    {"copper", "OFHC copper", (const double[]){0.54, 4.89, -3.03, 0.014, 1.12, 1.0, 1356.0, 298.0, 0.01}},
    {"steel-4340", "4340 steel", (const double[]){0.05, 3.44, -2.12, 0.002, 0.61, 1.0, 1793.0, 298.0, 0.01}},
    {0}};

static const struct bulla_damage johnson_cook_table = {.size = sizeof(struct bulla_damage),
                                                       .grow = johnson_cook_grow,
                                                       .needs = johnson_cook_needs};

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "damage",
    .name = "johnson-cook",
    .version = "1.0",
    .doc = "Breaks by plastic strain, the sooner the more tension, the colder and the slower. For ductile metals with "
           "a strength "
           "that is one of the same deck.",
    .cite = "Johnson & Cook, Eng. Fract. Mech. 21 (1985) 31-48, eq. 3 and table 1",
    .params = johnson_cook_params,
    .presets = johnson_cook_presets,
    .open = johnson_cook_open,
    .close = criterion_close,
    .table = &johnson_cook_table,
};
