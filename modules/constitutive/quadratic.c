/* quadratic.c - e^s = mu/(2 rho0) (J + a J^2/2), J = I1 - 3: the first term of every law that stiffens, which is what a
 * bubble's first collapse can tell of a gel. From a J = -1/2 down, where no stretch is (limited face values are none),
 * the slope is held, so that it stays positive. */
#include "law.h"

static const struct bulla_param quadratic_params[] = {
    LAW_PARAMS,
    {"stiffening", "1", 0.0, 1e3, 1.0, "a: growth of the stiffness with I1 - 3; to this order b of Fung's law",
     BULLA_NUMBER, NULL},
    {0},
};

static const struct bulla_preset quadratic_presets[] = {
    LAW_PRESETS(1.0),
    {0},
};

struct quadratic {
    struct law law;
    double least; /* J from which on the formula holds */
};

static int quadratic_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    double a = values[LAW_OWN].number;
    struct quadratic par = {law_make(values, a), a > 0.0 ? -0.5 / a : -(double)INFINITY};
    return law_keep(host, &par, sizeof par, ret_self);
}

BULLA_KERNEL static void quadratic_energy(const void *self, size_t n, const double *BULLA_RESTRICT I1,
                                          const double *BULLA_RESTRICT I2, double *BULLA_RESTRICT e,
                                          double *BULLA_RESTRICT e_1, double *BULLA_RESTRICT e_2)
{
    const struct quadratic par = *(const struct quadratic *)self;
    (void)I2;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double J = I1[i] - 3.0, x = J < par.least ? par.least : J, grown = par.law.own * x;
        e[i] = par.law.k * (x + 0.5 * grown * x + (1.0 + grown) * (J - x));
        e_1[i] = par.law.k * (1.0 + grown);
        e_2[i] = 0.0;
    }
}

BULLA_KERNEL static void quadratic_second(const void *self, size_t n, const double *BULLA_RESTRICT I1,
                                          const double *BULLA_RESTRICT I2, double *BULLA_RESTRICT e_11,
                                          double *BULLA_RESTRICT e_12, double *BULLA_RESTRICT e_22)
{
    const struct quadratic par = *(const struct quadratic *)self;
    (void)I2;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double J = I1[i] - 3.0;
        e_11[i] = par.law.k * par.law.own * (J < par.least ? 0.0 : 1.0) + J * 0.0; /* NaN stays NaN */
        e_12[i] = 0.0;
        e_22[i] = 0.0;
    }
}

static const struct bulla_constitutive quadratic_table = {.size = sizeof(struct bulla_constitutive),
                                                          .energy = quadratic_energy,
                                                          .second = quadratic_second,
                                                          .range = law_range_all,
                                                          .first_only = 1};

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "constitutive",
    .name = "quadratic",
    .version = "1.0",
    .doc = "Quadratic solid: e = mu/(2 rho0) (J + a J^2/2), J = I1 - 3. For gels and tissue that stiffen, as fitted to "
           "bubbles in them (with a viscosity: the quadratic Kelvin-Voigt model).",
    .cite = "Yang, Cramer & Franck, Extreme Mech. Lett. 39 (2020) 100839",
    .params = quadratic_params,
    .presets = quadratic_presets,
    .open = quadratic_open,
    .close = law_close,
    .table = &quadratic_table,
};
