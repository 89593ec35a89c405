/* law.h - what all elastic laws share: the small-strain numbers of the solid, and the descriptor.
 *
 * Every law is scaled by k = mu/(2 rho0), so that to first order in I1 - 3 and I2 - 3 its energy per mass is that of
 * the neo-Hookean solid, k (I1 - 3), and its shear wave is c_s = sqrt(mu/rho0). The including module lists its own
 * numbers after LAW_PARAMS and finds them in `own`. */
#ifndef LAW_H
#define LAW_H

#include "bulla/constitutive.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LAW_SHEAR_MODULUS, LAW_REFERENCE_DENSITY, LAW_OWN };

/* One solid. */
struct law {
    double k;   /* mu/(2 rho0) [J/kg] */
    double own; /* the third parameter of the law, if it has one */
};

/* Moduli of tissues and gels; the arguments are what the law wants to know besides. */
#define LAW_PRESETS(...)                                                                       \
    {"liver", "liver, 1.8 kPa", (const double[]){1.8e3, 1060.0, __VA_ARGS__}},                 \
        {"gallbladder", "gall bladder, 85 kPa", (const double[]){8.5e4, 1060.0, __VA_ARGS__}}, \
        {"bile-duct", "bile duct, 166 kPa", (const double[]){1.66e5, 1060.0, __VA_ARGS__}},    \
    {                                                                                          \
        "agarose", "agarose gel, 7.23 kPa", (const double[])                                   \
        {                                                                                      \
            7.23e3, 1010.0, __VA_ARGS__                                                        \
        }                                                                                      \
    }

/* Of at least `least` Pa. */
#define LAW_PARAMS_FROM(least)                                                                                 \
    {"shear-modulus", "Pa", least, 1e13, NAN, "shear modulus of small strains", BULLA_NUMBER, NULL},           \
    {                                                                                                          \
        "reference-density", "kg/m3", 1e-3, 1e5, NAN,                                                          \
            "density of the unstretched solid; sqrt(shear-modulus/reference-density) is its shear wave speed", \
            BULLA_NUMBER, NULL                                                                                 \
    }
#define LAW_PARAMS LAW_PARAMS_FROM(1e-6)

static inline struct law law_make(const struct bulla_value *values, double own)
{
    return (struct law){0.5 * values[LAW_SHEAR_MODULUS].number / values[LAW_REFERENCE_DENSITY].number, own};
}

/* Keeps a copy of `size` bytes as the instance. */
static inline int law_keep(const struct bulla_host *host, const void *par, size_t size, void **ret_self)
{
    void *self = malloc(size);
    if (!self) {
        host->fail("out of memory");
        return 1;
    }
    *ret_self = memcpy(self, par, size);
    return 0;
}

static void law_close(void *self)
{
    free(self);
}

/* Formulas without an end. */
static inline void law_range_all(const void *self, struct bulla_constitutive_range *ret_range)
{
    (void)self;
    *ret_range = (struct bulla_constitutive_range){.I1_max = (double)INFINITY, .I2_max = (double)INFINITY};
}

#endif
