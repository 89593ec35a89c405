/* conductivity.c - the contract of kind "conductivity" (core/suite/contract_conductivity.c, contract_coefficient.c) on
 * every built-in law, each law against published values, and values that are refused. */
#include "mutants.h"

#include "bulla/conductivity.h"

static const char *const names[] = {"constant", "powers", "sutherland", NULL};

static double k_at(const char *name, const char *preset, double T)
{
    const struct bulla_module *module = support_module("conductivity", name);
    const struct bulla_conductivity *law = module->table;
    struct instance instance = support_open_preset(module, preset);
    double k;
    law->k.value(instance.self, 1, NULL, law->k.needs & BULLA_NEEDS_TEMPERATURE ? &T : NULL, NULL, NULL, &k);
    instance_done(&instance);
    return k;
}

/* Water: the background term of IAPWS R15-11 at 0.1 MPa, to which the critical enhancement adds up to 1 %. Air: tables
 * of Incropera & DeWitt, Fundamentals of Heat and Mass Transfer, 4th ed., A.4. */
static void test_values(void **state)
{
    (void)state;
    static const double water[][2] = {{273.15, 0.555650}, {298.15, 0.606515}, {333.15, 0.651005}, {372.15, 0.676869}};
    static const double air[][2] = {{250.0, 22.3e-3}, {300.0, 26.3e-3}, {400.0, 33.8e-3}, {1000.0, 66.7e-3}};
    for (int i = 0; i < 4; i++) {
        double ratio = k_at("powers", "water", water[i][0]) / water[i][1];
        assert_true(ratio >= 1.0 && ratio < 1.01);
        assert_true(fabs(k_at("sutherland", "air", air[i][0]) / air[i][1] - 1.0) < 0.02);
    }
    assert_true(k_at("constant", "water", 300.0) == 0.607 && k_at("constant", "air", 300.0) == 0.0262);
    assert_true(fabs(k_at("powers", "water", 300.0) - (0.80201 - 0.25992 + 0.10024 - 0.032005)) < 1e-15);
}

/* Beyond the fit the value at its end. */
static void test_ends(void **state)
{
    (void)state;
    assert_true(k_at("powers", "water", 1e5) == k_at("powers", "water", 383.15));
    assert_true(k_at("powers", "water", 1.0) == k_at("powers", "water", 253.15));
}

static void test_contract(void **state)
{
    (void)state;
    for (const char *const *name = names; *name; name++) {
        struct contract contract = {.module = support_module("conductivity", *name), .strict = true};
        assert_int_equal(contract_module_run(&contract, NULL), 0);
        support_holds(&contract);
        assert_int_equal(contract.n_cost, 1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_values), cmocka_unit_test(test_ends),
                                       cmocka_unit_test(test_contract)};
    return cmocka_run_group_tests(tests, support_start, support_stop);
}
