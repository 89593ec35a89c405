/* contract_solid.h - what a Riemann solver that knows solids does with shear: a part of the contract of kind
 * "riemann". */
#ifndef CONTRACT_SOLID_H
#define CONTRACT_SOLID_H

#include "suite/contract_face.h"

/* All checks that begin from one random face of a scene with a solid. */
void contract_solid_face(struct contract *contract, const struct contract_face *given);

#endif
