/* von_mises.c - Y = Y0 + H eps^n: perfectly plastic with H = 0, linear hardening with n = 1. Independent of rate and
 * temperature. */
#include "strength.h"

#include <math.h>

enum { YIELD, HARDENING, EXPONENT, STRAIN };

struct von_mises {
    double yield, hardening, exponent;
    int told; /* the plastic strain is asked for, though it may not matter */
};

static const struct bulla_param von_mises_params[] = {
    {"yield", "Pa", 1e-6, 1e13, NAN, "stress in uniaxial tension at which plastic flow begins", BULLA_NUMBER, NULL},
    {"hardening", "Pa", 0.0, 1e13, 0.0, "H: what a plastic strain of 1 adds; 0: perfectly plastic", BULLA_NUMBER, NULL},
    {"exponent", "1", 0.01, 1.0, 1.0, "n of H eps^n; 1: linear hardening", BULLA_NUMBER, NULL},
    {"strain", NULL, 0.0, 0.0, 0.0,
     "whether the plastic strain is a field: where it hardens, or also in a perfectly plastic solid, for output",
     BULLA_CHOICE, "needed|always"},
    {0}};

static int von_mises_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    const struct von_mises par = {values[YIELD].number, values[HARDENING].number, values[EXPONENT].number,
                                  values[STRAIN].text && strcmp(values[STRAIN].text, "always") == 0};
    return strength_keep(host, &par, sizeof par, ret_self);
}

BULLA_KERNEL static void von_mises_linear(const struct von_mises *self, size_t n, const double *BULLA_RESTRICT eps,
                                          double *BULLA_RESTRICT Y)
{
    const double yield = self->yield, hardening = self->hardening;
#pragma omp simd
    for (size_t i = 0; i < n; i++) Y[i] = yield + hardening * eps[i];
}

static void von_mises_strength(const void *self, size_t n, const double *BULLA_RESTRICT eps,
                               const double *BULLA_RESTRICT rate, const double *BULLA_RESTRICT p,
                               const double *BULLA_RESTRICT T, const double *BULLA_RESTRICT rho,
                               double *BULLA_RESTRICT Y)
{
    const struct von_mises *par = self;
    (void)rate, (void)p, (void)T, (void)rho;
    if (par->exponent == 1.0 || par->hardening == 0.0) {
        von_mises_linear(par, n, eps, Y);
        return;
    }
    for (size_t i = 0; i < n; i++) Y[i] = par->yield + par->hardening * pow(eps[i], par->exponent);
}

static uint32_t von_mises_needs(const void *self)
{
    const struct von_mises *par = self;
    return par->hardening > 0.0 || par->told ? BULLA_INELASTIC_STRAIN : 0;
}

static const struct bulla_inelastic von_mises_table = {.size = sizeof(struct bulla_inelastic),
                                                       .strength = von_mises_strength,
                                                       .needs = von_mises_needs};

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "inelastic",
    .name = "von-mises",
    .version = "1.0",
    .doc =
        "Strength Y + H eps^n: perfectly plastic, or with linear or power hardening. For metals when neither rate nor "
        "temperature matters much; the one with closed-form answers.",
    .cite = "von Mises, Nachr. Ges. Wiss. Goettingen (1913) 582-592; Wilkins, Methods Comput. Phys. 3 (1964) 211-263",
    .params = von_mises_params,
    .open = von_mises_open,
    .close = strength_close,
    .table = &von_mises_table,
};
