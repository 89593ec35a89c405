/* contract_module.c - see contract_module.h. */
#include "app/contract_module.h"

#include "app/contract_suite.h"
#include "base/mem.h"
#include "base/status.h"
#include "case/unit.h"
#include "plug/instance.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The values that a case without keys would give; NaN and NULL where a key is required. */
static struct bulla_value *module_defaults(const struct bulla_module *module)
{
    unsigned count = instance_param_count(module);
    struct bulla_value *values = mem_new(count + 1, sizeof *values);
    for (unsigned i = 0; i < count; i++) {
        const struct bulla_param *row = &module->params[i];
        if (row->type == BULLA_NUMBER) values[i].number = row->fallback;
        else if (row->type != BULLA_CHOICE) values[i].text = mem_text(row->choices);
        else values[i].text = mem_text_n(row->choices, strcspn(row->choices, "|"));
    }
    return values;
}

static void module_forget(const struct bulla_module *module, struct bulla_value *values)
{
    for (unsigned i = 0; i < instance_param_count(module); i++) mem_free((char *)values[i].text);
    mem_free(values);
}

/* The first parameter that has no value, or NULL. */
static const char *module_missing(const struct bulla_module *module, const struct bulla_value *values)
{
    for (unsigned i = 0; i < instance_param_count(module); i++) {
        bool number = module->params[i].type == BULLA_NUMBER;
        if (number ? isnan(values[i].number) : !values[i].text) return module->params[i].name;
    }
    return NULL;
}

static int module_number(const struct bulla_param *row, const char *text, double *ret_number)
{
    struct unit unit, wanted;
    char bad[32], words[96];
    if (!unit_parse(row->unit, &wanted, bad)) return status_fail(STATUS_CASE, "%s has no known unit", row->name);
    if (unit_quantity(text, ret_number, &unit, bad) != UNIT_FINE)
        return status_fail(STATUS_CASE, "--set %s=%s: '%s' is no quantity", row->name, text, text);
    bool bare = text[strcspn(text, "abcdfghijklmnopqrstuvwxyzABCDFGHIJKLMNOPQRSTUVWXYZ%")] == '\0';
    if (!bare && !unit_same(&unit, &wanted))
        return status_fail(STATUS_CASE, "--set %s=%s: %s is wanted", row->name, text,
                           unit_kind(&wanted, words, sizeof words));
    if (*ret_number >= row->min && *ret_number <= row->max) return STATUS_OK;
    return status_fail(STATUS_CASE, "--set %s=%s: allowed is %g to %g", row->name, text, row->min, row->max);
}

static int module_set(const struct bulla_module *module, const char *setting, struct bulla_value *values)
{
    char name[64];
    size_t length = strcspn(setting, "=");
    snprintf(name, sizeof name, "%.*s", (int)length, setting);
    int at = instance_param_find(module, name);
    if (setting[length] != '=') return status_fail(STATUS_CASE, "--set %s: NAME=VALUE is wanted", setting);
    if (at < 0)
        return status_fail(STATUS_CASE, "--set %s: %s '%s' has no such parameter", setting, module->kind, module->name);
    const struct bulla_param *row = &module->params[at];
    if (row->type == BULLA_NUMBER) return module_number(row, setting + length + 1, &values[at].number);
    mem_free((char *)values[at].text);
    values[at].text = mem_text(setting + length + 1);
    return STATUS_OK;
}

/* The suite on one set of values. */
static int module_try(struct contract *contract, const struct bulla_value *values, const char *preset)
{
    struct instance instance = {0};
    TRY(instance_open(contract->module, values, &instance));
    contract->self = instance.self;
    contract->preset = preset;
    contract_suite_run(contract);
    instance_done(&instance);
    contract->self = NULL;
    return STATUS_OK;
}

static int module_presets(struct contract *contract, struct bulla_value *values)
{
    const struct bulla_module *module = contract->module;
    for (const struct bulla_preset *preset = module->presets; preset && preset->name; preset++) {
        for (unsigned i = 0; i < instance_param_count(module); i++)
            if (module->params[i].type == BULLA_NUMBER) values[i].number = preset->values[i];
        TRY(module_try(contract, values, preset->name));
    }
    return STATUS_OK;
}

/* The ends of each range, one at a time: the table has promised that they may be given. */
static void module_ends(struct contract *contract, struct bulla_value *values)
{
    const struct bulla_module *module = contract->module;
    contract_doing(contract, "ends of parameter ranges");
    for (unsigned i = 0; i < 2 * instance_param_count(module); i++) {
        const struct bulla_param *row = &module->params[i / 2];
        if (row->type != BULLA_NUMBER) continue;
        double kept = values[i / 2].number;
        values[i / 2].number = i % 2 ? row->max : row->min;
        struct instance instance = {0};
        bool open = instance_open(module, values, &instance) == STATUS_OK;
        bool reason = !strstr(status_text(), "gives no reason");
        contract_begin(contract, "ends of parameter ranges are taken, or refused with a reason", 0.0);
        contract_error(contract, !(open || reason), "%s = %g", row->name, values[i / 2].number);
        instance_done(&instance);
        values[i / 2].number = kept;
    }
}

/* Other values than these: the last preset, or ends of ranges. */
static struct bulla_value *module_other(const struct bulla_module *module, const struct bulla_value *values)
{
    unsigned count = instance_param_count(module);
    struct bulla_value *other = mem_new(count + 1, sizeof *other);
    const struct bulla_preset *preset = module->presets;
    while (preset && preset->name && preset[1].name) preset++;
    for (unsigned i = 0; i < count; i++) {
        const struct bulla_param *row = &module->params[i];
        bool low = values[i].number == row->min;
        other[i].text = mem_text(values[i].text);
        other[i].number = low ? row->max : row->min;
        if (preset && preset->name && preset != module->presets) other[i].number = preset->values[i];
    }
    return other;
}

/* What one instance says before, beside and after another with other values: `open` may leave nothing in globals. */
static void module_apart(struct contract *contract, const struct bulla_value *values)
{
    const struct bulla_module *module = contract->module;
    struct bulla_value *other = module_other(module, values);
    struct instance one = {0}, two = {0};
    double said[3][CONTRACT_PROBE];
    bool both = instance_open(module, values, &one) == STATUS_OK;
    contract->self = one.self;
    if (both) contract_suite_probe(contract, said[0]);
    both = both && instance_open(module, other, &two) == STATUS_OK;
    if (both) {
        contract_suite_probe(contract, said[1]);
        instance_done(&two);
        contract_suite_probe(contract, said[2]);
        contract_begin(contract, "instances with other values do not touch each other", 0.0);
        for (int i = 0; i < CONTRACT_PROBE; i++)
            contract_error(contract, !contract_same(said[0][i], said[1][i]) || !contract_same(said[0][i], said[2][i]),
                           "%.9g alone, %.9g beside another, %.9g after it", said[0][i], said[1][i], said[2][i]);
    }
    instance_done(&one);
    contract->self = NULL;
    module_forget(module, other);
}

static void module_units(struct contract *contract)
{
    for (unsigned i = 0; i < instance_param_count(contract->module); i++) {
        const struct bulla_param *row = &contract->module->params[i];
        struct unit unit;
        char bad[32];
        if (row->type != BULLA_NUMBER) continue;
        bool known = unit_parse(row->unit, &unit, bad);
        bool plain = known && unit.factor == 1.0 && unit.decimal == 0 && unit.offset == 0.0;
        contract_begin(contract, "parameters have SI units", 0.0);
        contract_error(contract, !plain, "%s in '%s'%s", row->name, row->unit, known ? ": not an SI unit" : "");
    }
}

static int module_all(struct contract *contract, const char *const *sets, struct bulla_value *values)
{
    const struct bulla_module *module = contract->module;
    bool presets = module->presets && module->presets->name && !(sets && *sets);
    for (; sets && *sets; sets++) TRY(module_set(module, *sets, values));
    const char *missing = module_missing(module, values);
    if (missing && !presets)
        return status_fail(STATUS_CASE, "%s '%s': parameter '%s' has no default; give one with --set %s=VALUE",
                           module->kind, module->name, missing, missing);
    if (!missing) TRY(module_try(contract, values, presets ? "defaults" : ""));
    if (presets) TRY(module_presets(contract, values));
    contract->preset = "";
    module_units(contract);
    module_ends(contract, values);
    contract_doing(contract, "two instances");
    if (instance_param_count(module)) module_apart(contract, values);
    return STATUS_OK;
}

int contract_module_run(struct contract *contract, const char *const *sets)
{
    struct bulla_value *values = module_defaults(contract->module);
    contract->preset = "";
    int code = module_all(contract, sets, values);
    module_forget(contract->module, values);
    return code;
}
