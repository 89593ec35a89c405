/* inelastic.c - the contract of kind "inelastic" (core/suite/contract_inelastic.c) on every built-in strength, and each
 * against its published formula. */
#include "support.h"

#include "base/status.h"
#include "bulla/inelastic.h"
#include "suite/contract_module.h"

enum { INPUTS = 5 };

static double strength(const char *name, const double *values, const double at[static INPUTS], uint32_t *ret_needs)
{
    const struct bulla_module *module = support_module("inelastic", name);
    const struct bulla_inelastic *law = module->table;
    struct instance instance = support_open(module, values);
    double Y;
    law->strength(instance.self, 1, &at[0], &at[1], &at[2], &at[3], &at[4], &Y);
    *ret_needs = law->needs(instance.self);
    instance_done(&instance);
    return Y;
}

static void check(const char *name, const double *values, const double at[static INPUTS], double want, uint32_t needs)
{
    uint32_t asked;
    double Y = strength(name, values, at, &asked);
    support_near(name, Y, want, 1e-14, fabs(want) + 1.0);
    assert_int_equal(asked, needs);
}

/* eps, rate, p, T, rho. */
static const double young[] = {0.0, 0.0, 1e5, 300.0, 8930.0}, aged[] = {0.16, 1e4, 2e9, 700.0, 9500.0};
static const double molten[] = {0.16, 1e4, 2e9, 2500.0, 8930.0};

static void test_von_mises(void **state)
{
    (void)state;
    check("von-mises", (const double[]){3e8, 0.0, 1.0, 0.0}, aged, 3e8, 0);
    check("von-mises", (const double[]){3e8, 5e8, 1.0, 0.0}, aged, 3.8e8, BULLA_INELASTIC_STRAIN);
    check("von-mises", (const double[]){3e8, 5e8, 0.5, 0.0}, aged, 5e8, BULLA_INELASTIC_STRAIN);
    check("von-mises", (const double[]){3e8, 5e8, 0.5, 0.0}, young, 3e8, BULLA_INELASTIC_STRAIN);
}

static void test_power_law(void **state)
{
    (void)state;
    check("power-law", (const double[]){3e8, 5e8, 1e6, 0.5}, aged, 3.8e8 * 1.1,
          BULLA_INELASTIC_RATE | BULLA_INELASTIC_STRAIN);
    check("power-law", (const double[]){3e8, 0.0, 1e6, 0.5}, young, 3e8, BULLA_INELASTIC_RATE);
}

static void test_johnson_cook(void **state)
{
    (void)state;
    const double copper[] = {90e6, 292e6, 0.31, 0.025, 1.0, 1.09, 1356.0, 298.0};
    const double cold[] = {90e6, 292e6, 0.31, 0.025, 1.0, 1.09, 0.0, 298.0};
    double hard = 90e6 + 292e6 * pow(0.16, 0.31), fast = 1.0 + 0.025 * log1p(1e4);
    double soft = 1.0 - pow((700.0 - 298.0) / (1356.0 - 298.0), 1.09);
    uint32_t needs = BULLA_INELASTIC_STRAIN | BULLA_INELASTIC_RATE;
    check("johnson-cook", copper, aged, hard * fast * soft, needs | BULLA_INELASTIC_TEMPERATURE);
    check("johnson-cook", copper, molten, 0.0, needs | BULLA_INELASTIC_TEMPERATURE);
    check("johnson-cook", cold, aged, hard * fast, needs);
}

static void test_steinberg_guinan(void **state)
{
    (void)state;
    const double copper[] = {0.12e9, 0.64e9, 36.0, 0.45, 0.0, 8930.0, 0.0283e-9, 3.77e-4, 1790.0, 1.5, 2.02};
    double hard = 0.12e9 * pow(1.0 + 36.0 * 0.16, 0.45), eta = 9500.0 / 8930.0;
    double factor = 1.0 + 0.0283e-9 * 2e9 / cbrt(eta) - 3.77e-4 * 400.0;
    uint32_t needs = BULLA_INELASTIC_STRAIN | BULLA_INELASTIC_PRESSURE | BULLA_INELASTIC_TEMPERATURE;
    check("steinberg-guinan", copper, aged, hard * factor, needs);
    check("steinberg-guinan", copper, molten, 0.0, needs);
    /* Compressed to twice its density copper melts later: 1790 exp(1.5) 2^0.3733. */
    const double dense[] = {50.0, 0.0, 0.0, 2500.0, 17860.0};
    check("steinberg-guinan", copper, dense, 0.64e9 * (1.0 - 3.77e-4 * 2200.0), needs);
}

static void test_contract(void **state)
{
    (void)state;
    static const char *const perfect[] = {"yield=300 MPa", NULL};
    static const char *const hardens[] = {"yield=300 MPa", "hardening=500 MPa", "exponent=0.3", NULL};
    static const char *const viscous[] = {"yield=300 MPa", "hardening=1 MPa", "reference-rate=1e5", "sensitivity=0.1",
                                          NULL};
    static const struct {
        const char *name;
        const char *const *sets;
    } laws[] = {{"johnson-cook", NULL},
                {"power-law", viscous},
                {"steinberg-guinan", NULL},
                {"von-mises", perfect},
                {"von-mises", hardens}};
    for (size_t l = 0; l < sizeof laws / sizeof *laws; l++) {
        struct contract contract = {.module = support_module("inelastic", laws[l].name), .strict = true};
        if (contract_module_run(&contract, laws[l].sets)) fail_msg("%s: %s", laws[l].name, status_text());
        support_holds(&contract);
        assert_int_equal(contract.n_cost, 1);
        assert_int_equal(contract.n_fact, 2);
        for (unsigned i = 0; i < contract.n_row; i++)
            assert_true(contract.rows[i].points > 0 || strstr(contract.rows[i].check, "NaN"));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_von_mises), cmocka_unit_test(test_power_law),
                                       cmocka_unit_test(test_johnson_cook), cmocka_unit_test(test_steinberg_guinan),
                                       cmocka_unit_test(test_contract)};
    return cmocka_run_group_tests(tests, support_start, support_stop);
}
