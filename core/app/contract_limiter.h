/* contract_limiter.h - the contract of kind "limiter": bulla/limiter.h says what, here it is measured. */
#ifndef CONTRACT_LIMITER_H
#define CONTRACT_LIMITER_H

#include "app/contract.h"

/* All checks of one instance. */
void contract_limiter_run(struct contract *contract);

#endif
