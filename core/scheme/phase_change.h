/* phase_change.h - liquids evaporate and vapours condense, after every stage: what a stage makes is brought to
 * equilibrium, or towards it (phys/phase.h). The midpoint too, else the stiff limit is of first order and its pressures
 * are those of stretched liquid. Sound speeds in solvers and time step stay the frozen ones, which are the largest
 * (docs/numerics.md, 7c). */
#ifndef PHASE_CHANGE_H
#define PHASE_CHANGE_H

#include "scheme/operator.h"

extern const struct operator phase_change_operator;

#endif
