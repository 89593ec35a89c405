/* bulla/coefficient.h - a number of a material as a function of its state: what kinds of transport laws share.
 *
 * A law says what it looks at, and gets rows of that alone:
 *     rate   sqrt(2 D':D') of the deviator D' of the velocity gradient's symmetric part [1/s], the rate of shear in
 * plane shear flow T      temperature of the material [K] p      pressure [Pa] rho    density of the material [kg/m3]
 * A law that looks at nothing is a constant: core asks once and keeps the number.
 * Every call is a batch over n points: [any thread; pure; no allocation; n >= 1; arrays do not overlap; unit stride; SI
 * units]. The value at a point must not depend on its place in the row or on n.
 *
 * Well-posed means: finite and not negative for any rate >= 0, T > 0, rho > 0 and any p, however far from where
 * the formula was fitted: traces of a material get temperatures of 1 K and 1e5 K, limited faces rates of 1e12
 * 1/s. */
#ifndef BULLA_COEFFICIENT_H
#define BULLA_COEFFICIENT_H

#include "bulla/module.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What a law looks at: bits. */
enum bulla_needs {
    BULLA_NEEDS_RATE = 1,
    BULLA_NEEDS_TEMPERATURE = 2,
    BULLA_NEEDS_PRESSURE = 4,
    BULLA_NEEDS_DENSITY = 8
};

struct bulla_coefficient {
    uint32_t size;  /* sizeof of the table that begins with this */
    uint32_t needs; /* enum bulla_needs, added up; 0: a constant */

    /* The hot call. Rows that `needs` does not name are NULL. */
    void (*value)(const void *self, size_t n, const double *BULLA_RESTRICT rate, const double *BULLA_RESTRICT T,
                  const double *BULLA_RESTRICT p, const double *BULLA_RESTRICT rho, double *BULLA_RESTRICT value);

    /* For laws that look at the rate: what no value exceeds, at any rate and state. The time step goes by it. Else
     * NULL. */
    double (*most)(const void *self);
};

#ifdef __cplusplus
}
#endif
#endif
