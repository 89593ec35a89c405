/* module_table.c - see module_table.h.
 *
 * A law is asked for states by (rho, p); the grid of a table is one of (rho, T). So p is found by bisection, to the
 * last bit: T grows with p at constant density in every law, and a table has few states. Where a law continues its
 * formulas T may stop falling with p; a state without its temperature is refused, one that a continuation makes up is
 * counted. */
#include "suite/module_table.h"

#include "base/comm.h"
#include "base/log.h"
#include "base/mem.h"
#include "base/status.h"
#include "bulla/eos.h"
#include "case/unit.h"
#include "io/h5.h"
#include "io/h5out.h"
#include "plug/instance.h"
#include "plug/registry.h"
#include "suite/module_values.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TABLE_RHO, TABLE_T, TABLE_P, TABLE_E, TABLE_C, TABLE_S, TABLE_COLUMNS };
enum { TABLE_LEAST = 8, TABLE_MOST = 1500, TABLE_USUAL = 100 };

static const char *const module_table_names[TABLE_COLUMNS] = {"rho", "T", "p", "e", "c", "s"};
static const char *const module_table_units[TABLE_COLUMNS] = {"kg/m3", "K", "Pa", "J/kg", "m/s", "J/kg/K"};

struct table {
    const struct bulla_eos *eos;
    const void *self;
    double rho[2], T[2];
    size_t n_rho, n_T;
    double *column[TABLE_COLUMNS]; /* of all states; rho and T of the axes */
    size_t outside;                /* states that a continuation makes up */
};

/* "A..B", each with or without a unit; *ret stays where nothing is given. */
static int module_table_range(const struct cli_given *given, const char *option, const char *unit, double ret[2])
{
    const char *text = cli_value(given, option), *dots = text ? strstr(text, "..") : NULL;
    struct unit wanted, got;
    char bad[32];
    if (!text) return STATUS_OK;
    if (!dots || !unit_parse(unit, &wanted, bad))
        return status_fail(STATUS_CASE, "%s %s: A..B is wanted", option, text);
    char *ends[2] = {mem_text_n(text, (size_t)(dots - text)), mem_text(dots + 2)};
    bool good = true;
    for (int i = 0; i < 2; i++) {
        good = good && unit_quantity(ends[i], &ret[i], &got, bad) == UNIT_FINE;
        bool bare = ends[i][strcspn(ends[i], "abcdfghijklmnopqrstuvwxyzABCDFGHIJKLMNOPQRSTUVWXYZ%")] == '\0';
        good = good && (bare || unit_same(&got, &wanted)) && isfinite(ret[i]);
    }
    mem_free(ends[0]);
    mem_free(ends[1]);
    if (good && ret[0] > 0.0 && ret[1] > ret[0]) return STATUS_OK;
    return status_fail(STATUS_CASE, "%s %s: A..B with 0 < A < B in %s is wanted", option, text, unit);
}

/* What the command line says, else what the law states. */
static int module_table_box(const struct cli_given *given, struct table *table)
{
    struct bulla_eos_range range;
    const char *states = cli_value(given, "--states");
    int length = 0;
    table->eos->range(table->self, &range);
    table->rho[0] = range.rho_min;
    table->rho[1] = range.rho_max;
    table->T[0] = range.T_min;
    table->T[1] = range.T_max;
    table->n_rho = table->n_T = TABLE_USUAL;
    TRY(module_table_range(given, "--density", "kg/m3", table->rho));
    TRY(module_table_range(given, "--temperature", "K", table->T));
    if (states && (sscanf(states, "%zux%zu%n", &table->n_rho, &table->n_T, &length) != 2 || states[length]))
        return status_fail(STATUS_CASE, "--states %s: NxM is wanted, densities x temperatures", states);
    if (table->n_rho < TABLE_LEAST || table->n_T < TABLE_LEAST || table->n_rho > TABLE_MOST || table->n_T > TABLE_MOST)
        return status_fail(STATUS_CASE, "--states %s: %d to %d of each are wanted", states, TABLE_LEAST, TABLE_MOST);
    bool known = isfinite(table->rho[0]) && isfinite(table->rho[1]) && isfinite(table->T[0]) && isfinite(table->T[1]);
    if (known && table->rho[0] > 0.0 && table->T[0] > 0.0) return STATUS_OK;
    return status_fail(STATUS_CASE, "the law states no range of densities and temperatures: give --density A..B and "
                                    "--temperature A..B");
}

/* The pressure with this temperature: the highest at which the law is not hotter. False: there is none. */
static bool module_table_pressure(const struct table *table, double rho, double T, double *ret_p)
{
    double low, high = 1e5, at;
    table->eos->p_min(table->self, 1, &rho, &low);
    low = low > -1e12 ? low : -1e12;
    for (int i = 0; i < 60; i++, high *= 10.0) {
        table->eos->temperature(table->self, 1, &rho, &high, &at);
        if (at > T || !(high < 1e18)) break;
    }
    for (int i = 0; i < 2000; i++) {
        double mean = 0.5 * low + 0.5 * high;
        if (!(mean > low && mean < high)) break;
        table->eos->temperature(table->self, 1, &rho, &mean, &at);
        if (at > T) high = mean;
        else low = mean;
    }
    *ret_p = low;
    table->eos->temperature(table->self, 1, &rho, ret_p, &at);
    return fabs(at - T) <= 1e-6 * T;
}

/* One state; the temperature of the axis is replaced by none: p is as exact as T(rho, p) allows. */
static int module_table_state(struct table *table, size_t i, size_t j)
{
    double rho = table->column[TABLE_RHO][i], T = table->column[TABLE_T][j], p, rho_e, rho_c2, s;
    size_t at = i * table->n_T + j;
    if (!module_table_pressure(table, rho, T, &p))
        return status_fail(STATUS_CASE,
                           "the law has no state at %.6g kg/m3 and %.6g K: change --density or --temperature", rho, T);
    table->eos->state(table->self, 1, &rho, &p, &rho_e, &rho_c2);
    table->eos->entropy(table->self, 1, &rho, &p, &s);
    if (!(isfinite(rho_e) && isfinite(s) && rho_c2 > 0.0))
        return status_fail(STATUS_CASE, "the law has no well-posed state at %.6g kg/m3 and %.6g K", rho, T);
    table->column[TABLE_P][at] = p;
    table->column[TABLE_E][at] = rho_e / rho;
    table->column[TABLE_C][at] = sqrt(rho_c2 / rho);
    table->column[TABLE_S][at] = s;
    if (BULLA_EOS_HAS(table->eos, count_outside)) table->outside += table->eos->count_outside(table->self, 1, &rho, &p);
    return STATUS_OK;
}

static double module_table_between(const double ends[2], size_t i, size_t n)
{
    if (i + 1 == n) return ends[1];
    return ends[0] * pow(ends[1] / ends[0], (double)i / (double)(n - 1));
}

static int module_table_fill(struct table *table)
{
    for (int k = 0; k < TABLE_COLUMNS; k++) table->column[k] = mem_new(table->n_rho * table->n_T, sizeof(double));
    for (size_t i = 0; i < table->n_rho; i++)
        table->column[TABLE_RHO][i] = module_table_between(table->rho, i, table->n_rho);
    for (size_t j = 0; j < table->n_T; j++) table->column[TABLE_T][j] = module_table_between(table->T, j, table->n_T);
    for (size_t i = 0; i < table->n_rho; i++)
        for (size_t j = 0; j < table->n_T; j++) TRY(module_table_state(table, i, j));
    return STATUS_OK;
}

static int module_table_csv(const struct table *table, const char *path, const char *law)
{
    FILE *out = fopen(path, "w");
    if (!out) return status_fail(STATUS_RUN, "%s cannot be written: %s", path, strerror(errno));
    fprintf(out, "# states of %s\n", law);
    for (int k = 0; k < TABLE_COLUMNS; k++)
        fprintf(out, "%s%s[%s]", k ? "," : "", module_table_names[k], module_table_units[k]);
    fputc('\n', out);
    for (size_t at = 0; at < table->n_rho * table->n_T; at++)
        for (int k = 0; k < TABLE_COLUMNS; k++) {
            size_t place = k == TABLE_RHO ? at / table->n_T : k == TABLE_T ? at % table->n_T : at;
            fprintf(out, "%.17g%c", table->column[k][place], k + 1 < TABLE_COLUMNS ? ',' : '\n');
        }
    bool bad = ferror(out) != 0;
    if (fclose(out) || bad) return status_fail(STATUS_RUN, "%s cannot be written: %s", path, strerror(errno));
    return STATUS_OK;
}

static int module_table_h5(const struct table *table, const char *path, const char *law)
{
    struct h5 *file;
    TRY(h5_create(path, &file));
    h5_attribute_text(file, "/", "law", law);
    for (int k = 0; k < TABLE_COLUMNS; k++) {
        char *name = mem_print("/%s", module_table_names[k]);
        size_t n = k == TABLE_T ? table->n_T : table->n_rho;
        h5out_array(file, name, H5_F64, n, k <= TABLE_T ? 0 : (unsigned)table->n_T, table->column[k]);
        h5out_unit(file, name, module_table_units[k]);
        mem_free(name);
    }
    return h5_close(file);
}

/* Is the file one that `type: table` takes? It says itself how good it is. */
static int module_table_try(const char *path)
{
    const struct registry_entry *entry = registry_find("eos", "table");
    struct bulla_value value = {.text = path};
    struct instance instance = {0};
    if (!entry) return STATUS_OK;
    if (instance_open(entry->module, &value, &instance))
        return status_wrap(STATUS_CASE, "%s is written, but no table that can be used: ", path);
    instance_done(&instance);
    return STATUS_OK;
}

static int module_table_write(const struct cli_given *given, const struct bulla_module *module, struct table *table)
{
    const char *path = given->words[2], *dot = strrchr(path, '.');
    bool arrays = dot && (!strcmp(dot, ".h5") || !strcmp(dot, ".hdf5"));
    TRY(module_table_box(given, table));
    TRY(module_table_fill(table));
    if (table->outside)
        log_warn("%zu of %zu states are beyond the formulas of %s: made up by its continuation", table->outside,
                 table->n_rho * table->n_T, module->name);
    TRY((arrays ? module_table_h5 : module_table_csv)(table, path, module->name));
    return module_table_try(path);
}

static int module_table_of_law(const struct cli_given *given, const char *const *sets)
{
    struct bulla_value *values;
    struct instance instance = {0};
    TRY(registry_init());
    const struct registry_entry *entry = registry_find("eos", given->words[1]);
    if (!entry) return status_fail(STATUS_CASE, "there is no eos '%s'; `bulla modules` lists them", given->words[1]);
    TRY(module_values(entry->module, sets, &values));
    int code = module_values_check(entry->module, values);
    if (!code) code = instance_open(entry->module, values, &instance);
    module_values_free(entry->module, values);
    if (code) return code;
    struct table table = {.eos = entry->module->table, .self = instance.self};
    code = module_table_write(given, entry->module, &table);
    for (int k = 0; k < TABLE_COLUMNS; k++) mem_free(table.column[k]);
    instance_done(&instance);
    return code;
}

int module_table_command(const struct cli_given *given)
{
    if (given->n_word != 3)
        return cli_failed(status_fail(STATUS_CASE, "a law and a file are wanted: bulla module table LAW FILE"));
    if (comm_rank() != 0) return STATUS_OK;
    const char **sets = mem_new((size_t)given->n_option + 1, sizeof *sets);
    for (int i = 0, n = 0; i < given->n_option; i++)
        if (!strcmp(given->options[i]->name, "--set")) sets[n++] = given->values[i];
    int code = module_table_of_law(given, sets);
    mem_free(sets);
    return cli_failed(code);
}
