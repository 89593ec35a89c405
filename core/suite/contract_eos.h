/* contract_eos.h - the contract of kind "eos": bulla/eos.h says what, here it is measured. */
#ifndef CONTRACT_EOS_H
#define CONTRACT_EOS_H

#include "suite/contract.h"

/* Where the identities of thermodynamics are tested: states with these densities and temperatures,
 * pressures from the larger of p_least and p_min(rho) up to p_most. */
struct contract_eos_box {
    double rho[2];
    double p_least, p_most;
    double T[2];
};

/* All checks of one instance, in the range that the module states. */
void contract_eos_run(struct contract *contract);

/* The same in another box, e.g. one that reaches into the continuation. */
void contract_eos_run_in(struct contract *contract, const struct contract_eos_box *box);

/* A few values by which instances are told apart; `out` is 0 before. */
void contract_eos_probe(const struct contract *contract, double out[static CONTRACT_PROBE]);

#endif
