/* bulla/viscosity.h - functions of a module of kind "viscosity".
 *
 * The law of one material: shear viscosity mu [Pa s] and, if it has one, bulk viscosity zeta [Pa s],
 *     tau = 2 mu dev D + zeta (div u) I,   D = (grad u + grad u^T)/2,
 * as functions of what bulla/coefficient.h lists. A yield stress must be regularised: `most` bounds mu.
 */
#ifndef BULLA_VISCOSITY_H
#define BULLA_VISCOSITY_H

#include "bulla/coefficient.h"

#ifdef __cplusplus
extern "C" {
#endif

struct bulla_viscosity {
    struct bulla_coefficient mu; /* mu.size: sizeof(struct bulla_viscosity) */

    /* Bulk viscosity of n points, of the same rows as mu but the rate. Optional: NULL says 0. */
    void (*zeta)(const void *self, size_t n, const double *BULLA_RESTRICT T, const double *BULLA_RESTRICT p,
                 const double *BULLA_RESTRICT rho, double *BULLA_RESTRICT zeta);
};

#ifdef __cplusplus
}
#endif
#endif
