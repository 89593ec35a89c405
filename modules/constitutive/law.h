/* law.h - what all elastic laws share: the small-strain numbers of the solid, and the descriptor.
 *
 * Every law is scaled by k = mu/(2 rho0), so that to first order in I1 - 3 and I2 - 3 its energy per mass is that of the
 * neo-Hookean solid, k (I1 - 3), and its shear wave is c_s = sqrt(mu/rho0). The including module lists its own numbers
 * after LAW_PARAMS and finds them in `own`. */
#ifndef LAW_H
#define LAW_H

#include "bulla/constitutive.h"

#include <math.h>
#include <stdlib.h>

enum { LAW_SHEAR_MODULUS, LAW_REFERENCE_DENSITY, LAW_OWN };

/* One solid. */
struct law {
    double k;   /* mu/(2 rho0) [J/kg] */
    double own; /* the third parameter of the law, if it has one */
};

#define LAW_PARAMS                                                                                             \
    {"shear-modulus", "Pa", 1e-6, 1e13, NAN, "shear modulus of small strains", BULLA_NUMBER, NULL},            \
    {                                                                                                          \
        "reference-density", "kg/m3", 1e-3, 1e5, NAN,                                                          \
            "density of the unstretched solid; sqrt(shear-modulus/reference-density) is its shear wave speed", \
            BULLA_NUMBER, NULL                                                                                 \
    }

/* Makes an instance; `own` as the module wants to keep it. */
static inline int law_open(const struct bulla_host *host, const struct bulla_value *values, double own, void **ret_self)
{
    struct law *self = malloc(sizeof *self);
    if (!self) {
        host->fail("out of memory");
        return 1;
    }
    self->k = 0.5 * values[LAW_SHEAR_MODULUS].number / values[LAW_REFERENCE_DENSITY].number;
    self->own = own;
    *ret_self = self;
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
