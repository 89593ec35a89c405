/* bulla/constitutive.h - functions of a module of kind "constitutive".
 *
 * The elastic law of one isotropic solid. Core evolves the unimodular left stretch V (det V = 1) and hands
 * over the invariants of the unimodular left Cauchy-Green tensor B = V V^T,
 *     I1 = tr B,   I2 = (I1^2 - tr B^2)/2,   both 3 in the unstretched body and above 3 elsewhere.
 * A law is its elastic energy per mass e^s(I1, I2); core forms everything else from it (model.md 3;
 * Barton, J. Comput. Phys. 390 (2019) 25-50): with m = alpha rho and subscripts for derivatives
 *     deviatoric stress  s' = 2 m [(e_1 + I1 e_2) dev B - e_2 dev B^2],
 * and the wave speeds from its derivative. The pressure is the business of the equation of state alone.
 * Every call is a batch over n points: [any thread; pure; no allocation; n >= 1; arrays do not overlap; unit
 * stride; SI units]. The value at a point must not depend on its place in the row or on n.
 *
 * Well-posed means, for every I1, I2 >= 3 (and down to 1: limited face values are not quite unimodular):
 * everything finite, e^s = 0 at I1 = I2 = 3 and e_1 + e_2 > 0 from there on. A law with a pole (a limiting
 * stretch) continues its formulas before it is reached and says so in `range`.
 */
#ifndef BULLA_CONSTITUTIVE_H
#define BULLA_CONSTITUTIVE_H

#include "bulla/module.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Where the formulas are as published; beyond it a continuation rules. */
struct bulla_constitutive_range {
    double I1_max, I2_max; /* infinity: no end */
};

struct bulla_constitutive {
    uint32_t size; /* sizeof(struct bulla_constitutive) */

    /* The hot call: e^s [J/kg] and its first derivatives e_1 = d e^s/d I1, e_2 = d e^s/d I2 [J/kg]. */
    void (*energy)(const void *self, size_t n, const double *BULLA_RESTRICT I1, const double *BULLA_RESTRICT I2,
                   double *BULLA_RESTRICT e, double *BULLA_RESTRICT e_1, double *BULLA_RESTRICT e_2);

    /* Second derivatives e_11, e_12, e_22 [J/kg], for wave speeds. Optional: NULL says that all are 0, which makes
     * the law cheaper. */
    void (*second)(const void *self, size_t n, const double *BULLA_RESTRICT I1, const double *BULLA_RESTRICT I2,
                   double *BULLA_RESTRICT e_11, double *BULLA_RESTRICT e_12, double *BULLA_RESTRICT e_22);

    /* Validity of the formulas as published. */
    void (*range)(const void *self, struct bulla_constitutive_range *ret_range);

    /* 1: e^s depends on I1 alone and e_2 must be 0 everywhere: core then skips the terms of I2. */
    uint32_t first_only;
};

#ifdef __cplusplus
}
#endif
#endif
