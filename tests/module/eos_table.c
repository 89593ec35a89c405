/* eos_table.c - states from a file: tables of laws in closed form give these laws back, hold the contract and go on
 * beyond; files that are no such table are refused with the line and the reason. */
#include "law.h"

#include <sys/stat.h>
#include <unistd.h>

enum { ROW = 160 };

static char path[4096];

/* p of a law at (rho, T), by bisection of T. */
static double pressure_of(const struct law *law, double rho, double T)
{
    double low, high = 1e12, at;
    law->eos->p_min(law->instance.self, 1, &rho, &low);
    for (int i = 0; i < 100; i++) {
        double mean = 0.5 * (low + high);
        law->eos->temperature(law->instance.self, 1, &rho, &mean, &at);
        if (at > T) high = mean;
        else low = mean;
    }
    return high;
}

struct box {
    double rho[2], T[2];
    int n_rho, n_T;
};

/* Lines of a table of a law: [0] the names, then the states. */
static char (*table_of(const struct law *law, const struct box *box, int *ret_n))[ROW]
{
    char(*line)[ROW] = malloc((size_t)(box->n_rho * box->n_T + 1) * ROW);
    assert_non_null(line);
    snprintf(line[0], ROW, "rho[kg/m3],T[K],p[Pa],e[J/kg],c[m/s],s[J/kg/K]");
    int n = 1;
    for (int i = 0; i < box->n_rho; i++)
        for (int j = 0; j < box->n_T; j++) {
            double rho = box->rho[0] * pow(box->rho[1] / box->rho[0], i / (box->n_rho - 1.0));
            double T = box->T[0] * pow(box->T[1] / box->T[0], j / (box->n_T - 1.0)), p = pressure_of(law, rho, T);
            struct law_point at = law_at(law, rho, p);
            snprintf(line[n++], ROW, "%.16g,%.16g,%.16g,%.16g,%.16g,%.16g", rho, T, p, at.rho_e / rho, sqrt(at.c2),
                     at.s);
        }
    *ret_n = n;
    return line;
}

static void write_lines(char (*line)[ROW], int n)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "# a table\n");
    for (int i = 0; i < n; i++) fprintf(file, "%s\n", line[i]);
    assert_int_equal(fclose(file), 0);
}

static int open_table(struct law *law)
{
    struct bulla_value value = {.text = path};
    const struct bulla_module *module = support_module("eos", "table");
    law->eos = module->table;
    return instance_open(module, &value, &law->instance);
}

/* Largest relative errors of T, e (per p/rho) and c against the law, at random states of the box. */
static void check_table(const struct law *table, const struct law *law, const struct box *box, const double most[3])
{
    uint64_t seed = 5;
    double worst[3] = {0.0, 0.0, 0.0};
    for (int i = 0; i < 2000; i++) {
        double rho = exp(contract_random(&seed, log(box->rho[0]), log(box->rho[1])));
        double T = contract_random(&seed, box->T[0], box->T[1]), p = pressure_of(law, rho, T);
        struct law_point at = law_at(table, rho, p), exact = law_at(law, rho, p);
        double size = fabs(exact.de_dp) * rho * exact.c2;
        double error[3] = {at.T / exact.T - 1.0, (at.rho_e - exact.rho_e) / size, sqrt(at.c2 / exact.c2) - 1.0};
        for (int l = 0; l < 3; l++) worst[l] = fabs(error[l]) > worst[l] ? fabs(error[l]) : worst[l];
    }
    for (int l = 0; l < 3; l++) support_near("error of a table", worst[l], 0.0, 1.0, most[l]);
}

/* A mixture's iteration stops at 1e-13 of p or where rho e resolves no more: rounding in the table must not keep it
 * from getting there. */
static void check_closes(const struct law *table, const struct law *law, const struct box *box)
{
    uint64_t seed = 11;
    for (int i = 0; i < 4000; i++) {
        double rho = exp(contract_random(&seed, log(box->rho[0]), log(box->rho[1])));
        double p = pressure_of(law, rho, contract_random(&seed, box->T[0], box->T[1])), step = 0.0, least = 0.0;
        double sought = law_at(table, rho, p).rho_e, at = p * contract_random(&seed, 0.9, 1.1);
        for (int k = 0; k < 12; k++, at -= step) {
            struct law_point here = law_at(table, rho, at);
            step = (here.rho_e - sought) / here.de_dp;
            least = 8.8e-16 * (fabs(sought) + fabs(here.rho_e)) / here.de_dp;
            least = least > 1e-13 * fabs(at) ? least : 1e-13 * fabs(at);
            if (fabs(step) <= least) break;
        }
        if (fabs(step) > least) fail_msg("rho %.17g, p %.17g: the last step is %g, not %g", rho, p, step, least);
    }
}

/* What a table of a law must do: near the law inside, well-posed, and the contract. */
static void test_law(const char *module, const char *preset, const struct box *box, const double most[3])
{
    struct law law = law_preset(module, preset), table = {0};
    int n;
    char(*line)[ROW] = table_of(&law, box, &n);
    write_lines(line, n);
    assert_int_equal(open_table(&table), 0);
    check_table(&table, &law, box, most);
    check_closes(&table, &law, box);
    law_sweep(&table, 3.0 * box->rho[1]);
    for (double rho = 0.01 * box->rho[0]; rho < 3.0 * box->rho[1]; rho *= 1.7)
        for (double p = 1.0; p < 1e11; p *= 7.3) {
            struct law_point at = law_at(&table, rho, p);
            if (p > at.p_min)
                support_near("p of e", law_pressure(&table, rho, at.rho_e, 2.0 * p + 1e5), p, 1e-10,
                             p + 1e5 + fabs(at.rho_e) / at.de_dp * 1e-5);
        }
    double rho[] = {0.5 * box->rho[0], sqrt(box->rho[0] * box->rho[1]), 2.0 * box->rho[1]}, p[3];
    for (int i = 0; i < 3; i++) p[i] = pressure_of(&law, rho[1], 0.5 * (box->T[0] + box->T[1]));
    assert_int_equal(table.eos->count_outside(table.instance.self, 3, rho, p), 2);
    instance_done(&table.instance);
    char setting[sizeof path + 8];
    snprintf(setting, sizeof setting, "file=%s", path);
    struct contract contract = {.module = support_module("eos", "table")};
    assert_int_equal(contract_module_run(&contract, (const char *const[]){setting, NULL}), 0);
    support_holds(&contract);
    instance_done(&law.instance);
    free(line);
}

static void test_laws(void **state)
{
    (void)state;
    test_law("mnasg", "water", &(struct box){{800.0, 1300.0}, {275.0, 700.0}, 60, 40},
             (const double[]){1e-6, 1e-7, 8e-5});
    test_law("modified-tait", "refit", &(struct box){{850.0, 1500.0}, {275.0, 600.0}, 60, 50},
             (const double[]){2e-5, 2e-6, 2e-3});
    test_law("rkpr", "air", &(struct box){{0.1, 800.0}, {200.0, 4000.0}, 100, 60}, (const double[]){1e-4, 1e-4, 5e-3});
}

/* Opens what was written; the message must hold all of `words`. */
static void refuse(const char *words, const char *more)
{
    struct law law = {0};
    if (open_table(&law) == 0) fail_msg("taken in spite of: %s %s", words, more);
    if (!strstr(status_text(), words) || !strstr(status_text(), more) || !strstr(status_text(), "table_test.csv"))
        fail_msg("'%s' and '%s' are not in: %s", words, more, status_text());
}

/* Writes the table with line `at` (0: the names) replaced. */
static void damaged(char (*line)[ROW], int n, int at, const char *text, const char *words, const char *more)
{
    char kept[ROW];
    memcpy(kept, line[at], ROW);
    snprintf(line[at], ROW, "%s", text);
    write_lines(line, n);
    refuse(words, more);
    memcpy(line[at], kept, ROW);
}

/* The same with one number (by column) multiplied. */
static void scaled(char (*line)[ROW], int n, int first, int last, int column, double factor, const char *words)
{
    char(*copy)[ROW] = malloc((size_t)n * ROW);
    assert_non_null(copy);
    memcpy(copy, line, (size_t)n * ROW);
    for (int i = first; i <= last; i++) {
        double v[6];
        char *at = copy[i];
        for (int k = 0; k < 6; k++, at++) v[k] = strtod(at, &at);
        v[column] *= factor;
        snprintf(copy[i], ROW, "%.16g,%.16g,%.16g,%.16g,%.16g,%.16g", v[0], v[1], v[2], v[3], v[4], v[5]);
    }
    write_lines(copy, n);
    refuse(words, "");
    free(copy);
}

static void test_hostile(void **state)
{
    (void)state;
    struct law law = law_preset("mnasg", "water");
    struct box box = {{900.0, 1200.0}, {280.0, 500.0}, 12, 10};
    int n;
    char(*line)[ROW] = table_of(&law, &box, &n);
    damaged(line, n, 0, "rho[kg/m3],T[K],p[bar],e[J/kg],c[m/s],s[J/kg/K]", ":2:", "'p[bar]' is not known");
    damaged(line, n, 0, "rho[kg/m3],T[K],p[Pa],e[J/kg],c[m/s]", ":2:", "'s[J/kg/K]' is missing");
    damaged(line, n, 0, "T[K],T[K],p[Pa],e[J/kg],c[m/s],s[J/kg/K]", ":2:", "twice");
    damaged(line, n, 30, "1000,300,nan,1,1500,1", ":32:", "p[Pa] is not finite");
    damaged(line, n, 30, "1000,300,1e999,1,1500,1", ":32:", "not finite");
    damaged(line, n, 30, "1000,300,water,1,1500,1", ":32:", "'water,1,1500,1' is no number");
    damaged(line, n, 30, "1000,300,1e5,1,1500", ":32:", "6 numbers");
    damaged(line, n, 30, "1000,300,1e5,1,1500,1,7", ":32:", "6 numbers");
    damaged(line, n, 30, "1000,300,1e5,1,-1500,1", ":32:", "above 0");
    damaged(line, n, 5, "1000,300,1e5,1,1500,1", "densities and", "wanted");
    damaged(line, n, 25, "1000,300,1e5,1,1500,1", ":27:", "not rectangular");
    write_lines(line, n - 3);
    refuse("ends after 7 of 10 temperatures", ":");
    write_lines(line, 61);
    refuse("6 densities and 10 temperatures", "8 to 1500");
    write_lines(line, 0);
    refuse("no line of names", "");
    write_lines(line, 1);
    refuse("0 densities and 1 temperatures", "8 to 1500");
    remove(path);
    refuse("there is no such file", "");
    assert_int_equal(mkdir(path, 0700), 0);
    refuse("is no file", "");
    assert_int_equal(rmdir(path), 0);
    assert_int_equal(mkfifo(path, 0600), 0);
    refuse("is no file", "");
    remove(path);
    instance_done(&law.instance);
    free(line);
}

/* Numbers that are none of a substance's: where they fall, or what units do to a whole column. State i stands in line i
 * + 2. */
static void test_hostile_numbers(void **state)
{
    (void)state;
    enum { RHO, TEMPERATURE, P, E, C, S };
    static const struct {
        int first, last, column;
        double factor;
        const char *words;
    } wrong[] = {
        {21, 30, RHO, 0.5, ":23: densities must ascend"},
        {21, 30, RHO, 0.974, ":23: densities must ascend"}, /* by a little */
        {6, 6, TEMPERATURE, 0.5, ":8: temperatures must ascend"},
        {36, 36, TEMPERATURE, 1.001, ":38: the grid is not rectangular: temperature"},
        {47, 47, P, 0.1, ":49: p[Pa] does not grow"},
        {47, 47, E, 10.0, ":50: e[J/kg] does not grow"},
        {47, 47, S, 0.1, ":49: s[J/kg/K] does not grow"},
        {47, 47, P, 1.02, ": wrong units, unsteady numbers"},
        {47, 47, C, 1.2, ":49: p, e and s around here say c ="},
        {1, 120, RHO, 1e-3, ":3: "}, /* g/cm3 */
        {1, 120, P, 1e-5, ":3: "},   /* bar */
        {1, 120, P, 1e-6, ":3: "},   /* MPa */
        {1, 120, E, 1e-3, ":3: "},   /* kJ/kg */
        {1, 120, S, 1e-3, ":3: "},   /* kJ/kg/K */
        {1, 120, S, 4.1868, ":3: "}, /* cal/kg/K */
        {1, 120, C, 1e-3, ":3: "},   /* km/s */
        {1, 120, C, 3.2808, ":3: "}, /* ft/s */
        {1, 120, P, -1.0, ":4: p[Pa] does not grow"},
    };
    struct law law = law_preset("mnasg", "water");
    struct box box = {{900.0, 1200.0}, {280.0, 500.0}, 12, 10};
    int n;
    char(*line)[ROW] = table_of(&law, &box, &n);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        scaled(line, n, wrong[i].first, wrong[i].last, wrong[i].column, wrong[i].factor, wrong[i].words);
    instance_done(&law.instance);
    free(line);
}

/* No text, a line without end, far too much, another system's ends of lines. */
static void test_hostile_files(void **state)
{
    (void)state;
    struct law law = law_preset("mnasg", "water"), table = {0};
    struct box box = {{900.0, 1200.0}, {280.0, 500.0}, 12, 10};
    int n;
    char(*line)[ROW] = table_of(&law, &box, &n);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_int_equal(fclose(file), 0);
    refuse("no line of names", "");
    file = fopen(path, "w");
    for (int i = 0; i < 4096; i++) fputc(i * 37 % 251, file);
    assert_int_equal(fclose(file), 0);
    refuse("column '", "is not known");
    file = fopen(path, "w");
    fprintf(file, "%s\n%02000d\n", line[0], 1);
    assert_int_equal(fclose(file), 0);
    refuse(":2:", "the line is too long");
    file = fopen(path, "w");
    fprintf(file, "%s\n", line[0]);
    for (int i = 0; i < 1501 * 8; i++) fprintf(file, "%d,%d,1,1,1,1\n", 1 + i / 8, 1 + i % 8);
    assert_int_equal(fclose(file), 0);
    refuse("1501 densities and 8 temperatures", "8 to 1500");
    file = fopen(path, "w");
    for (int i = 0; i < n; i++) fprintf(file, "%s\r\n", line[i]);
    assert_int_equal(fclose(file), 0);
    assert_int_equal(open_table(&table), 0);
    instance_done(&table.instance);
    instance_done(&law.instance);
    free(line);
}

static int start(void **state)
{
    snprintf(path, sizeof path, "%s/tests/table_test.csv", getenv("BULLA_BUILD"));
    return support_start(state);
}

static int stop(void **state)
{
    remove(path);
    return support_stop(state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_laws), cmocka_unit_test(test_hostile),
                                       cmocka_unit_test(test_hostile_numbers), cmocka_unit_test(test_hostile_files)};
    return cmocka_run_group_tests(tests, start, stop);
}
