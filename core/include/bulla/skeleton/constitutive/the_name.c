/* the_name.c - the elastic law of a solid: a neo-Hookean one that stiffens when it is stretched far.
 *
 * The elastic energy per mass is a function of the invariants I1, I2 of the unimodular left Cauchy-Green tensor, here
 *     e = mu/(2 rho0) (J + a J^3),   J = I1 - 3,
 * of which core makes stress and wave speeds. Yours may be any function that keeps to bulla/constitutive.h: 0 at
 * I1 = I2 = 3, growing with every stretch, finite wherever a solver may get. `bulla module check` tests all of that. */
#include <bulla/constitutive.h>

#include <math.h>
#include <stdlib.h>

/* One instance: what `open` makes of the values in a case. */
struct the_name_values {
    double k, a; /* k = mu/(2 rho0) [J/kg] */
};

/* Where a law has two sides, compute both and select one at the end with `?:`; then a row becomes vectors. Below I1 = 3
 * is no stretch, only round-off and limited face values; the energy has to go on smoothly there. */
BULLA_KERNEL static void the_name_energy(const void *self, size_t n, const double *BULLA_RESTRICT I1,
                                         const double *BULLA_RESTRICT I2, double *BULLA_RESTRICT e,
                                         double *BULLA_RESTRICT e_1, double *BULLA_RESTRICT e_2)
{
    const struct the_name_values par = *(const struct the_name_values *)self;
    (void)I2;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double J = I1[i] - 3.0, aJ2 = par.a * J * J;
        e[i] = par.k * (J + aJ2 * J);
        e_1[i] = par.k * (1.0 + 3.0 * aJ2);
        e_2[i] = 0.0;
    }
}

/* Second derivatives, for wave speeds. A law that is linear in I1 and I2 leaves them out of its table. */
BULLA_KERNEL static void the_name_second(const void *self, size_t n, const double *BULLA_RESTRICT I1,
                                         const double *BULLA_RESTRICT I2, double *BULLA_RESTRICT e_11,
                                         double *BULLA_RESTRICT e_12, double *BULLA_RESTRICT e_22)
{
    const struct the_name_values par = *(const struct the_name_values *)self;
    (void)I2;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        e_11[i] = 6.0 * par.k * par.a * (I1[i] - 3.0);
        e_12[i] = 0.0;
        e_22[i] = 0.0;
    }
}

/* Where the formulas are as published. A law with a pole continues them before it is reached and says where. */
static void the_name_range(const void *self, struct bulla_constitutive_range *ret_range)
{
    (void)self;
    *ret_range = (struct bulla_constitutive_range){.I1_max = INFINITY, .I2_max = INFINITY};
}

/* first_only: the law does not depend on I2, and core need not look at it. */
static const struct bulla_constitutive the_name_table = {.size = sizeof(struct bulla_constitutive),
                                                         .energy = the_name_energy,
                                                         .second = the_name_second,
                                                         .range = the_name_range,
                                                         .first_only = 1};

/* The keys of a case: name, SI unit, least, most, default (NAN: must be given), one sentence.
 * `open` gets the values in this order. */
enum { SHEAR_MODULUS, REFERENCE_DENSITY, STIFFENING };

static const struct bulla_param the_name_params[] = {
    {"shear-modulus", "Pa", 1e-3, 1e13, 1e5, "shear modulus of small strains", BULLA_NUMBER, 0},
    {"reference-density", "kg/m3", 1e-3, 1e5, 1000.0, "density of the unstretched solid", BULLA_NUMBER, 0},
    {"stiffening", "1", 0.0, 1e3, 0.1, "a: growth of the stiffness with (I1 - 3)^2", BULLA_NUMBER, 0},
    {0},
};

/* To refuse values that the table cannot: host->fail("why"); return 1. */
static int the_name_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    struct the_name_values *self = malloc(sizeof *self);
    if (!self) {
        host->fail("out of memory");
        return 1;
    }
    self->k = 0.5 * values[SHEAR_MODULUS].number / values[REFERENCE_DENSITY].number;
    self->a = values[STIFFENING].number;
    *ret_self = self;
    return 0;
}

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof(struct bulla_module),
    .kind = "constitutive",
    .name = "the-name",
    .version = "0.1",
    .doc = "Say what the law is. Say what solid it is good for.",
    .cite = "paper and equation",
    .params = the_name_params,
    .open = the_name_open,
    .close = free,
    .table = &the_name_table,
};
