/* eos.c - the contract of kind "eos" (core/app/contract_eos.c) on every built-in law and on the plugin of
 * tests/plugin, far into their continuations, and the closed-form family against reference points
 * computed with 50 digits (tests/data/eos). */
#include "support.h"

#include "app/contract_eos.h"
#include "app/contract_module.h"
#include "bulla/eos.h"

enum { LAWS = 32 };

/* A law with its parameters, and the densities and pressures to test it at. */
struct law {
    const char *module, *preset;
    struct instance instance;
    const struct bulla_eos *eos;
    double rho[2], p_least, p_most; /* p_least: -INFINITY, or where its temperature ends */
};

static struct law laws[LAWS];
static size_t n_law;

static struct law *add_law(const char *module, const char *preset, double rho_low, double rho_high, double p_most)
{
    struct law *law = &laws[n_law++];
    *law = (struct law){
        .module = module, .preset = preset, .rho = {rho_low, rho_high}, .p_least = -INFINITY, .p_most = p_most};
    law->instance = support_open_preset(support_module("eos", module), preset);
    law->eos = law->instance.module->table;
    return law;
}

/* Every preset of every built-in law; liquids up to twice the density where the co-volume ends. */
static int start(void **state)
{
    if (support_start(state)) return 1;
    for (const char *const *name = (const char *const[]){"air", "air-r287", "helium", NULL}; *name; name++)
        add_law("ideal-gas", *name, 1e-3, 1000.0, 1e10);
    static const char *const waters[] = {"sg44", "sg4", "sg659", "sg659b", "sg3", "sg235", NULL};
    for (const char *const *name = waters; *name; name++) add_law("stiffened-gas", *name, 1.0, 3000.0, 1e11);
    add_law("nasg", "water", 1.0, 2800.0, 1e11);
    add_law("mnasg", "water", 1.0, 2800.0, 1e11);
    char path[4096];
    snprintf(path, sizeof path, "%s/tests/plugin/eos-tait-murnaghan.so", getenv("BULLA_BUILD"));
    if (registry_load(path)) return 1;
    add_law("tait-murnaghan", "water", 960.0, 1010.0, 1e9)->p_least = 3e7;
    return 0;
}

static int stop(void **state)
{
    for (size_t i = 0; i < n_law; i++) instance_done(&laws[i].instance);
    return support_stop(state);
}

struct point {
    double rho_e, stiffness, c2, de_dp, de_drho, T, s, p_min;
};

/* All functions at one point, each as a batch of one. */
static struct point at(const struct law *law, double rho, double p)
{
    struct point point;
    const void *self = law->instance.self;
    law->eos->state(self, 1, &rho, &p, &point.rho_e, &point.stiffness);
    point.c2 = point.stiffness / rho;
    law->eos->derivatives(self, 1, &rho, &p, &point.de_dp, &point.de_drho);
    law->eos->temperature(self, 1, &rho, &p, &point.T);
    law->eos->entropy(self, 1, &rho, &p, &point.s);
    law->eos->p_min(self, 1, &rho, &point.p_min);
    return point;
}

struct reference {
    const char *set, *module;
    double numbers[5];
};

/* Parameters of the sets in the file, in the order of the modules' tables. */
static const struct reference references[] = {
    {"ideal_air", "ideal-gas", {1.4, 717.5}},
    {"sg_water_g4.4", "stiffened-gas", {4.4, 6e8, 1000.0, 0.0}},
    {"sg_water_g4", "stiffened-gas", {4.0, 6e8, 1000.0, 0.0}},
    {"sg_water_g3", "stiffened-gas", {3.0, 8.533e8, 1395.0, -1148000.0}},
    {"sg_water_g2.35", "stiffened-gas", {2.35, 1e9, 1816.0, -1167000.0}},
    {"sg_water_g6.59", "stiffened-gas", {6.59, 4.10264925e8, 1000.0, 0.0}},
    {"nasg_water", "nasg", {1.19, 7028e5, 6.61e-4, -1177788.0, 3610.0}},
    {"mnasg_water", "mnasg", {1.19, 6217.8e5, 6.7212e-4, -1177788.0, 3610.0}},
};

static void check_reference(const struct reference *reference, const double *column)
{
    double rho = column[0], p = column[1], e = column[2], T = column[3], c2 = column[4], s = column[6];
    double e_p = column[9], e_rho = column[10];
    struct law law = {.instance = support_open(support_module("eos", reference->module), reference->numbers)};
    law.eos = law.instance.module->table;
    struct point point = at(&law, rho, p);
    double cv = reference->numbers[strcmp(reference->module, "ideal-gas") == 0       ? 1
                                   : strcmp(reference->module, "stiffened-gas") == 0 ? 2
                                                                                     : 4];
    double size = fabs(e) + fabs(p) / rho; /* e may cancel against its zero */
    support_near("e", point.rho_e / rho, e, 1e-12, size);
    support_near("c2", point.c2, c2, 1e-12, fabs(c2));
    support_near("T", point.T, T, 1e-12, fabs(T));
    support_near("s", point.s, s, 1e-12, fabs(s) + cv);
    support_near("de_dp", point.de_dp, rho * e_p, 1e-12, fabs(rho * e_p));
    support_near("de_drho", point.de_drho, e + rho * e_rho, 1e-12, fabs(e) + fabs(rho * e_rho));
    double back;
    law.eos->density(law.instance.self, 1, &p, &T, &back);
    support_near("rho(p, T)", back, rho, 1e-11, rho);
    instance_done(&law.instance);
}

static void test_reference_points(void **state)
{
    (void)state;
    FILE *file = fopen("tests/data/eos/nasg_family_points.csv", "r");
    assert_non_null(file);
    char line[1024];
    int count = 0;
    while (fgets(line, sizeof line, file)) {
        if (line[0] == '#') continue;
        char *comma = strchr(line, ',');
        *comma = '\0';
        double column[11];
        for (int i = 0; i < 11; i++) column[i] = strtod(comma + 1, &comma);
        for (size_t i = 0; i < sizeof references / sizeof *references; i++) {
            if (strcmp(references[i].set, line) != 0) continue;
            check_reference(&references[i], column);
            count++;
        }
    }
    fclose(file);
    assert_int_equal(count, 150);
}

/* In the box of `start`: beyond what the laws state, where nothing is known about them but must hold all the same. */
static void test_contract(void **state)
{
    (void)state;
    for (size_t i = 0; i < n_law; i++) {
        const struct law *law = &laws[i];
        struct contract contract = {.module = law->instance.module, .self = law->instance.self, .preset = law->preset};
        struct contract_eos_box box = {{law->rho[0], law->rho[1]}, law->p_least, law->p_most, {0.0, INFINITY}};
        contract.strict = true;
        contract_eos_run_in(&contract, &box);
        support_holds(&contract);
        assert_true(contract.n_row == 19 && contract.n_cost == 7);
    }
}

/* In the range that each law states, with its defaults and presets, as `bulla module check` does. */
static void test_contract_as_stated(void **state)
{
    (void)state;
    for (size_t i = 0; i < n_law; i++) {
        if (i && laws[i].instance.module == laws[i - 1].instance.module) continue;
        struct contract contract = {.module = laws[i].instance.module};
        assert_int_equal(contract_module_run(&contract, NULL), 0);
        support_holds(&contract);
        assert_int_equal(contract.n_row, 22);
    }
}

/* Where the continuation of the co-volume begins, values and their first derivatives meet. */
static void test_edge_is_smooth(void **state)
{
    (void)state;
    for (size_t i = 0; i < n_law; i++) {
        if (!strstr(laws[i].module, "nasg")) continue;
        double edge = 0.98 / laws[i].instance.values[2].number, h = 1e-9 * edge;
        for (double p = 1e5; p < 1e11; p *= 100.0) {
            struct point below = at(&laws[i], edge - h, p), above = at(&laws[i], edge + h, p);
            support_near("rho_e", above.rho_e, below.rho_e, 1e-6, fabs(below.rho_e));
            support_near("c2", above.c2, below.c2, 1e-5, below.c2);
            support_near("T", above.T, below.T, 1e-6, below.T);
            support_near("s", above.s, below.s, 1e-6, fabs(below.s) + 3610.0);
            support_near("de_drho", above.de_drho, below.de_drho, 1e-6, fabs(below.de_drho) + below.c2 * below.de_dp);
        }
    }
}

/* What the named presets are known for. */
static void test_presets(void **state)
{
    (void)state;
    double p = 1e5, T = 300.0, rho;
    for (size_t i = 0; i < n_law; i++) {
        const struct law *law = &laws[i];
        law->eos->density(law->instance.self, 1, &p, &T, &rho);
        double c = sqrt(at(law, rho, p).c2);
        if (strcmp(law->module, "nasg") == 0) {
            support_near("NASG density", rho, 1048.5, 1.0, 0.05);
            support_near("NASG sound speed", c, 1612.2, 1.0, 0.05);
        }
        if (strcmp(law->module, "mnasg") == 0) {
            support_near("MNASG density", rho, 997.0, 1.0, 0.05);
            support_near("MNASG sound speed", c, 1500.0, 1.0, 0.05);
        }
        if (strcmp(law->module, "stiffened-gas") == 0 && strchr("46", law->preset[2]))
            support_near("mechanical water at 300 K", rho, 998.2, 1e-6, 998.2);
        if (strcmp(law->module, "ideal-gas") == 0 && strcmp(law->preset, "air-r287") == 0)
            support_near("air", rho, 1e5 / (287.05 * 300.0), 1e-12, rho);
    }
}

/* Water at 288.15 K compressed isentropically to 10 GPa by the set sg3: 1282 K hotter. */
static void test_sg3_heats(void **state)
{
    (void)state;
    struct law *law = laws;
    while (strcmp(law->preset, "sg3") != 0) law++;
    double p = 1e5, T = 288.15, rho;
    law->eos->density(law->instance.self, 1, &p, &T, &rho);
    double s = at(law, rho, p).s, low = rho, high = 10.0 * rho;
    for (int i = 0; i < 200; i++) { /* entropy falls with density at constant pressure */
        double mean = 0.5 * (low + high);
        if (at(law, mean, 1e10).s > s) low = mean;
        else high = mean;
    }
    support_near("temperature rise", at(law, low, 1e10).T - 288.15, 1281.82, 1.0, 0.01);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_reference_points),
        cmocka_unit_test(test_contract),
        cmocka_unit_test(test_contract_as_stated),
        cmocka_unit_test(test_edge_is_smooth),
        cmocka_unit_test(test_presets),
        cmocka_unit_test(test_sg3_heats),
    };
    return cmocka_run_group_tests(tests, start, stop);
}
