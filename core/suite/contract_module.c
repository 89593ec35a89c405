/* contract_module.c - see contract_module.h. */
#include "suite/contract_module.h"

#include "base/mem.h"
#include "base/status.h"
#include "case/unit.h"
#include "plug/instance.h"
#include "suite/contract_suite.h"
#include "suite/module_values.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The suite on one set of values. */
static int contract_module_try(struct contract *contract, const struct bulla_value *values, const char *preset)
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

static int contract_module_presets(struct contract *contract, struct bulla_value *values)
{
    const struct bulla_module *module = contract->module;
    for (const struct bulla_preset *preset = module->presets; preset && preset->name; preset++) {
        for (unsigned i = 0; i < instance_param_count(module); i++)
            if (module->params[i].type == BULLA_NUMBER) values[i].number = preset->values[i];
        TRY(contract_module_try(contract, values, preset->name));
    }
    return STATUS_OK;
}

/* The ends of each range, one at a time: the table has promised that they may be given. */
static void contract_module_ends(struct contract *contract, struct bulla_value *values)
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
static struct bulla_value *contract_module_other(const struct bulla_module *module, const struct bulla_value *values)
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
static void contract_module_apart(struct contract *contract, const struct bulla_value *values)
{
    const struct bulla_module *module = contract->module;
    struct bulla_value *other = contract_module_other(module, values);
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
    module_values_free(module, other);
}

static void contract_module_units(struct contract *contract)
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

static int contract_module_all(struct contract *contract, const char *const *sets, struct bulla_value *values)
{
    const struct bulla_module *module = contract->module;
    bool presets = module->presets && module->presets->name && !(sets && *sets);
    const char *missing = module_values_missing(module, values);
    if (!presets) TRY(module_values_check(module, values));
    if (!missing) TRY(contract_module_try(contract, values, presets ? "defaults" : ""));
    if (presets) TRY(contract_module_presets(contract, values));
    contract->preset = "";
    contract_module_units(contract);
    contract_module_ends(contract, values);
    contract_doing(contract, "two instances");
    if (instance_param_count(module)) contract_module_apart(contract, values);
    return STATUS_OK;
}

int contract_module_run(struct contract *contract, const char *const *sets)
{
    struct bulla_value *values;
    contract->preset = "";
    TRY(module_values(contract->module, sets, &values));
    int code = contract_module_all(contract, sets, values);
    module_values_free(contract->module, values);
    return code;
}
