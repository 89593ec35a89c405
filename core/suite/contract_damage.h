/* contract_damage.h - the contract of kind "damage": bulla/damage.h says what, here it is measured. */
#ifndef CONTRACT_DAMAGE_H
#define CONTRACT_DAMAGE_H

#include "suite/contract.h"

/* All checks of one instance. */
void contract_damage_run(struct contract *contract);

/* A few values by which instances are told apart; `out` is 0 before. */
void contract_damage_probe(const struct contract *contract, double out[static CONTRACT_PROBE]);

#endif
