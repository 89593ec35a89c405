/* mooney_rivlin.c - e^s = mu/(2 rho0) [(1 - r) (I1 - 3) + r (I2 - 3)]: the neo-Hookean solid with a part r of its
 * modulus carried by the second invariant. In Mooney's constants: C1 = (1 - r) mu/2, C2 = r mu/2. Linear in both
 * invariants. */
#include "law.h"

static const struct bulla_param mooney_rivlin_params[] = {
    LAW_PARAMS,
    {"ratio", "1", 0.0, 1.0, 0.2, "part of the modulus that goes with I2: C2/(C1 + C2); 0 is the neo-Hookean solid",
     BULLA_NUMBER, NULL},
    {0},
};

static const struct bulla_preset mooney_rivlin_presets[] = {LAW_PRESETS(0.2), {0}};

static int mooney_rivlin_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    struct law par = law_make(values, values[LAW_OWN].number);
    return law_keep(host, &par, sizeof par, ret_self);
}

BULLA_KERNEL static void mooney_rivlin_energy(const void *self, size_t n, const double *BULLA_RESTRICT I1,
                                              const double *BULLA_RESTRICT I2, double *BULLA_RESTRICT e,
                                              double *BULLA_RESTRICT e_1, double *BULLA_RESTRICT e_2)
{
    const struct law par = *(const struct law *)self;
    const double k_1 = par.k * (1.0 - par.own), k_2 = par.k * par.own;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        e[i] = k_1 * (I1[i] - 3.0) + k_2 * (I2[i] - 3.0);
        e_1[i] = k_1;
        e_2[i] = k_2;
    }
}

static const struct bulla_constitutive mooney_rivlin_table = {.size = sizeof(struct bulla_constitutive),
                                                              .energy = mooney_rivlin_energy,
                                                              .range = law_range_all};

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "constitutive",
    .name = "mooney-rivlin",
    .version = "1.0",
    .doc = "Mooney-Rivlin solid: e = mu/(2 rho0) ((1 - r) (I1 - 3) + r (I2 - 3)). Rubber up to stretches of about two.",
    .cite = "Mooney, J. Appl. Phys. 11 (1940) 582-592; Rivlin, Phil. Trans. R. Soc. A 241 (1948) 379-397",
    .params = mooney_rivlin_params,
    .presets = mooney_rivlin_presets,
    .open = mooney_rivlin_open,
    .close = law_close,
    .table = &mooney_rivlin_table,
};
