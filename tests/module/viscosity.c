/* viscosity.c - the contract of kind "viscosity" (core/suite/contract_viscosity.c, contract_coefficient.c) on every
 * built-in law, each law against its published formula, and faults that the contract must find. */
#include "mutants.h"

#include "bulla/viscosity.h"

static const char *const names[] = {"carreau",    "casson", "cross", "herschel-bulkley", "newtonian", "power",
                                    "sutherland", "vogel",  NULL};

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

/* The textbook's formulas, with the numbers of the presets. */
static double textbook(const char *name, double rate, double T)
{
    if (!strcmp(name, "carreau")) return 0.00345 + 0.05255 * pow(1.0 + pow(3.313 * rate, 2.0), (0.3568 - 1.0) / 2.0);
    if (!strcmp(name, "cross")) return 0.00345 + 0.05255 / (1.0 + pow(1.007 * rate, 1.028));
    if (!strcmp(name, "power")) return fmin(fmax(0.017 * pow(rate, -0.292), 0.00345), 0.056);
    if (!strcmp(name, "casson")) return pow(sqrt(5e-3 / rate) * (1.0 - exp(-sqrt(100.0 * rate))) + sqrt(3.5e-3), 2.0);
    if (!strcmp(name, "herschel-bulkley")) return 30.0 / rate * (1.0 - exp(-0.1 * rate)) + 8.0 / sqrt(fmax(rate, 10.0));
    if (!strcmp(name, "sutherland")) return 1.716e-5 * pow(T / 273.15, 1.5) * (273.15 + 110.4) / (T + 110.4);
    if (!strcmp(name, "vogel")) return 2.414e-5 * pow(10.0, 247.8 / (T - 140.0));
    return 0.890e-3;
}

static void test_textbook(void **state)
{
    (void)state;
    for (const char *const *name = names; *name; name++) {
        const struct bulla_module *module = support_module("viscosity", *name);
        struct instance instance = support_open_preset(module, module->presets->name);
        for (double rate = 1e-3; rate < 1e6; rate *= 3.0) {
            double T = 275.0 + 20.0 * log10(rate * 1e4), want = textbook(*name, rate, T);
            support_near(*name, mu_at(module, instance.self, rate, T), want, 1e-9, want);
        }
        instance_done(&instance);
    }
}

/* What is known beyond formulas: water and air at 20 and 25 C (2.5 and 2 %), rest, bulk viscosities. */
static void test_values(void **state)
{
    (void)state;
    const struct bulla_module *newtonian = support_module("viscosity", "newtonian");
    const struct bulla_module *vogel = support_module("viscosity", "vogel");
    const struct bulla_module *sutherland = support_module("viscosity", "sutherland");
    const struct bulla_module *gel = support_module("viscosity", "herschel-bulkley");
    struct instance water = support_open_preset(newtonian, "water"), warm = support_open_preset(vogel, "water");
    struct instance air = support_open_preset(sutherland, "air"), soft = support_open_preset(gel, "gel");
    assert_true(mu_at(newtonian, water.self, 1.0, 300.0) == 0.890e-3 &&
                zeta_at(newtonian, water.self, 300.0) == 2.492e-3);
    support_near("water", mu_at(vogel, warm.self, 0.0, 293.15), 1.0016e-3, 0.025, 1.0016e-3);
    support_near("zeta", zeta_at(vogel, warm.self, 298.15), 2.8 * mu_at(vogel, warm.self, 0.0, 298.15), 1e-12, 1.0);
    assert_true(isfinite(mu_at(vogel, warm.self, 0.0, 100.0)));
    support_near("air", mu_at(sutherland, air.self, 0.0, 298.15), 18.5e-6, 0.02, 18.5e-6);
    support_near("rest", mu_at(gel, soft.self, 0.0, 300.0), 0.1 * 30.0 + 8.0 * sqrt(0.1), 1e-12, 5.0);
    instance_done(&warm);
    instance_done(&air);
    instance_done(&soft);
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

/* Faults that the contract is there for. */
static const struct bulla_viscosity *good;

static void negative(const void *self, size_t n, IN rate, IN T, IN p, IN rho, OUT mu)
{
    good->mu.value(self, n, rate, T, p, rho, mu);
    for (size_t i = 0; i < n; i++) mu[i] -= 1.01 * 0.00345;
}

static void repaired(const void *self, size_t n, IN rate, IN T, IN p, IN rho, OUT mu)
{
    good->mu.value(self, n, rate, T, p, rho, mu);
    for (size_t i = 0; i < n; i++) mu[i] = isfinite(mu[i]) ? mu[i] : 0.0;
}

static double less(const void *self)
{
    return 0.9 * good->mu.most(self);
}

static void test_faults(void **state)
{
    (void)state;
    good = support_module("viscosity", "carreau")->table;
    struct bulla_viscosity bad = *good;
    bad.mu.value = negative;
    finds("viscosity", "carreau", &bad, "finite and not negative");
    bad.mu.value = repaired;
    finds("viscosity", "carreau", &bad, "NaN does not become a good value");
    bad = *good;
    bad.mu.most = less;
    finds("viscosity", "carreau", &bad, "a law that looks at the rate says the most");
    bad = *good;
    bad.mu.needs |= 64;
    finds("viscosity", "carreau", &bad, "`needs` names rows that there are");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_textbook), cmocka_unit_test(test_values),
                                       cmocka_unit_test(test_contract), cmocka_unit_test(test_faults)};
    return cmocka_run_group_tests(tests, support_start, support_stop);
}
