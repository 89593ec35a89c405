/* contract_reconstruction.h - the contract of kind "reconstruction": bulla/reconstruction.h says what, here it is
 * measured. */
#ifndef CONTRACT_RECONSTRUCTION_H
#define CONTRACT_RECONSTRUCTION_H

#include "suite/contract.h"

/* All checks of one instance. */
void contract_reconstruction_run(struct contract *contract);

/* A few values by which instances are told apart; `out` is 0 before. */
void contract_reconstruction_probe(const struct contract *contract, double out[static CONTRACT_PROBE]);

#endif
