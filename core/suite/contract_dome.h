/* contract_dome.h - the dome beside a gas: states in the box of its range that are none, for the contract of laws. */
#ifndef CONTRACT_DOME_H
#define CONTRACT_DOME_H

#include "bulla/eos.h"

#include <stdbool.h>

/* Does a continuation stand in for the formulas at (rho, p)? */
static inline bool contract_dome_outside(const struct bulla_eos *eos, const void *self, double rho, double p)
{
    return BULLA_EOS_HAS(eos, count_outside) && eos->count_outside(self, 1, &rho, &p) > 0;
}

/* Is (rho, p) in the dome of a gas: a continuation, while the same density at a higher pressure up to `most` is
 * none? */
static inline bool contract_dome(const struct bulla_eos *eos, const void *self, double rho, double p, double most)
{
    bool gas = BULLA_EOS_HAS(eos, gas_constant) && eos->gas_constant(self) > 0.0;
    if (!gas || !contract_dome_outside(eos, self, rho, p)) return false;
    for (double up = p; up > 0.0 && up <= most; up *= 1.2)
        if (!contract_dome_outside(eos, self, rho, up)) return true;
    return false;
}

/* May a stated range hold (rho, p): formulas, or the dome? */
static inline bool contract_dome_fair(const struct bulla_eos *eos, const void *self, double rho, double p, double most)
{
    return !contract_dome_outside(eos, self, rho, p) || contract_dome(eos, self, rho, p, most);
}

#endif
