/* contract_suite.c - see contract_suite.h. */
#include "suite/contract_suite.h"

#include "suite/contract_boundary.h"
#include "suite/contract_conductivity.h"
#include "suite/contract_constitutive.h"
#include "suite/contract_damage.h"
#include "suite/contract_eos.h"
#include "suite/contract_field.h"
#include "suite/contract_inelastic.h"
#include "suite/contract_limiter.h"
#include "suite/contract_reconstruction.h"
#include "suite/contract_riemann.h"
#include "suite/contract_viscosity.h"

#include <stddef.h>
#include <string.h>

static const struct {
    const char *kind;
    void (*run)(struct contract *contract);
    void (*probe)(const struct contract *contract, double out[static CONTRACT_PROBE]);
} contract_suite_table[] = {{"boundary", contract_boundary_run, contract_boundary_probe},
                            {"conductivity", contract_conductivity_run, contract_conductivity_probe},
                            {"constitutive", contract_constitutive_run, contract_constitutive_probe},
                            {"damage", contract_damage_run, contract_damage_probe},
                            {"eos", contract_eos_run, contract_eos_probe},
                            {"field", contract_field_run, contract_field_probe},
                            {"inelastic", contract_inelastic_run, contract_inelastic_probe},
                            {"limiter", contract_limiter_run, contract_limiter_probe},
                            {"reconstruction", contract_reconstruction_run, contract_reconstruction_probe},
                            {"riemann", contract_riemann_run, contract_riemann_probe},
                            {"viscosity", contract_viscosity_run, contract_viscosity_probe}};

enum { SUITE_KINDS = sizeof contract_suite_table / sizeof *contract_suite_table };

void contract_suite_run(struct contract *contract)
{
    for (int i = 0; i < SUITE_KINDS; i++)
        if (!strcmp(contract_suite_table[i].kind, contract->module->kind)) contract_suite_table[i].run(contract);
}

void contract_suite_probe(const struct contract *contract, double out[static CONTRACT_PROBE])
{
    memset(out, 0, CONTRACT_PROBE * sizeof *out);
    for (int i = 0; i < SUITE_KINDS; i++)
        if (!strcmp(contract_suite_table[i].kind, contract->module->kind)) contract_suite_table[i].probe(contract, out);
}

const char *const *contract_suite_kinds(void)
{
    static const char *names[SUITE_KINDS + 1];
    for (int i = 0; i < SUITE_KINDS; i++) names[i] = contract_suite_table[i].kind;
    return names;
}
