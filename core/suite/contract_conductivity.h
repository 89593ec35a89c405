/* contract_conductivity.h - the contract of kind "conductivity": bulla/conductivity.h says what, here it is
 * measured. */
#ifndef CONTRACT_CONDUCTIVITY_H
#define CONTRACT_CONDUCTIVITY_H

#include "suite/contract.h"

/* All checks of one instance. */
void contract_conductivity_run(struct contract *contract);

/* A few values by which instances are told apart; `out` is 0 before. */
void contract_conductivity_probe(const struct contract *contract, double out[static CONTRACT_PROBE]);

#endif
