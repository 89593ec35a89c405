/* neo_hookean.c - e^s = mu/(2 rho0) (I1 - 3): the energy of a network of Gaussian chains, used for gels and, with a
 * modulus of its own, for each soft tissue. Linear in I1, so the wave speeds need no second derivatives. A
 * modulus of 0 is that of a Maxwell fluid, whose branches bear all. */
#include "law.h"

static const struct bulla_param neo_hookean_params[] = {LAW_PARAMS_FROM(0.0), {0}};

static const struct bulla_preset neo_hookean_presets[] = {
    LAW_PRESETS(),
    {"begostone", "BegoStone 15:3, an artificial kidney stone, 10.7 GPa (Esch et al. 2010)",
     (const double[]){10.7e9, 1995.0}},
    {"begostone-15-6", "BegoStone 15:6, a soft one, 5.1 GPa (Esch et al. 2010)", (const double[]){5.1e9, 1563.0}},
    {"gypsum", "Ultracal-30 gypsum, an artificial kidney stone, 4.16 GPa", (const double[]){4.15872e9, 1800.0}},
    {"pmma", "PMMA, 1.48 GPa", (const double[]){1.480192e9, 1180.0}},
    {0},
};

static int neo_hookean_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    struct law par = law_make(values, 0.0);
    return law_keep(host, &par, sizeof par, ret_self);
}

BULLA_KERNEL static void neo_hookean_energy(const void *self, size_t n, const double *BULLA_RESTRICT I1,
                                            const double *BULLA_RESTRICT I2, double *BULLA_RESTRICT e,
                                            double *BULLA_RESTRICT e_1, double *BULLA_RESTRICT e_2)
{
    const double k = ((const struct law *)self)->k;
    (void)I2;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        e[i] = k * (I1[i] - 3.0);
        e_1[i] = k;
        e_2[i] = 0.0;
    }
}

static const struct bulla_constitutive neo_hookean_table = {.size = sizeof(struct bulla_constitutive),
                                                            .energy = neo_hookean_energy,
                                                            .range = law_range_all,
                                                            .first_only = 1};

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "constitutive",
    .name = "neo-hookean",
    .version = "1.0",
    .doc =
        "Neo-Hookean solid: e = mu/(2 rho0) (I1 - 3). For gels and soft tissue at moderate stretch; the usual choice.",
    .cite = "Rivlin, Phil. Trans. R. Soc. A 240 (1948) 459-490; Barton, J. Comput. Phys. 390 (2019) 25-50",
    .params = neo_hookean_params,
    .presets = neo_hookean_presets,
    .open = neo_hookean_open,
    .close = law_close,
    .table = &neo_hookean_table,
};
