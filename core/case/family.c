/* family.c - see family.h. */
#include "case/family.h"

#include "base/mem.h"
#include "base/text.h"
#include "plug/instance.h"
#include "plug/registry.h"

#include <math.h>
#include <string.h>

static const char *family_number(struct forest *forest, double value)
{
    struct text text = {0};
    text_double(&text, value);
    const char *kept = tree_print(forest, "%s", text.at);
    text_done(&text);
    return kept;
}

/* A row of a module's table as a key of ours. */
static struct key family_key(struct forest *forest, const struct bulla_module *module, const struct bulla_param *param)
{
    struct key key = {.name = param->name, .doc = param->doc};
    if (param->type == BULLA_NUMBER) {
        key.type = KEYS_NUMBER;
        key.unit = param->unit ? param->unit : "1";
        key.min = isfinite(param->min) ? param->min : -KEYS_MOST;
        key.max = isfinite(param->max) ? param->max : KEYS_MOST;
        key.required = isnan(param->fallback);
        if (!key.required) key.fallback = family_number(forest, param->fallback);
    } else if (param->type == BULLA_CHOICE) {
        key.type = KEYS_CHOICE;
        key.choices = param->choices;
        key.fallback = tree_print(forest, "%.*s", (int)strcspn(param->choices, "|"), param->choices);
    } else {
        key.type = KEYS_TEXT;
        key.required = param->choices == NULL;
    }
    if (module->presets && key.type == KEYS_NUMBER) key.doc = tree_print(forest, "%s; set by `preset` too", param->doc);
    return key;
}

static const char *family_preset_names(struct forest *forest, const struct bulla_preset *presets)
{
    const char *names = presets->name;
    for (presets++; presets->name; presets++) names = tree_print(forest, "%s|%s", names, presets->name);
    return names;
}

static const struct keys_section *family_of_module(struct forest *forest, const struct bulla_module *module)
{
    unsigned count = instance_param_count(module), at = 0;
    struct key *keys = tree_take(forest, (count + 2) * sizeof *keys);
    if (module->presets && module->presets->name)
        keys[at++] = (struct key){.name = "preset",
                                  .type = KEYS_CHOICE,
                                  .choices = family_preset_names(forest, module->presets),
                                  .doc = "A named set of values; keys given beside it win."};
    for (unsigned i = 0; i < count; i++) keys[at++] = family_key(forest, module, &module->params[i]);
    struct keys_section *section = tree_take(forest, sizeof *section);
    *section = (struct keys_section){.name = module->name, .doc = module->doc, .keys = keys, .module = module};
    return section;
}

static const struct keys_section *family_own(const struct keys_section *section, const char *name)
{
    for (const struct keys_section *const *at = section->cases; at && *at; at++)
        if (strcmp((*at)->name, name) == 0) return *at;
    return NULL;
}

const struct keys_section *family_find(struct forest *forest, const struct keys_section *section, const char *name)
{
    const struct keys_section *own = family_own(section, name);
    if (own) return own;
    const struct registry_entry *entry = section->kind ? registry_find(section->kind, name) : NULL;
    return entry ? family_of_module(forest, entry->module) : NULL;
}

/* Names of the section's own cases, then these. */
static const char *const *family_list(struct forest *forest, const struct keys_section *section,
                                      const char *const *others)
{
    unsigned count = 0, own = 0;
    while (section->cases && section->cases[own]) own++;
    while (others[count]) count++;
    const char **names = tree_take(forest, (own + count + 1) * sizeof *names);
    for (unsigned i = 0; i < own; i++) names[i] = section->cases[i]->name;
    for (unsigned i = 0; i < count; i++) names[own + i] = tree_print(forest, "%s", others[i]);
    return names;
}

const char *const *family_names(struct forest *forest, const struct keys_section *section)
{
    static const char *const none[] = {NULL};
    return family_list(forest, section, section->kind ? registry_names(section->kind) : none);
}

const char *const *family_names_for(struct forest *forest, const struct keys_section *section, const char *name)
{
    const char *const only[] = {family_own(section, name) ? NULL : name, NULL};
    bool there = !only[0] || (section->kind && registry_find(section->kind, name));
    return there ? family_list(forest, section, only) : family_names(forest, section);
}

/* The word with this number in "a|b|c"; NULL: there is none. */
static const char *family_word(struct forest *forest, const char *choices, double number)
{
    for (double at = 0.0; choices; at += 1.0, choices = strchr(choices, '|'), choices += choices ? 1 : 0)
        if (at >= number) return tree_print(forest, "%.*s", (int)strcspn(choices, "|"), choices);
    return NULL;
}

const char *family_preset(struct forest *forest, const struct bulla_module *module, const char *preset, const char *key)
{
    int row = instance_param_find(module, key);
    const struct bulla_preset *at = module->presets;
    if (row < 0 || !at) return NULL;
    while (at->name && strcmp(at->name, preset) != 0) at++;
    const struct bulla_param *param = &module->params[row];
    if (!at->name || isnan(at->values[row]) || param->type == BULLA_TEXT || param->type == BULLA_FILE) return NULL;
    return param->type == BULLA_CHOICE ? family_word(forest, param->choices, at->values[row])
                                       : family_number(forest, at->values[row]);
}
