/* contract_coefficient.h - the contract of bulla/coefficient.h, which kinds of transport laws have in common. */
#ifndef CONTRACT_COEFFICIENT_H
#define CONTRACT_COEFFICIENT_H

#include "bulla/coefficient.h"
#include "suite/contract.h"

/* All checks of one coefficient of an instance. `name`: of the call, as tables show it. */
void contract_coefficient_run(struct contract *contract, const struct bulla_coefficient *law, const char *name);

/* A few values by which instances are told apart. */
void contract_coefficient_probe(const struct contract *contract, const struct bulla_coefficient *law,
                                double out[static CONTRACT_PROBE]);

#endif
