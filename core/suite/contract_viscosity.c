/* contract_viscosity.c - see contract_viscosity.h. Both viscosities are coefficients (contract_coefficient.h); the bulk
 * one looks at no rate. */
#include "suite/contract_viscosity.h"

#include "bulla/viscosity.h"
#include "suite/contract_coefficient.h"

/* zeta in the shape of a coefficient: `self` stands for the instance and its table. */
struct contract_viscosity_bulk {
    const struct bulla_viscosity *law;
    const void *self;
};

static void contract_viscosity_zeta(const void *self, size_t n, const double *BULLA_RESTRICT rate,
                                    const double *BULLA_RESTRICT T, const double *BULLA_RESTRICT p,
                                    const double *BULLA_RESTRICT rho, double *BULLA_RESTRICT value)
{
    const struct contract_viscosity_bulk *bulk = self;
    (void)rate;
    bulk->law->zeta(bulk->self, n, T, p, rho, value);
}

void contract_viscosity_run(struct contract *contract)
{
    const struct bulla_viscosity *law = contract->module->table;
    contract_coefficient_run(contract, &law->mu, "mu");
    if (!law->zeta) return;
    const void *self = contract->self;
    struct contract_viscosity_bulk bulk = {.law = law, .self = self};
    const struct bulla_coefficient zeta = {.size = sizeof zeta,
                                           .needs = law->mu.needs & ~(uint32_t)BULLA_NEEDS_RATE,
                                           .value = contract_viscosity_zeta};
    contract->self = &bulk;
    contract_coefficient_run(contract, &zeta, "zeta");
    contract->self = self;
}

void contract_viscosity_probe(const struct contract *contract, double out[static CONTRACT_PROBE])
{
    const struct bulla_viscosity *law = contract->module->table;
    const double T = 300.0, p = 1e5, rho = 1000.0;
    contract_coefficient_probe(contract, &law->mu, out);
    if (law->zeta)
        law->zeta(contract->self, 1, law->mu.needs & BULLA_NEEDS_TEMPERATURE ? &T : NULL,
                  law->mu.needs & BULLA_NEEDS_PRESSURE ? &p : NULL, law->mu.needs & BULLA_NEEDS_DENSITY ? &rho : NULL,
                  &out[CONTRACT_PROBE - 1]);
}
