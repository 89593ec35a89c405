/* damage.c - the contract of kind "damage" (core/suite/contract_damage.c) on every built-in criterion, and each against
 * its published formula. */
#include "support.h"

#include "base/status.h"
#include "bulla/damage.h"
#include "suite/contract_module.h"

enum { INPUTS = 9 };

static void ask(const char *name, const double *values, const double at[static INPUTS], uint32_t needs, double aim,
                double rate)
{
    const struct bulla_module *module = support_module("damage", name);
    const struct bulla_damage *law = module->table;
    struct instance instance = support_open(module, values);
    const struct bulla_damage_state state = {sizeof state, &at[0], &at[1], &at[2], &at[3],
                                             &at[4],       &at[5], &at[6], &at[7], &at[8]};
    double to, pace;
    law->grow(instance.self, 1, &state, &to, &pace);
    assert_int_equal(law->needs(instance.self), needs);
    instance_done(&instance);
    support_near(name, to, aim, 1e-14, 1.0);
    support_near(name, pace, rate, 1e-13, rate);
}

/* D, tension, largest stress, largest stretch, energy, equivalent stress, plastic strain, its rate, T. */
static const double pulled[] = {0.2, 1.2e9, 1.5e9, 1.6, 2e5, 4e8, 0.3, 1e4, 700.0};
static const double pressed[] = {0.0, -2e9, -1.9e9, 1.01, 1e3, 2e8, 0.1, 1e4, 300.0};

static void test_tension(void **state)
{
    (void)state;
    const double once = BULLA_DAMAGE_AT_ONCE;
    struct instance principal = {0};
    ask("tension", (const double[]){1.2e9, 0.0}, pulled, BULLA_DAMAGE_TENSION, 1.0, once);
    ask("tension", (const double[]){1.3e9, 0.0}, pulled, BULLA_DAMAGE_TENSION, 0.0, once);
    ask("tension", (const double[]){1e6, 0.0}, pressed, BULLA_DAMAGE_TENSION, 0.0, once);
    const struct bulla_module *module = support_module("damage", "tension");
    const struct bulla_value values[] = {{.number = 1.3e9}, {.text = "principal"}};
    if (instance_open(module, values, &principal)) fail_msg("%s", status_text());
    assert_int_equal(((const struct bulla_damage *)module->table)->needs(principal.self), BULLA_DAMAGE_PRINCIPAL);
    instance_done(&principal);
}

static void test_ramps(void **state)
{
    (void)state;
    const double once = BULLA_DAMAGE_AT_ONCE;
    ask("stretch", (const double[]){1.46, 1.9}, pulled, BULLA_DAMAGE_STRETCH, 0.14 / 0.44, once);
    ask("stretch", (const double[]){1.46, 0.0}, pulled, BULLA_DAMAGE_STRETCH, 1.0, once);
    ask("stretch", (const double[]){1.46, 1.9}, pressed, BULLA_DAMAGE_STRETCH, 0.0, once);
    ask("strain", (const double[]){0.1, 0.5}, pulled, BULLA_DAMAGE_STRAIN, 0.5, once);
    ask("energy", (const double[]){1e5, 9e5}, pulled, BULLA_DAMAGE_ENERGY, 0.125, once);
    struct bulla_value wrong[] = {{.number = 1.9}, {.number = 1.5}};
    struct instance instance = {0};
    assert_true(instance_open(support_module("damage", "stretch"), wrong, &instance));
}

static void test_tuler_butcher(void **state)
{
    (void)state;
    ask("tuler-butcher", (const double[]){2e8, 5e8, 2.0, 1e-6, 0.0}, pulled, BULLA_DAMAGE_TENSION, 1.0, 4e6);
    ask("tuler-butcher", (const double[]){2e8, 5e8, 3.0, 1e-6, 0.0}, pulled, BULLA_DAMAGE_TENSION, 1.0, 8e6);
    ask("tuler-butcher", (const double[]){2e8, 5e8, 2.0, 1e-6, 0.0}, pressed, BULLA_DAMAGE_TENSION, 1.0, 0.0);
}

static void test_johnson_cook(void **state)
{
    (void)state;
    const double copper[] = {0.54, 4.89, -3.03, 0.014, 1.12, 1.0, 1356.0, 298.0, 0.01};
    const double cold[] = {0.54, 4.89, -3.03, 0.014, 1.12, 1.0, 0.0, 298.0, 0.01};
    const double brittle[] = {-5.0, 4.89, -3.03, 0.0, 0.0, 1.0, 0.0, 298.0, 0.05};
    uint32_t needs = BULLA_DAMAGE_RATE | BULLA_DAMAGE_TENSION | BULLA_DAMAGE_MISES;
    double fast = 1.0 + 0.014 * log1p(1e4), warm = 1.0 + 1.12 * (700.0 - 298.0) / (1356.0 - 298.0);
    double mild[INPUTS];
    memcpy(mild, pulled, sizeof mild);
    mild[1] = 2e8; /* triaxiality 0.5; that of `pulled` is 3, of which 1.5 count */
    ask("johnson-cook", copper, mild, needs | BULLA_DAMAGE_TEMPERATURE, 1.0,
        1e4 / ((0.54 + 4.89 * exp(-3.03 * 0.5)) * fast * warm));
    ask("johnson-cook", cold, pulled, needs, 1.0, 1e4 / ((0.54 + 4.89 * exp(-3.03 * 1.5)) * fast));
    ask("johnson-cook", brittle, pulled, needs, 1.0, 1e4 / 0.05);
}

static void test_contract(void **state)
{
    (void)state;
    static const char *const stress[] = {"stress=1 GPa", NULL}, *const principal[] = {"stress=1 GPa", "of=principal",
                                                                                      NULL};
    static const char *const stretch[] = {"begins=1.46", "ends=1.9", NULL};
    static const char *const strain[] = {"begins=0.3", NULL}, *const energy[] = {"begins=1 MJ/m3", "ends=2 MJ/m3",
                                                                                 NULL};
    static const char *const integral[] = {"threshold=100 MPa", "stress=1 GPa", "exponent=2.5", "duration=1 us", NULL};
    static const struct {
        const char *name;
        const char *const *sets;
    } laws[] = {{"tension", stress}, {"tension", principal}, {"stretch", stretch},        {"stretch", NULL},
                {"strain", strain},  {"energy", energy},     {"tuler-butcher", integral}, {"johnson-cook", NULL}};
    for (size_t l = 0; l < sizeof laws / sizeof *laws; l++) {
        struct contract contract = {.module = support_module("damage", laws[l].name), .strict = true};
        if (contract_module_run(&contract, laws[l].sets)) fail_msg("%s: %s", laws[l].name, status_text());
        support_holds(&contract);
        assert_int_equal(contract.n_cost, 1);
        assert_int_equal(contract.n_fact, 2);
        for (unsigned i = 0; i < contract.n_row; i++) assert_true(contract.rows[i].points > 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_tension), cmocka_unit_test(test_ramps),
                                       cmocka_unit_test(test_tuler_butcher), cmocka_unit_test(test_johnson_cook),
                                       cmocka_unit_test(test_contract)};
    return cmocka_run_group_tests(tests, support_start, support_stop);
}
