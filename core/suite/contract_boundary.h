/* contract_boundary.h - the contract of kind "boundary": bulla/boundary.h says what, here it is measured. */
#ifndef CONTRACT_BOUNDARY_H
#define CONTRACT_BOUNDARY_H

#include "suite/contract.h"

/* All checks of one instance. */
void contract_boundary_run(struct contract *contract);

/* A few values by which instances are told apart; `out` is 0 before. */
void contract_boundary_probe(const struct contract *contract, double out[static CONTRACT_PROBE]);

#endif
