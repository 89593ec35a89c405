/* contract_field.h - the contract of kind "field": bulla/field.h says what, here it is measured. */
#ifndef CONTRACT_FIELD_H
#define CONTRACT_FIELD_H

#include "suite/contract.h"

/* All checks of one instance. */
void contract_field_run(struct contract *contract);

/* A few values by which instances are told apart; `out` is 0 before. */
void contract_field_probe(const struct contract *contract, double out[static CONTRACT_PROBE]);

#endif
