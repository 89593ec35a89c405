/* contract_conductivity.c - see contract_conductivity.h. The law is a coefficient (contract_coefficient.h). */
#include "suite/contract_conductivity.h"

#include "bulla/conductivity.h"
#include "suite/contract_coefficient.h"

void contract_conductivity_run(struct contract *contract)
{
    const struct bulla_conductivity *law = contract->module->table;
    contract_begin(contract, "heat does not look at the rate of shear", 0.0);
    contract_error(contract, (law->k.needs & BULLA_NEEDS_RATE) != 0, "needs = %u", law->k.needs);
    contract_coefficient_run(contract, &law->k, "k");
}

void contract_conductivity_probe(const struct contract *contract, double out[static CONTRACT_PROBE])
{
    const struct bulla_conductivity *law = contract->module->table;
    contract_coefficient_probe(contract, &law->k, out);
}
