/* viscosity.c - the contract of kind "viscosity" (core/suite/contract_viscosity.c, contract_coefficient.c) on every
 * built-in law, each law against its published formula, and faults that the contract must find. */
#include "mutants.h"

#include "bulla/viscosity.h"

static const char *const names[] = {"newtonian", NULL};

static double mu_at(const struct bulla_module *module, const void *self, double rate, double T)
{
    const struct bulla_viscosity *law = module->table;
    double mu, p = 1e5, rho = 1000.0;
    law->mu.value(self, 1, law->mu.needs & BULLA_NEEDS_RATE ? &rate : NULL,
                  law->mu.needs & BULLA_NEEDS_TEMPERATURE ? &T : NULL, law->mu.needs & BULLA_NEEDS_PRESSURE ? &p : NULL,
                  law->mu.needs & BULLA_NEEDS_DENSITY ? &rho : NULL, &mu);
    return mu;
}

static double zeta_at(const struct bulla_module *module, const void *self, double T)
{
    const struct bulla_viscosity *law = module->table;
    double zeta;
    law->zeta(self, 1, law->mu.needs & BULLA_NEEDS_TEMPERATURE ? &T : NULL, NULL, NULL, &zeta);
    return zeta;
}

/* Values in the state of the presets, by hand. */
static void test_values(void **state)
{
    (void)state;
    const struct bulla_module *newtonian = support_module("viscosity", "newtonian");
    struct instance water = support_open_preset(newtonian, "water");
    assert_true(mu_at(newtonian, water.self, 1.0, 300.0) == 0.890e-3 &&
                zeta_at(newtonian, water.self, 300.0) == 2.492e-3);
    instance_done(&water);
}

static void test_contract(void **state)
{
    (void)state;
    for (const char *const *name = names; *name; name++) {
        const struct bulla_viscosity *law = support_module("viscosity", *name)->table;
        struct contract contract = {.module = support_module("viscosity", *name), .strict = true};
        assert_int_equal(contract_module_run(&contract, NULL), 0);
        support_holds(&contract);
        assert_int_equal(contract.n_row, 12);
        assert_int_equal(contract.n_cost, law->zeta ? 2 : 1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_values), cmocka_unit_test(test_contract)};
    return cmocka_run_group_tests(tests, support_start, support_stop);
}
