/* eos_family.c - the closed-form family (ideal gas, stiffened gas, NASG, modified NASG) against reference points
 * computed with 50 digits, where its continuation begins, and what its presets are known for. What all laws must hold:
 * eos_laws.c. */
#include "law.h"

struct reference {
    const char *set, *module;
    double numbers[6], cv;
};

/* Parameters of the sets in the file, in the order of the modules' tables. */
static const struct reference references[] = {
    {"ideal_air", "ideal-gas", {1.4, 717.5}, 717.5},
    {"sg_water_g4.4", "stiffened-gas", {4.4, 6e8, 1000.0, 0.0}, 1000.0},
    {"sg_water_g4", "stiffened-gas", {4.0, 6e8, 1000.0, 0.0}, 1000.0},
    {"sg_water_g3", "stiffened-gas", {3.0, 8.533e8, 1395.0, -1148000.0}, 1395.0},
    {"sg_water_g2.35", "stiffened-gas", {2.35, 1e9, 1816.0, -1167000.0}, 1816.0},
    {"sg_water_g6.59", "stiffened-gas", {6.59, 4.10264925e8, 1000.0, 0.0}, 1000.0},
    {"nasg_water", "nasg", {1.19, 7028e5, 6.61e-4, -1177788.0, 3610.0}, 3610.0},
    {"mnasg_water", "mnasg", {1.19, 6217.8e5, 6.7212e-4, -1177788.0, 3610.0}, 3610.0},
};

/* Columns behind the name: rho, p, e, T, c2, c, s, h, Gamma, de/dp, de/drho per mass. */
static void check_reference(const struct reference *reference, const double *column)
{
    double rho = column[0], p = column[1], e = column[2], T = column[3], c2 = column[4], s = column[6];
    double G = column[8], e_p = column[9], e_rho = column[10];
    struct law law = {.instance = support_open(support_module("eos", reference->module), reference->numbers)};
    law.eos = law.instance.module->table;
    struct law_point at = law_at(&law, rho, p);
    support_near("e", at.rho_e / rho, e, 1e-12, fabs(e) + fabs(p) / rho); /* e may cancel against its zero */
    support_near("c2", at.c2, c2, 1e-12, fabs(c2));
    support_near("T", at.T, T, 1e-12, fabs(T));
    support_near("s", at.s, s, 1e-12, fabs(s) + reference->cv);
    support_near("Gamma", 1.0 / at.de_dp, G, 1e-12, G);
    support_near("de_dp", at.de_dp, rho * e_p, 1e-12, fabs(rho * e_p));
    support_near("de_drho", at.de_drho, e + rho * e_rho, 1e-12, fabs(e) + fabs(rho * e_rho));
    support_near("rho(p, T)", law_density(&law, p, T), rho, 1e-11, rho);
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

/* Where the continuation of the co-volume begins, values and their first derivatives meet. */
static void test_edge_is_smooth(void **state)
{
    (void)state;
    static const char *const names[] = {"nasg", "mnasg"};
    for (size_t i = 0; i < 2; i++) {
        struct law law = law_preset(names[i], "water");
        double edge = 0.98 / law.instance.values[2].number, h = 1e-9 * edge;
        for (double p = 1e5; p < 1e11; p *= 100.0) {
            struct law_point below = law_at(&law, edge - h, p), above = law_at(&law, edge + h, p);
            support_near("rho_e", above.rho_e, below.rho_e, 1e-6, fabs(below.rho_e));
            support_near("c2", above.c2, below.c2, 1e-5, below.c2);
            support_near("T", above.T, below.T, 1e-6, below.T);
            support_near("s", above.s, below.s, 1e-6, fabs(below.s) + 3610.0);
            support_near("de_drho", above.de_drho, below.de_drho, 1e-6, fabs(below.de_drho) + below.c2 * below.de_dp);
        }
        instance_done(&law.instance);
    }
}

/* What the named presets are known for at 300 K and 1e5 Pa: density, and, where it is right by design, sound speed. */
static void test_presets(void **state)
{
    (void)state;
    static const struct {
        const char *module, *preset;
        double rho, off, c; /* c = 0: it is not known */
    } known[] = {
        {"nasg", "water", 1048.5, 0.05, 1612.2},
        {"mnasg", "water", 997.0, 0.05, 1500.0},
        {"stiffened-gas", "sg44", 998.2, 1e-3, 0.0},
        {"stiffened-gas", "sg4", 998.2, 1e-3, 0.0},
        {"stiffened-gas", "sg659", 998.2, 1e-3, 0.0},
        {"stiffened-gas", "sg659b", 998.2, 1e-3, 0.0},
        {"stiffened-gas", "sg3", 1019.59, 0.01, 1584.6},
        {"stiffened-gas", "sg235", 1359.79, 0.01, 1314.7},
        {"ideal-gas", "air-r287", 1e5 / (287.05 * 300.0), 1e-12, 0.0},
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        struct law law = law_preset(known[i].module, known[i].preset);
        double rho = law_density(&law, 1e5, 300.0);
        support_near(known[i].preset, rho, known[i].rho, 1.0, known[i].off);
        if (known[i].c > 0.0) support_near("sound speed", sqrt(law_at(&law, rho, 1e5).c2), known[i].c, 1.0, 0.05);
        instance_done(&law.instance);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_reference_points),
        cmocka_unit_test(test_edge_is_smooth),
        cmocka_unit_test(test_presets),
    };
    return cmocka_run_group_tests(tests, support_start, support_stop);
}
