/* contract_constitutive.h - the contract of kind "constitutive": bulla/constitutive.h says what, here it is
 * measured. */
#ifndef CONTRACT_CONSTITUTIVE_H
#define CONTRACT_CONSTITUTIVE_H

#include "suite/contract.h"

/* All checks of one instance. */
void contract_constitutive_run(struct contract *contract);

/* A few values by which instances are told apart; `out` is 0 before. */
void contract_constitutive_probe(const struct contract *contract, double out[static CONTRACT_PROBE]);

#endif
