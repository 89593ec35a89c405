/* mutants_solid.c - as mutants.c, for what solids are made of: elastic laws, and Riemann solvers that know shear. */
#include "mutants.h"

#include "bulla/constitutive.h"
#include "bulla/riemann.h"

static const struct bulla_constitutive *fung, *mooney;
static const struct bulla_riemann *hlld;

static int start(void **state)
{
    if (support_start(state)) return 1;
    fung = support_module("constitutive", "fung")->table;
    mooney = support_module("constitutive", "mooney-rivlin")->table;
    hlld = support_module("riemann", "hlld")->table;
    return 0;
}

/* Elastic laws: one with a continuation and second derivatives, one of both invariants. */

static void lifted(const void *self, size_t n, IN I1, IN I2, OUT e, OUT e_1, OUT e_2)
{
    fung->energy(self, n, I1, I2, e, e_1, e_2);
    for (size_t i = 0; i < n; i++) e[i] += 1e-9;
}

static void tilted(const void *self, size_t n, IN I1, IN I2, OUT e, OUT e_1, OUT e_2)
{
    fung->energy(self, n, I1, I2, e, e_1, e_2);
    for (size_t i = 0; i < n; i++) e_1[i] *= 1.0 + 1e-5;
}

static void crossed(const void *self, size_t n, IN I1, IN I2, OUT e, OUT e_1, OUT e_2)
{
    mooney->energy(self, n, I1, I2, e, e_1, e_2);
    for (size_t i = 0; i < n; i++) e_2[i] = e_1[i];
}

static void bowed(const void *self, size_t n, IN I1, IN I2, OUT e, OUT e_1, OUT e_2)
{
    mooney->energy(self, n, I1, I2, e, e_1, e_2);
    for (size_t i = 0; i < n; i++) {
        e[i] += 1e-3 * (I1[i] - 3.0) * (I1[i] - 3.0);
        e_1[i] += 2e-3 * (I1[i] - 3.0);
    }
}

static void softened(const void *self, size_t n, IN I1, IN I2, OUT e, OUT e_1, OUT e_2)
{
    mooney->energy(self, n, I1, I2, e, e_1, e_2);
    for (size_t i = 0; i < n; i++) {
        double J = I1[i] - 3.0, k = 0.5 * (e_1[i] + e_2[i]);
        e[i] -= k * J * J / (J + 1e2);
        e_1[i] -= k * (J * J + 2e2 * J) / ((J + 1e2) * (J + 1e2)) + 1.2 * k * (J > 1e3);
    }
}

static void sunk(const void *self, size_t n, IN I1, IN I2, OUT e, OUT e_1, OUT e_2)
{
    mooney->energy(self, n, I1, I2, e, e_1, e_2);
    for (size_t i = 0; i < n; i++) {
        double k = 1.1 * e_2[i];
        e[i] -=
            k * (I2[i] - 3.0); /* e_2 < 0, e_1 + e_2 still above 0: equal stretch in two directions gives energy back */
        e_2[i] -= k;
    }
}

static void burst(const void *self, size_t n, IN I1, IN I2, OUT e, OUT e_1, OUT e_2)
{
    fung->energy(self, n, I1, I2, e, e_1, e_2);
    for (size_t i = 0; i < n; i++)
        if (I1[i] > 1e5) e[i] = (double)INFINITY;
}

static void jumping(const void *self, size_t n, IN I1, IN I2, OUT e, OUT e_1, OUT e_2)
{
    struct bulla_constitutive_range range;
    fung->range(self, &range);
    fung->energy(self, n, I1, I2, e, e_1, e_2);
    for (size_t i = 0; i < n; i++)
        if (I1[i] > range.I1_max) e_1[i] *= 1.01;
}

static void patched(const void *self, size_t n, IN I1, IN I2, OUT e, OUT e_1, OUT e_2)
{
    fung->energy(self, n, I1, I2, e, e_1, e_2);
    for (size_t i = 0; i < n; i++)
        if (!isfinite(e[i])) e[i] = 0.0;
}

static void straying(const void *self, size_t n, IN I1, IN I2, OUT e, OUT e_1, OUT e_2)
{
    fung->energy(self, n, I1, I2, e, e_1, e_2);
    if (n > 8) e[8] *= 1.0 + 0x1p-52;
}

static void curved(const void *self, size_t n, IN I1, IN I2, OUT e_11, OUT e_12, OUT e_22)
{
    fung->second(self, n, I1, I2, e_11, e_12, e_22);
    for (size_t i = 0; i < n; i++) e_11[i] *= 1.001;
}

static void mixed(const void *self, size_t n, IN I1, IN I2, OUT e_11, OUT e_12, OUT e_22)
{
    fung->second(self, n, I1, I2, e_11, e_12, e_22);
    for (size_t i = 0; i < n; i++) e_12[i] = e_11[i];
}

static void narrow(const void *self, struct bulla_constitutive_range *ret_range)
{
    fung->range(self, ret_range);
    ret_range->I1_max = 3.0;
}

static void test_constitutive(void **state)
{
    (void)state;
    const struct {
        const char *law, *check;
        struct bulla_constitutive wrong;
        bool only; /* says wrongly that I2 does not matter, or that there are no second derivatives */
    } mutants[] = {
        {"fung", "no energy in", {.energy = lifted}, false},
        {"fung", "e_1 is the slope", {.energy = tilted}, false},
        {"mooney-rivlin", "e_2 is the slope", {.energy = crossed}, false},
        {"mooney-rivlin", "second derivatives", {.energy = bowed}, false},
        {"fung", "second derivatives", {.second = curved}, false},
        {"fung", "second derivatives", {.second = NULL}, true},
        {"mooney-rivlin", "first_only", {.energy = NULL}, true},
        {"fung", "first_only", {.second = mixed}, false},
        {"mooney-rivlin", "e_1 + e_2 > 0", {.energy = softened}, false},
        {"mooney-rivlin", "energy grows", {.energy = sunk}, false},
        {"fung", "finite", {.energy = burst}, false},
        {"fung", "energy and stress are continuous", {.energy = jumping}, false},
        {"fung", "NaN does not", {.energy = patched}, false},
        {"fung", "a row gives", {.energy = straying}, false},
        {"fung", "the stated range", {.range = narrow}, false},
    };
    for (size_t i = 0; i < sizeof mutants / sizeof *mutants; i++) {
        bool is_fung = strcmp(mutants[i].law, "fung") == 0;
        struct bulla_constitutive table = is_fung ? *fung : *mooney;
        if (mutants[i].wrong.energy) table.energy = mutants[i].wrong.energy;
        if (mutants[i].wrong.second) table.second = mutants[i].wrong.second;
        if (mutants[i].wrong.range) table.range = mutants[i].wrong.range;
        if (mutants[i].only) table.second = NULL;
        if (mutants[i].only) table.first_only = 1;
        finds("constitutive", mutants[i].law, &table, mutants[i].check);
    }
}

/* Riemann solvers with solids. */

static enum stray { STICK, WELD, TEAR, HEAT, DRAG, BOTH } stray;

static void strayed(const void *self, const struct bulla_faces *faces)
{
    const struct bulla_flux *flux = &faces->flux;
    hlld->solve(self, faces);
    if (!faces->solid || faces->n_velocity < 2) return;
    for (size_t i = 0; i < faces->n; i++) {
        double c_l = faces->shear_left.c_s[i], c_r = faces->shear_right.c_s[i];
        double du = faces->right.u[1][i] - faces->left.u[1][i], rho = faces->left.rho[i];
        bool solids = c_l > 0.0 && c_r > 0.0, fluids = !(c_l > 0.0) && !(c_r > 0.0);
        if (stray == STICK && !solids && !fluids) flux->momentum[1][i] -= 1e-3 * rho * faces->left.c[i] * du;
        if (stray == WELD && solids) flux->momentum[1][i] += 0.3 * rho * c_l * du; /* less than the shear wave's */
        if (stray == TEAR && solids) faces->slide_right[0][i] = faces->right.u[1][i];
        if (stray == HEAT && solids) flux->rho_E[i] -= 1e-3 * rho * c_l * du * faces->left.u[1][i];
        if (stray == DRAG && !solids && !fluids) faces->slide_left[0][i] = faces->slide_right[0][i];
        if (stray == BOTH && fluids) flux->rho_E[i] *= 1.0 + 0x1p-52;
    }
}

static void test_solids(void **state)
{
    (void)state;
    static const struct bulla_riemann table = {.size = sizeof table, .solve = strayed, .solids = 1};
    static const struct {
        enum stray stray;
        const char *check;
    } mutants[] = {{STICK, "a fluid slips"},     {WELD, "welded solids"}, {TEAR, "welded solids"},
                   {TEAR, "sharp shear waves"},  {HEAT, "sharp shear"},   {DRAG, "a fluid slips"},
                   {BOTH, "two fluids: as in a"}};
    for (size_t i = 0; i < sizeof mutants / sizeof *mutants; i++) {
        stray = mutants[i].stray;
        finds("riemann", "hlld", &table, mutants[i].check);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_constitutive), cmocka_unit_test(test_solids)};
    return cmocka_run_group_tests(tests, start, support_stop);
}
