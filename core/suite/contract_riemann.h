/* contract_riemann.h - the contract of kind "riemann": bulla/riemann.h says what, here it is measured. */
#ifndef CONTRACT_RIEMANN_H
#define CONTRACT_RIEMANN_H

#include "suite/contract.h"

/* All checks of one instance, with 1, 2, 3 and 5 materials and 1 to 3 velocities. */
void contract_riemann_run(struct contract *contract);

/* A few values by which instances are told apart; `out` is 0 before. */
void contract_riemann_probe(const struct contract *contract, double out[static CONTRACT_PROBE]);

#endif
