/* vogel.c - mu = A exp(B/(T - C)); where that exponent passes VOGEL_MOST, near the pole at C and below, mu stays. */
#include "law.h"

#define VOGEL_MOST 20.0

enum { AMPLITUDE, TEMPERATURE, POLE, ZETA_RATIO };

static const struct bulla_param vogel_params[] = {
    {"amplitude", "Pa s", 0.0, 1e9, NAN, "A: what it falls to in great heat", BULLA_NUMBER, NULL},
    {"temperature", "K", 0.0, 1e5, NAN, "B: how fast it falls", BULLA_NUMBER, NULL},
    {"pole", "K", 0.0, 1e4, NAN, "C: where it would be infinite", BULLA_NUMBER, NULL},
    LAW_ZETA_RATIO,
    {0},
};

static const struct bulla_preset vogel_presets[] = {
    {"water", "liquid water, 2.5 % from 0 to 370 C", (const double[]){2.414e-5, 570.5805860439246, 140.0, 2.8}},
    {0},
};

static int vogel_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    const double par[] = {values[AMPLITUDE].number, values[TEMPERATURE].number, values[POLE].number,
                          values[ZETA_RATIO].number};
    return law_keep(host, par, sizeof par, ret_self);
}

/* Compared so that a NaN stays one. */
static void vogel_row(size_t n, const double *par, double factor, const double *BULLA_RESTRICT T,
                      double *BULLA_RESTRICT mu)
{
    const double least = par[TEMPERATURE] / VOGEL_MOST;
    for (size_t i = 0; i < n; i++) {
        double above = T[i] - par[POLE], x = par[TEMPERATURE] / (above < least ? least : above);
        mu[i] = factor * exp(par[TEMPERATURE] > 0.0 ? x : 0.0 * above);
    }
}

static void vogel_mu(const void *self, size_t n, const double *BULLA_RESTRICT rate, const double *BULLA_RESTRICT T,
                     const double *BULLA_RESTRICT p, const double *BULLA_RESTRICT rho, double *BULLA_RESTRICT mu)
{
    const double *par = self;
    (void)rate, (void)p, (void)rho;
    vogel_row(n, par, par[AMPLITUDE], T, mu);
}

static void vogel_zeta(const void *self, size_t n, const double *BULLA_RESTRICT T, const double *BULLA_RESTRICT p,
                       const double *BULLA_RESTRICT rho, double *BULLA_RESTRICT zeta)
{
    const double *par = self;
    (void)p, (void)rho;
    vogel_row(n, par, par[ZETA_RATIO] * par[AMPLITUDE], T, zeta);
}

static const struct bulla_viscosity vogel_table = {.mu = {.size = sizeof(struct bulla_viscosity),
                                                          .needs = BULLA_NEEDS_TEMPERATURE,
                                                          .value = vogel_mu},
                                                   .zeta = vogel_zeta};

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "viscosity",
    .name = "vogel",
    .version = "1.0",
    .doc =
        "Vogel's law of liquids: falls with temperature from a pole; below the temperature where the exponent is 20 it "
        "stays.",
    .cite = "Vogel, Phys. Z. 22 (1921) 645-646; numbers of water: a common engineering fit, 2.414e-5 Pa s x "
            "10^(247.8 K/(T - 140 K))",
    .params = vogel_params,
    .presets = vogel_presets,
    .open = vogel_open,
    .close = free,
    .table = &vogel_table,
};
