/* johnson_cook.c - Y = (A + B eps^n) (1 + C ln(1 + rate/rate0)) (1 - T*^m), T* = (T - Tr)/(Tm - Tr) within 0 and 1.
 *
 * The published factor is 1 + C ln(rate/rate0), which has no limit at rest; with the 1 in the logarithm it is 1 there
 * and the same at the rates the law was made for. Numbers differ between decks: A and B are of uniaxial stress. */
#include "strength.h"

#include <math.h>

enum { YIELD, HARDENING, EXPONENT, RATE, REFERENCE_RATE, SOFTENING, MELTING, ROOM };

struct johnson_cook {
    double A, B, n, C, per_rate, m, T_room, per_T; /* per_T = 1/(Tm - Tr); 0: no softening */
};

static const struct bulla_param johnson_cook_params[] = {
    {"yield", "Pa", 1e-6, 1e13, NAN, "A: strength of the unstrained metal, at rest", BULLA_NUMBER, NULL},
    {"hardening", "Pa", 0.0, 1e13, 0.0, "B of B eps^n", BULLA_NUMBER, NULL},
    {"exponent", "1", 0.01, 1.0, 1.0, "n of B eps^n", BULLA_NUMBER, NULL},
    {"rate-sensitivity", "1", 0.0, 1.0, 0.0, "C: growth of the strength with the logarithm of the rate", BULLA_NUMBER,
     NULL},
    {"reference-rate", "1/s", 1e-9, 1e12, 1.0, "rate from which the strength grows", BULLA_NUMBER, NULL},
    {"softening", "1", 0.01, 10.0, 1.0, "m: exponent of the temperature", BULLA_NUMBER, NULL},
    {"melting-temperature", "K", 0.0, 1e5, 0.0, "Tm, where the strength is 0; 0: no softening, no temperature needed",
     BULLA_NUMBER, NULL},
    {"room-temperature", "K", 0.0, 1e4, 298.0, "Tr, below which heat takes nothing", BULLA_NUMBER, NULL},
    {0}};

static const struct bulla_preset johnson_cook_presets[] = {{"copper", "OFHC copper, Johnson & Cook 1983",
                                                            (const double[]){90e6, 292e6, 0.31, 0.025, 1.0, 1.09,
                                                                             1356.0, 298.0}},
                                                           {0}};

static int johnson_cook_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    double melting = values[MELTING].number, room = values[ROOM].number;
    if (melting > 0.0 && melting <= room) {
        host->fail("melting-temperature is not above room-temperature");
        return 1;
    }
    const struct johnson_cook par = {.A = values[YIELD].number,
                                     .B = values[HARDENING].number,
                                     .n = values[EXPONENT].number,
                                     .C = values[RATE].number,
                                     .per_rate = 1.0 / values[REFERENCE_RATE].number,
                                     .m = values[SOFTENING].number,
                                     .T_room = room,
                                     .per_T = melting > 0.0 ? 1.0 / (melting - room) : 0.0};
    return strength_keep(host, &par, sizeof par, ret_self);
}

static void johnson_cook_strength(const void *self, size_t n, const double *BULLA_RESTRICT eps,
                                  const double *BULLA_RESTRICT rate, const double *BULLA_RESTRICT p,
                                  const double *BULLA_RESTRICT T, const double *BULLA_RESTRICT rho,
                                  double *BULLA_RESTRICT Y)
{
    const struct johnson_cook par = *(const struct johnson_cook *)self;
    (void)p, (void)rho;
    for (size_t i = 0; i < n; i++) {
        double hot = par.per_T * (T[i] - par.T_room), hard = par.A + par.B * pow(eps[i], par.n);
        hot = hot <= 0.0 ? 0.0 : hot >= 1.0 ? 1.0 : pow(hot, par.m);
        Y[i] = hard * (1.0 + par.C * log1p(rate[i] * par.per_rate)) * (1.0 - hot);
    }
}

static uint32_t johnson_cook_needs(const void *self)
{
    const struct johnson_cook *par = self;
    uint32_t needs = 0;
    if (par->B > 0.0) needs |= BULLA_INELASTIC_STRAIN;
    if (par->C > 0.0) needs |= BULLA_INELASTIC_RATE;
    if (par->per_T > 0.0) needs |= BULLA_INELASTIC_TEMPERATURE;
    return needs;
}

static const struct bulla_inelastic johnson_cook_table = {.size = sizeof(struct bulla_inelastic),
                                                          .strength = johnson_cook_strength,
                                                          .needs = johnson_cook_needs};

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "inelastic",
    .name = "johnson-cook",
    .version = "1.0",
    .doc = "Strength (A + B eps^n)(1 + C ln(1 + rate/rate0))(1 - T*^m). For metals at rates to 1e5 1/s that harden, "
           "and soften "
           "by the heat of their flow.",
    .cite = "Johnson & Cook, Proc. 7th Int. Symp. Ballistics (1983) 541-547",
    .params = johnson_cook_params,
    .presets = johnson_cook_presets,
    .open = johnson_cook_open,
    .close = strength_close,
    .table = &johnson_cook_table,
};
