/* steinberg_guinan.c - Y = min(Y0 (1 + beta (eps + eps_i))^n, Ymax) [1 + A p/eta^(1/3) - B (T - 300 K)], eta =
 * rho/rho0; 0 above Tm = Tm0 exp(2 a (1 - 1/eta)) eta^(2 (gamma0 - a - 1/3)).
 *
 * For rates above 1e5 1/s, where metals no longer harden with the rate. The modulus that the law changes in the same
 * way stays constant here: one that depends on T has no energy e^s(V) of its own. A is often printed as "2.83 1/Pa" for
 * copper; it is 2.83 1/Mbar. */
#include "strength.h"

#include <math.h>

enum { YIELD, YIELD_MOST, HARDENING, EXPONENT, INITIAL, DENSITY, PRESSURE, TEMPERATURE, MELTING, MELTING_A, GAMMA };

#define STEINBERG_GUINAN_ROOM 300.0 /* K */

struct steinberg_guinan {
    double yield, most, beta, n, initial, per_rho0, A, B, melting, a, power;
};

static const struct bulla_param steinberg_guinan_params[] = {
    {"yield", "Pa", 1e-6, 1e13, NAN, "Y0: strength of the unstrained metal at 300 K, without pressure", BULLA_NUMBER,
     NULL},
    {"yield-most", "Pa", 1e-6, 1e13, NAN, "Ymax: the most that strain makes of it", BULLA_NUMBER, NULL},
    {"hardening", "1", 0.0, 1e6, 0.0, "beta", BULLA_NUMBER, NULL},
    {"exponent", "1", 0.0, 1.0, 1.0, "n of (1 + beta (eps + eps_i))^n", BULLA_NUMBER, NULL},
    {"initial-strain", "1", 0.0, 10.0, 0.0, "eps_i: what the metal has behind it", BULLA_NUMBER, NULL},
    {"reference-density", "kg/m3", 1e-3, 1e5, NAN, "rho0", BULLA_NUMBER, NULL},
    {"pressure-coefficient", "1/Pa", 0.0, 1e-6, 0.0, "A: growth of the strength with pressure", BULLA_NUMBER, NULL},
    {"temperature-coefficient", "1/K", 0.0, 1.0, 0.0, "B: loss of strength with temperature; 0: none", BULLA_NUMBER,
     NULL},
    {"melting-temperature", "K", 0.0, 1e5, 0.0, "Tm0, at rho0; 0: the metal does not melt", BULLA_NUMBER, NULL},
    {"melting-a", "1", 0.0, 10.0, 1.5, "a of the melting curve", BULLA_NUMBER, NULL},
    {"gamma", "1", 0.0, 10.0, 2.0, "gamma0 of the melting curve", BULLA_NUMBER, NULL},
    {0}};

static const struct bulla_preset steinberg_guinan_presets[] = {
    {"copper", "OFHC copper, half hard",
     (const double[]){0.12e9, 0.64e9, 36.0, 0.45, 0.0, 8930.0, 0.0283e-9, 3.77e-4, 1790.0, 1.5, 2.02}},
    {"aluminium-6061", "aluminium 6061-T6",
     (const double[]){0.29e9, 0.68e9, 125.0, 0.10, 0.0, 2703.0, 0.0652e-9, 6.16e-4, 1220.0, 1.5, 1.97}},
    {"tungsten-alloy", "W-3.5Ni-1.5Fe",
     (const double[]){1.87e9, 4.0e9, 7.7, 0.13, 0.0, 18167.0, 0.0103e-9, 1.52e-4, 2263.0, 1.3, 1.67}},
    {0}};

static int steinberg_guinan_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    const struct steinberg_guinan par = {.yield = values[YIELD].number,
                                         .most = values[YIELD_MOST].number,
                                         .beta = values[HARDENING].number,
                                         .n = values[EXPONENT].number,
                                         .initial = values[INITIAL].number,
                                         .per_rho0 = 1.0 / values[DENSITY].number,
                                         .A = values[PRESSURE].number,
                                         .B = values[TEMPERATURE].number,
                                         .melting = values[MELTING].number,
                                         .a = values[MELTING_A].number,
                                         .power = 2.0 * (values[GAMMA].number - values[MELTING_A].number - 1.0 / 3.0)};
    if (par.most < par.yield) {
        host->fail("yield-most is below yield");
        return 1;
    }
    return strength_keep(host, &par, sizeof par, ret_self);
}

static void steinberg_guinan_strength(const void *self, size_t n, const double *BULLA_RESTRICT eps,
                                      const double *BULLA_RESTRICT rate, const double *BULLA_RESTRICT p,
                                      const double *BULLA_RESTRICT T, const double *BULLA_RESTRICT rho,
                                      double *BULLA_RESTRICT Y)
{
    const struct steinberg_guinan par = *(const struct steinberg_guinan *)self;
    (void)rate;
    for (size_t i = 0; i < n; i++) {
        double hard = par.yield * pow(1.0 + par.beta * (eps[i] + par.initial), par.n), factor = 1.0;
        hard = hard > par.most ? par.most : hard;
        if (rho[i] > 0.0) {
            double eta = rho[i] * par.per_rho0,
                   melts = par.melting * exp(2.0 * par.a * (1.0 - 1.0 / eta)) * pow(eta, par.power);
            factor += par.A * p[i] / cbrt(eta) - (par.B > 0.0 ? par.B * (T[i] - STEINBERG_GUINAN_ROOM) : 0.0);
            if (par.melting > 0.0 && T[i] >= melts) factor = 0.0;
        }
        Y[i] = factor <= 0.0 ? 0.0 : hard * factor;
    }
}

static uint32_t steinberg_guinan_needs(const void *self)
{
    const struct steinberg_guinan *par = self;
    uint32_t needs = 0;
    if (par->beta > 0.0 && par->n > 0.0) needs |= BULLA_INELASTIC_STRAIN;
    if (par->A > 0.0) needs |= BULLA_INELASTIC_PRESSURE;
    if (par->B > 0.0 || par->melting > 0.0) needs |= BULLA_INELASTIC_PRESSURE | BULLA_INELASTIC_TEMPERATURE;
    return needs;
}

static const struct bulla_inelastic steinberg_guinan_table = {.size = sizeof(struct bulla_inelastic),
                                                              .strength = steinberg_guinan_strength,
                                                              .needs = steinberg_guinan_needs};

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "inelastic",
    .name = "steinberg-guinan",
    .version = "1.0",
    .doc =
        "Strength that grows with strain and pressure and falls with temperature, up to melting. For metals in strong "
        "shocks, above rates of 1e5 1/s.",
    .cite =
        "Steinberg, Cochran & Guinan, J. Appl. Phys. 51 (1980) 1498-1504; numbers: Steinberg, UCRL-MA-106439 (1996)",
    .params = steinberg_guinan_params,
    .presets = steinberg_guinan_presets,
    .open = steinberg_guinan_open,
    .close = strength_close,
    .table = &steinberg_guinan_table,
};
