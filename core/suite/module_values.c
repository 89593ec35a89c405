/* module_values.c - see module_values.h. */
#include "suite/module_values.h"

#include "base/mem.h"
#include "base/status.h"
#include "case/unit.h"
#include "plug/instance.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The values that a case without keys would give; NaN and NULL where a key is required. */
static struct bulla_value *module_values_defaults(const struct bulla_module *module)
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

void module_values_free(const struct bulla_module *module, struct bulla_value *values)
{
    for (unsigned i = 0; i < instance_param_count(module); i++) mem_free((char *)values[i].text);
    mem_free(values);
}

const char *module_values_missing(const struct bulla_module *module, const struct bulla_value *values)
{
    for (unsigned i = 0; i < instance_param_count(module); i++) {
        bool number = module->params[i].type == BULLA_NUMBER;
        if (number ? isnan(values[i].number) : !values[i].text) return module->params[i].name;
    }
    return NULL;
}

static int module_values_number(const struct bulla_param *row, const char *text, double *ret_number)
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

static int module_values_preset(const struct bulla_module *module, const char *name, struct bulla_value *values)
{
    const struct bulla_preset *preset = module->presets;
    while (preset && preset->name && strcmp(preset->name, name) != 0) preset++;
    if (!preset || !preset->name)
        return status_fail(STATUS_CASE, "--set preset=%s: %s '%s' has no such preset", name, module->kind,
                           module->name);
    for (unsigned i = 0; i < instance_param_count(module); i++)
        if (module->params[i].type == BULLA_NUMBER && !isnan(preset->values[i])) values[i].number = preset->values[i];
    return STATUS_OK;
}

static int module_values_set(const struct bulla_module *module, const char *setting, struct bulla_value *values)
{
    char name[64];
    size_t length = strcspn(setting, "=");
    snprintf(name, sizeof name, "%.*s", (int)length, setting);
    int at = instance_param_find(module, name);
    if (setting[length] != '=') return status_fail(STATUS_CASE, "--set %s: NAME=VALUE is wanted", setting);
    if (at < 0 && !strcmp(name, "preset")) return module_values_preset(module, setting + length + 1, values);
    if (at < 0)
        return status_fail(STATUS_CASE, "--set %s: %s '%s' has no such parameter", setting, module->kind, module->name);
    const struct bulla_param *row = &module->params[at];
    if (row->type == BULLA_NUMBER) return module_values_number(row, setting + length + 1, &values[at].number);
    mem_free((char *)values[at].text);
    values[at].text = mem_text(setting + length + 1);
    return STATUS_OK;
}

int module_values_check(const struct bulla_module *module, const struct bulla_value *values)
{
    const char *missing = module_values_missing(module, values);
    if (!missing) return STATUS_OK;
    return status_fail(STATUS_CASE, "%s '%s': parameter '%s' has no default; give one with --set %s=VALUE",
                       module->kind, module->name, missing, missing);
}

int module_values(const struct bulla_module *module, const char *const *sets, struct bulla_value **ret_values)
{
    struct bulla_value *values = module_values_defaults(module);
    int code = STATUS_OK;
    for (; sets && *sets && !code; sets++) code = module_values_set(module, *sets, values);
    if (code) module_values_free(module, values);
    else *ret_values = values;
    return code;
}
