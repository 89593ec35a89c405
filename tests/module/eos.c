/* eos.c - the contract of kind "eos" on every built-in law and on the plugin of tests/plugin, and the closed-form family against
 * reference points computed with 50 digits (tests/data/eos). */
#include "support.h"

#include "bulla/eos.h"

enum { ROW = 37, LAWS = 32 };

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

/* A random state of the law, in tension too where it can be. */
static void draw(const struct law *law, uint64_t *seed, double *ret_rho, double *ret_p)
{
    double rho = exp(support_random(seed, log(law->rho[0]), log(law->rho[1]))), p_min;
    law->eos->p_min(law->instance.self, 1, &rho, &p_min);
    double above = exp(support_random(seed, log(1e-3 * fabs(p_min) + 100.0), log(law->p_most)));
    *ret_rho = rho;
    *ret_p = fmax(p_min, law->p_least) + above;
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

/* Derivatives, sound speed and entropy follow from rho e by the identities of thermodynamics:
 * c^2 = ((rho e + p)/rho - de_drho)/de_dp,  T ds = de + p dv. */
static void test_identities(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (size_t i = 0; i < n_law * 60; i++) {
        const struct law *law = &laws[i % n_law];
        double rho, p;
        draw(law, &seed, &rho, &p);
        struct point here = at(law, rho, p);
        double dp = 1e-4 * (p - here.p_min), dr = 1e-5 * rho;
        struct point up = at(law, rho, p + dp), down = at(law, rho, p - dp);
        struct point dense = at(law, rho + dr, p), thin = at(law, rho - dr, p);
        double h = (here.rho_e + p) / rho, e = here.rho_e / rho;
        support_near("de_dp", (up.rho_e - down.rho_e) / (2 * dp), here.de_dp, 1e-6,
                     here.de_dp + fabs(here.rho_e / p) * 1e-6);
        double slope = (dense.rho_e - thin.rho_e) / (2 * dr);
        double size = fabs(here.de_drho) + fabs(e) + here.c2 * here.de_dp;
        support_near("de_drho", slope, here.de_drho, 1e-6, size);
        support_near("c2", (h - here.de_drho) / here.de_dp, here.c2, 1e-6, here.c2 + fabs(e) * 1e-9 / here.de_dp);
        support_near("ds/dp", (up.s - down.s) / (2 * dp) * here.T * rho, here.de_dp, 1e-6, here.de_dp);
        support_near("ds/drho", (dense.s - thin.s) / (2 * dr) * here.T * rho, here.de_drho - h, 1e-6, size);
    }
}

/* Well-posed for every density and every pressure above p_min, the continuation included. */
static void test_well_posed(void **state)
{
    (void)state;
    for (size_t i = 0; i < n_law; i++)
        for (double rho = 1e-3; rho < 4600.0; rho *= 1.01)
            for (double above = 1e-3; above < 1e11; above *= 10.0) {
                const struct law *law = &laws[i];
                double p_min = at(law, rho, 0.0).p_min, p = p_min + above;
                if (p <= p_min * (1.0 - 1e-9)) continue;
                struct point point = at(law, rho, p);
                if (!(point.de_dp > 0.0 && point.c2 > 0.0 && point.T > 0.0))
                    fail_msg("%s %s at rho %g p %g: de_dp %g c2 %g T %g", law->module, law->preset, rho, p, point.de_dp,
                             point.c2, point.T);
                assert_true(isfinite(point.rho_e) && isfinite(point.c2) && isfinite(point.T) && isfinite(point.s));
                assert_true(isfinite(point.de_dp) && isfinite(point.de_drho));
            }
}

/* At and below p_min the value says so; nothing traps. */
static void test_below_p_min(void **state)
{
    (void)state;
    for (size_t i = 0; i < n_law; i++) {
        double p_min = at(&laws[i], 900.0, 0.0).p_min;
        assert_true(at(&laws[i], 900.0, p_min).c2 <= 1e-12 * at(&laws[i], 900.0, 1e5).c2);
        assert_true(at(&laws[i], 900.0, p_min - 1e8).c2 < 0.0);
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

/* density is the inverse of temperature, also beyond the edge. */
static void test_density_inverts(void **state)
{
    (void)state;
    uint64_t seed = 5;
    for (size_t i = 0; i < n_law * 100; i++) {
        const struct law *law = &laws[i % n_law];
        double rho, p, back;
        draw(law, &seed, &rho, &p);
        double T = at(law, rho, p).T;
        law->eos->density(law->instance.self, 1, &p, &T, &back);
        support_near("rho(p, T)", back, rho, 1e-9, rho);
    }
}

/* The coefficients give exactly the function that state gives. */
static void test_linear_is_state(void **state)
{
    (void)state;
    uint64_t seed = 2;
    for (size_t i = 0; i < n_law * 100; i++) {
        const struct law *law = &laws[i % n_law];
        double rho, p, a, b;
        draw(law, &seed, &rho, &p);
        assert_non_null(law->eos->linear);
        law->eos->linear(law->instance.self, 1, &rho, &a, &b);
        struct point point = at(law, rho, p);
        assert_true(a * p + b == point.rho_e);
        assert_true(a == point.de_dp);
    }
}

/* A value depends on its point alone: not on the place in the row, nor on the length of the row. */
static void test_rows(void **state)
{
    (void)state;
    uint64_t seed = 3;
    for (size_t i = 0; i < n_law; i++) {
        const struct law *law = &laws[i];
        const void *self = law->instance.self;
        double rho[ROW], p[ROW], out[8][ROW];
        for (int j = 0; j < ROW; j++) draw(law, &seed, &rho[j], &p[j]);
        for (int first = 0; first < 9; first++) {
            size_t n = (size_t)(ROW - first * 4);
            law->eos->state(self, n, rho + first, p + first, out[0], out[1]);
            law->eos->derivatives(self, n, rho + first, p + first, out[2], out[3]);
            law->eos->temperature(self, n, rho + first, p + first, out[4]);
            law->eos->entropy(self, n, rho + first, p + first, out[5]);
            law->eos->linear(self, n, rho + first, out[6], out[7]);
            for (size_t j = 0; j < n; j++) {
                struct point point = at(law, rho[j + (size_t)first], p[j + (size_t)first]);
                double want[6] = {point.rho_e, point.stiffness, point.de_dp, point.de_drho, point.T, point.s};
                for (int k = 0; k < 6; k++) assert_true(out[k][j] == want[k]);
                assert_true(out[6][j] == want[2]);
            }
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

static void test_ranges(void **state)
{
    (void)state;
    for (size_t i = 0; i < n_law; i++) {
        struct bulla_eos_range range = {0};
        laws[i].eos->range(laws[i].instance.self, &range);
        assert_true(range.rho_min < range.rho_max && range.p_min < range.p_max && range.T_min < range.T_max);
        assert_true(range.p_min >= at(&laws[i], range.rho_max, 0.0).p_min);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_reference_points), cmocka_unit_test(test_identities),
        cmocka_unit_test(test_well_posed),       cmocka_unit_test(test_below_p_min),
        cmocka_unit_test(test_edge_is_smooth),   cmocka_unit_test(test_density_inverts),
        cmocka_unit_test(test_linear_is_state),  cmocka_unit_test(test_rows),
        cmocka_unit_test(test_presets),          cmocka_unit_test(test_sg3_heats),
        cmocka_unit_test(test_ranges),
    };
    return cmocka_run_group_tests(tests, start, stop);
}
