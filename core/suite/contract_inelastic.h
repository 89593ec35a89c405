/* contract_inelastic.h - the contract of kind "inelastic": bulla/inelastic.h says what, here it is measured. */
#ifndef CONTRACT_INELASTIC_H
#define CONTRACT_INELASTIC_H

#include "suite/contract.h"

/* All checks of one instance. */
void contract_inelastic_run(struct contract *contract);

/* A few values by which instances are told apart; `out` is 0 before. */
void contract_inelastic_probe(const struct contract *contract, double out[static CONTRACT_PROBE]);

#endif
