/* contract_limiter.h - the contract of kind "limiter": bulla/limiter.h says what, here it is measured. */
#ifndef CONTRACT_LIMITER_H
#define CONTRACT_LIMITER_H

#include "suite/contract.h"

/* All checks of one instance. */
void contract_limiter_run(struct contract *contract);

/* A few values by which instances are told apart; `out` is 0 before. */
void contract_limiter_probe(const struct contract *contract, double out[static CONTRACT_PROBE]);

#endif
