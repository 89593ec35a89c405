/* support.h - what the contract tests of modules share: opening a module by name and numbers,
 * comparisons with a scale, and judging what a suite has found. */
#ifndef SUPPORT_H
#define SUPPORT_H

#include "base/status.h"
#include "plug/instance.h"
#include "plug/registry.h"
#include "suite/contract.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static inline const struct bulla_module *support_module(const char *kind, const char *name)
{
    const struct registry_entry *entry = registry_find(kind, name);
    if (!entry) fail_msg("no %s '%s'", kind, name);
    return entry->module;
}

/* Opens with numbers in table order. */
static inline struct instance support_open(const struct bulla_module *module, const double *numbers)
{
    struct bulla_value values[32] = {{0}};
    for (unsigned i = 0; i < instance_param_count(module); i++) values[i].number = numbers[i];
    struct instance instance = {0};
    if (instance_open(module, values, &instance)) fail_msg("%s", status_text());
    return instance;
}

static inline struct instance support_open_preset(const struct bulla_module *module, const char *name)
{
    const struct bulla_preset *preset = module->presets;
    while (preset->name && strcmp(preset->name, name) != 0) preset++;
    if (!preset->name) fail_msg("no preset '%s' in %s", name, module->name);
    return support_open(module, preset->values);
}

/* |got - want| <= tolerance scale */
static inline void support_near(const char *what, double got, double want, double tolerance, double scale)
{
    if (!(fabs(got - want) <= tolerance * scale))
        fail_msg("%s: got %.17g, want %.17g, off by %.3g of %.3g", what, got, want, fabs(got - want) / scale,
                 tolerance);
}

/* Every check of a suite must hold; else the table. */
static inline void support_holds(const struct contract *contract)
{
    struct text text = {0};
    if (!contract_failed(contract)) return;
    contract_table(contract, &text);
    fail_msg("%s '%s' %s\n%s", contract->module->kind, contract->module->name, contract->preset, text.at);
}

static inline int support_start(void **state)
{
    (void)state;
    return registry_init();
}

static inline int support_stop(void **state)
{
    (void)state;
    registry_done();
    return 0;
}

#endif
