/* contract_viscosity.h - the contract of kind "viscosity": bulla/viscosity.h says what, here it is measured. */
#ifndef CONTRACT_VISCOSITY_H
#define CONTRACT_VISCOSITY_H

#include "suite/contract.h"

/* All checks of one instance. */
void contract_viscosity_run(struct contract *contract);

/* A few values by which instances are told apart; `out` is 0 before. */
void contract_viscosity_probe(const struct contract *contract, double out[static CONTRACT_PROBE]);

#endif
