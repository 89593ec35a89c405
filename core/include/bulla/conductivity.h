/* bulla/conductivity.h - functions of a module of kind "conductivity".
 *
 * The law of one material: conductivity of heat k [W/(m K)],
 *     q = -k grad T,
 * as a function of what bulla/coefficient.h lists but the rate of shear.
 */
#ifndef BULLA_CONDUCTIVITY_H
#define BULLA_CONDUCTIVITY_H

#include "bulla/coefficient.h"

#ifdef __cplusplus
extern "C" {
#endif

struct bulla_conductivity {
    struct bulla_coefficient k; /* k.size: sizeof(struct bulla_conductivity); no BULLA_NEEDS_RATE */
};

#ifdef __cplusplus
}
#endif
#endif
