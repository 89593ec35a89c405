/* constitutive.c - the contract of kind "constitutive" (core/suite/contract_constitutive.c) on every built-in law, and
 * each against its published formula. */
#include "support.h"

#include "bulla/constitutive.h"
#include "suite/contract_module.h"

enum { STRETCHES = 4000 };

static const char *const names[] = {"fung", "gent", "mooney-rivlin", "neo-hookean", "quadratic", NULL};

/* mu, rho0 and the number of the law itself. */
static const double numbers[] = {8.5e4, 1060.0, 0.3};
#define RATIO 0.3

struct point {
    double e, e_1, e_2, e_11;
};

/* With the C library's functions, in long double: where a continuation rules, as its header says. */
static struct point textbook(const char *name, double I1, double I2, double own)
{
    long double k = numbers[0] / (2.0L * numbers[1]), J = I1 - 3.0L, c = own;
    if (strcmp(name, "neo-hookean") == 0) return (struct point){(double)(k * J), (double)k, 0.0, 0.0};
    if (strcmp(name, "mooney-rivlin") == 0)
        return (struct point){(double)(k * ((1.0L - c) * J + c * (I2 - 3.0L))), (double)(k * (1.0L - c)),
                              (double)(k * c), 0.0};
    if (strcmp(name, "quadratic") == 0) {
        long double least = c > 0.0L ? -0.5L / c : -2.0L, x = fmaxl(J, least), slope = k * (1.0L + c * x);
        return (struct point){(double)(k * (x + c * x * x / 2.0L) + slope * (J - x)), (double)slope, 0.0,
                              J < least ? 0.0 : (double)(k * c)};
    }
    bool fung = strcmp(name, "fung") == 0;
    long double edge = fung ? 12.0L / c : 0.95L * c, x = J < edge ? J : edge, d = J - x;
    long double grown = expm1l(c * x), left = 1.0L / (1.0L - x / c);
    long double e = fung ? k / c * grown : -k * c * log1pl(-x / c);
    long double e_1 = k * (fung ? grown + 1.0L : left), e_11 = fung ? c * e_1 : k / c * left * left;
    return (struct point){(double)(e + d * e_1 + d * d / 2.0L * e_11), (double)(e_1 + d * e_11), 0.0, (double)e_11};
}

static void compare(const char *name, double own, double I1, double I2)
{
    const struct bulla_module *module = support_module("constitutive", name);
    const struct bulla_constitutive *law = module->table;
    const double values[] = {numbers[0], numbers[1], own};
    struct instance instance = support_open(module, values);
    struct point want = textbook(name, I1, I2, own), got;
    double unused[2];
    law->energy(instance.self, 1, &I1, &I2, &got.e, &got.e_1, &got.e_2);
    support_near(name, got.e, want.e, 1e-13, fabs(want.e));
    /* Below I1 = 3, where no stretch is, what is left of e_1 may be small beside its value at rest. */
    double least = numbers[0] / numbers[1];
    support_near(name, got.e_1, want.e_1, 1e-13, fmax(want.e_1, least));
    support_near(name, got.e_2, want.e_2, 1e-15, want.e_1 + want.e_2);
    if (law->second) {
        law->second(instance.self, 1, &I1, &I2, &got.e_11, &unused[0], &unused[1]);
        support_near(name, got.e_11, want.e_11, 1e-13, fmax(want.e_11, least * own));
    }
    instance_done(&instance);
}

/* From hardly stretched (where a careless exponential has lost all digits) through the edge of the formulas. */
static void test_textbook(void **state)
{
    (void)state;
    static const double owns[][3] = {
        {1.0, 8.35, 1e-6}, {97.2, 0.5, 1e6}, {0.0, 0.2, 1.0}, {0.0, 0.0, 0.0}, {0.1, 0.0, 1e3}};
    uint64_t seed = 1;
    for (int l = 0; names[l]; l++)
        for (int i = 0; i < STRETCHES; i++) {
            double size = pow(10.0, contract_random(&seed, -12.0, 5.0)), sign = i % 4 == 3 && size < 2.0 ? -1.0 : 1.0;
            compare(names[l], owns[l][i % 3], 3.0 + sign * size, 3.0 + size * contract_random(&seed, 0.1, 2.0));
        }
}

/* Of small strains all are the same solid, whatever stiffens it later: c_s^2 = mu/rho0, from s' = 2 rho (e_1 + e_2) dev
 * B. */
static void test_small_strain(void **state)
{
    (void)state;
    const double rest = 3.0;
    for (int l = 0; names[l]; l++) {
        const struct bulla_module *module = support_module("constitutive", names[l]);
        const struct bulla_constitutive *law = module->table;
        struct instance instance = support_open(module, numbers);
        double e, e_1, e_2;
        law->energy(instance.self, 1, &rest, &rest, &e, &e_1, &e_2);
        support_near(names[l], 2.0 * (e_1 + e_2), numbers[0] / numbers[1], 1e-15, numbers[0] / numbers[1]);
        assert_true(e == 0.0);
        instance_done(&instance);
    }
}

/* The ratio of a Mooney-Rivlin solid is the part of I2. */
static void test_ratio(void **state)
{
    (void)state;
    const struct bulla_module *module = support_module("constitutive", "mooney-rivlin");
    const struct bulla_constitutive *law = module->table;
    struct instance instance = support_open(module, numbers);
    const double I1 = 5.0, I2 = 4.25;
    double e, e_1, e_2;
    law->energy(instance.self, 1, &I1, &I2, &e, &e_1, &e_2);
    support_near("ratio", e_2 / (e_1 + e_2), RATIO, 1e-15, 1.0);
    instance_done(&instance);
}

static void test_contract(void **state)
{
    (void)state;
    for (const char *const *name = names; *name; name++) {
        const struct bulla_constitutive *law = support_module("constitutive", *name)->table;
        struct contract contract = {.module = support_module("constitutive", *name), .strict = true};
        assert_int_equal(contract_module_run(&contract, NULL), 0);
        support_holds(&contract);
        assert_int_equal(contract.n_row, 18);
        assert_int_equal(contract.n_cost, law->second ? 2 : 1);
        assert_true(contract.n_fact == 1 && contract.facts[0].holds);
        struct bulla_constitutive_range range; /* its end is tested where there is one */
        struct instance instance = support_open(contract.module, numbers);
        law->range(instance.self, &range);
        instance_done(&instance);
        for (unsigned i = 0; i < contract.n_row; i++)
            assert_true(contract.rows[i].points > 0 || (i == 1 && isinf(range.I1_max)));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_textbook), cmocka_unit_test(test_small_strain),
                                       cmocka_unit_test(test_ratio), cmocka_unit_test(test_contract)};
    return cmocka_run_group_tests(tests, support_start, support_stop);
}
