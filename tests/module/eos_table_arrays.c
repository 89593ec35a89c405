/* eos_table_arrays.c - states from an HDF5 file: the same law as from CSV; what is no such file is refused with the
 * data set and the reason. */
#include "law.h"

#include <hdf5.h>
#include <unistd.h>

enum { RHO, TEMPERATURE, P, E, C, S, SETS };
enum { N_RHO = 14, N_T = 12 };

static char path[4096], csv[4096];

/* What is to be wrong with one data set; the rest is right. */
struct damage {
    int set;
    const char *unit; /* NULL: no attribute; "": the right one */
    double scale;     /* of all its values */
    int at;           /* one value ... */
    double value;     /* ... that is this */
    int rank;         /* 0: the right one */
    hsize_t n[2];     /* 0: the right ones */
    bool absent, text;
};

static const struct damage sound = {.set = SETS, .unit = "", .scale = 1.0, .at = -1};

static const char *const names[SETS] = {"rho", "T", "p", "e", "c", "s"};
static const char *const units[SETS] = {"kg/m3", "K", "Pa", "J/kg", "m/s", "J/kg/K"};
static double values[SETS][N_RHO * N_T];

/* The states of modified NASG, whose p(rho, T) is explicit. */
static void make_values(void)
{
    struct law law = law_preset("mnasg", "water");
    const struct bulla_value *v = law.instance.values;
    for (int r = 0; r < N_RHO * N_T; r++) {
        double rho = 900.0 + 25.0 * (r / N_T), T = 280.0 + 20.0 * (r % N_T);
        double p = (v[0].number - 1.0) * v[4].number * T / (1.0 / rho - v[2].number) - v[1].number;
        struct law_point at = law_at(&law, rho, p);
        const double row[SETS] = {rho, T, p, at.rho_e / rho, sqrt(at.c2), at.s};
        for (int k = 0; k < SETS; k++) values[k][k == RHO ? r / N_T : k == TEMPERATURE ? r % N_T : r] = row[k];
    }
    instance_done(&law.instance);
}

/* Text of fixed length, or, for every second set, of any length, as other programs write it. */
static void put_unit(hid_t set, int k, const char *unit)
{
    hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    assert_true(H5Tset_size(type, k % 2 ? H5T_VARIABLE : strlen(unit) + 1) >= 0);
    hid_t attribute = H5Acreate2(set, "units", type, space, H5P_DEFAULT, H5P_DEFAULT);
    assert_true(H5Awrite(attribute, type, k % 2 ? (const void *)&unit : (const void *)unit) >= 0);
    H5Aclose(attribute);
    H5Sclose(space);
    H5Tclose(type);
}

static void put_set(hid_t file, int k, const struct damage *damage)
{
    bool hurt = damage->set == k, coordinate = k <= TEMPERATURE;
    if (hurt && damage->absent) return;
    hsize_t n[2] = {k == TEMPERATURE ? N_T : N_RHO, N_T};
    for (int i = 0; i < 2 && hurt; i++) n[i] = damage->n[i] ? damage->n[i] : n[i];
    hid_t space = H5Screate_simple(hurt && damage->rank ? damage->rank : coordinate ? 1 : 2, n, NULL);
    double out[N_RHO * N_T];
    for (int i = 0; i < N_RHO * N_T; i++) out[i] = values[k][i] * (hurt ? damage->scale : 1.0);
    if (hurt && damage->at >= 0) out[damage->at] = damage->value;
    hid_t text = H5Tcopy(H5T_C_S1);
    hid_t set = H5Dcreate2(file, names[k], hurt && damage->text ? text : H5T_IEEE_F64BE, space, H5P_DEFAULT,
                           H5P_DEFAULT, H5P_DEFAULT);
    if (!(hurt && damage->text)) H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, out);
    if (!hurt || damage->unit) put_unit(set, k, hurt && *damage->unit ? damage->unit : units[k]);
    H5Tclose(text);
    H5Dclose(set);
    H5Sclose(space);
}

static void put_file(const struct damage *damage)
{
    hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    assert_true(file >= 0);
    for (int k = 0; k < SETS; k++) put_set(file, k, damage);
    H5Fclose(file);
}

static int open_file(const char *name, struct law *law)
{
    struct bulla_value value = {.text = name};
    const struct bulla_module *module = support_module("eos", "table");
    law->eos = module->table;
    return instance_open(module, &value, &law->instance);
}

/* Bit by bit the law of the same states as CSV, and within 1e-5 of the law they come from. */
static void test_same(void **state)
{
    (void)state;
    struct law arrays = {0}, lines = {0}, law = law_preset("mnasg", "water");
    FILE *out = fopen(csv, "w");
    assert_non_null(out);
    fprintf(out, "rho[kg/m3],T[K],p[Pa],e[J/kg],c[m/s],s[J/kg/K]\n");
    for (int r = 0; r < N_RHO * N_T; r++)
        fprintf(out, "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", values[RHO][r / N_T], values[TEMPERATURE][r % N_T],
                values[P][r], values[E][r], values[C][r], values[S][r]);
    assert_int_equal(fclose(out), 0);
    put_file(&sound);
    if (open_file(path, &arrays) || open_file(csv, &lines)) fail_msg("%s", status_text());
    uint64_t seed = 3;
    for (int i = 0; i < 2000; i++) {
        double rho = contract_random(&seed, 905.0, 1220.0), p = contract_random(&seed, 1e5, 4e8);
        struct law_point one = law_at(&arrays, rho, p), other = law_at(&lines, rho, p), exact = law_at(&law, rho, p);
        assert_memory_equal(&one, &other, sizeof one);
        if (exact.T > 285.0 && exact.T < 495.0) support_near("T", one.T, exact.T, 1e-4, exact.T);
    }
    instance_done(&arrays.instance);
    instance_done(&lines.instance);
    instance_done(&law.instance);
}

static void refuse(const char *words, const char *more)
{
    struct law law = {0};
    if (open_file(path, &law) == 0) fail_msg("taken in spite of: %s %s", words, more);
    if (!strstr(status_text(), words) || !strstr(status_text(), more) || !strstr(status_text(), path))
        fail_msg("'%s' and '%s' are not in: %s", words, more, status_text());
}

static void damaged(struct damage damage, const char *words, const char *more)
{
    if (damage.scale == 0.0) damage.scale = 1.0;
    put_file(&damage);
    refuse(words, more);
}

#define AT_NONE .at = -1, .unit = ""

static void test_hostile(void **state)
{
    (void)state;
    damaged((struct damage){.set = S, AT_NONE, .absent = true}, "there is no data set 's'", "are wanted");
    damaged((struct damage){.set = P, .at = -1, .unit = NULL}, "data set 'p'", "'units' is missing; 'Pa'");
    damaged((struct damage){.set = P, .at = -1, .unit = "bar"}, "data set 'p'", "the unit is 'bar', not 'Pa'");
    damaged((struct damage){.set = E, .at = -1, .unit = "kJ/kg"}, "data set 'e'", "'kJ/kg', not 'J/kg'");
    damaged((struct damage){.set = RHO, .at = -1, .unit = "g/cm3"}, "data set 'rho'", "'g/cm3', not 'kg/m3'");
    damaged((struct damage){.set = RHO, AT_NONE, .rank = 2}, "data set 'rho'", "has 2 dimensions, not 1");
    damaged((struct damage){.set = C, AT_NONE, .rank = 1}, "data set 'c'", "has 1 dimensions, not 2");
    damaged((struct damage){.set = TEMPERATURE, AT_NONE, .n = {7, 0}}, "data set 'T'", "has 7 values; 8 to 1500");
    damaged((struct damage){.set = E, AT_NONE, .n = {N_T, N_RHO}}, "data set 'e'", "12 x 14; 14 densities x 12");
    damaged((struct damage){.set = C, AT_NONE, .text = true}, "data set 'c'", "holds no numbers");
    damaged((struct damage){.set = P, .unit = "", .at = 30, .value = NAN}, "data set 'p'", "[2][6] is not finite");
    damaged((struct damage){.set = RHO, .unit = "", .at = 3, .value = 950.0}, "'rho': must ascend",
            "[3] is 950 after 950");
    damaged((struct damage){.set = TEMPERATURE, .unit = "", .at = 0, .value = 0.0}, "'T'", "[0] is not above 0");
    damaged((struct damage){.set = C, .unit = "", .at = 5, .value = -3.0}, "'c'", "[0][5] is not above 0");
    damaged((struct damage){.set = P, .unit = "", .at = 47, .value = 1.0}, "state [3][11]", "does not grow");
    damaged((struct damage){.set = S, .unit = "", .at = 47, .value = -1e9}, "state [3][11]", "s[J/kg/K] does not grow");
    damaged((struct damage){.set = TEMPERATURE, .unit = "", .at = 3, .value = NAN}, "'T'", "[3] is not finite");
    damaged((struct damage){.set = E, .unit = "", .at = 29, .value = INFINITY}, "'e'", "[2][5] is not finite");
    damaged((struct damage){.set = TEMPERATURE, .unit = "", .at = 4, .value = 300.0}, "'T': must ascend", "[4] is 300");
    damaged((struct damage){.set = RHO, AT_NONE, .scale = 1e-3}, "state [0][0]", "wrong units");
    damaged((struct damage){.set = P, AT_NONE, .scale = 1e-5}, "state [0][0]", "wrong units");
    damaged((struct damage){.set = C, AT_NONE, .scale = 1e-3}, "state [0][0]", "wrong units");
    damaged((struct damage){.set = E, AT_NONE, .scale = 1e-3}, "state [0][0]", "wrong units");
    put_file(&sound);
    assert_int_equal(truncate(path, 2000), 0);
    refuse("no HDF5 file that can be opened", "cut off");
    assert_int_equal(truncate(path, 0), 0);
    refuse("no HDF5 file that can be opened", "cut off");
    remove(path);
    refuse("there is no such file", "");
}

static int start(void **state)
{
    snprintf(path, sizeof path, "%s/tests/table_arrays.h5", getenv("BULLA_BUILD"));
    snprintf(csv, sizeof csv, "%s/tests/table_arrays.csv", getenv("BULLA_BUILD"));
    int code = support_start(state);
    if (!code) make_values();
    return code;
}

static int stop(void **state)
{
    remove(path);
    remove(csv);
    return support_stop(state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_same), cmocka_unit_test(test_hostile)};
    return cmocka_run_group_tests(tests, start, stop);
}
