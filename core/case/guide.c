/* guide.c - see guide.h. Sections in the order of the file; one that contains itself, or stands
 * in several places, is described once. */
#include "case/guide.h"

#include "base/text.h"
#include "case/family.h"
#include "case/scalar.h"
#include "case/scene_draft.h"
#include "plug/instance.h"

#include <string.h>

enum { GUIDE_SECTIONS = 64 };

struct guide {
    struct forest *forest;
    struct text text;
    const struct keys_section *done[GUIDE_SECTIONS];
    unsigned n_done;
};

/* Several words as "a, b, c". */
static const char *guide_join(struct guide *guide, const char *const *words)
{
    const char *list = "";
    for (; *words; words++) list = tree_print(guide->forest, "%s%s`%s`", list, *list ? ", " : "", *words);
    return list;
}

static const char *guide_range(struct guide *guide, const struct key *key)
{
    bool low = key->min > -KEYS_MOST, high = key->max < KEYS_MOST;
    const char *least = key->min == KEYS_POSITIVE ? "0" : scalar_number(guide->forest, key->min);
    const char *above = key->min == KEYS_POSITIVE ? "above" : "from";
    if (key->min == 0 && key->max == 0) return "";
    if (key->min == key->max) return tree_print(guide->forest, ": %s", least);
    if (low && high)
        return tree_print(guide->forest, ", %s %s to %s", above, least, scalar_number(guide->forest, key->max));
    if (low) return tree_print(guide->forest, ", %s %s", above, least);
    return high ? tree_print(guide->forest, ", to %s", scalar_number(guide->forest, key->max)) : "";
}

/* "a length [m], above 0", "one of `a`, `b`", "list of ...". */
static const char *guide_kind(struct guide *guide, const struct key *key, const struct keys_section *section)
{
    struct forest *forest = guide->forest;
    bool selects = section->selector && strcmp(section->selector, key->name) == 0;
    const char *kind = scalar_wanted(forest, key);
    const char *const *names = selects ? family_names(forest, section) : NULL;
    if (selects && !*names) kind = tree_print(forest, "the name of a module of kind `%s`", section->kind);
    else if (selects) kind = tree_print(forest, "one of %s", guide_join(guide, names));
    else if (key->type == KEYS_CHOICE)
        kind = tree_print(forest, "one of %s", guide_join(guide, scalar_choices(forest, key->choices)));
    else if (key->type == KEYS_SECTION) kind = tree_print(forest, "[%s](#%s)", key->section->name, key->section->name);
    else if (key->type == KEYS_TREE) kind = key->section ? "a part of a case" : "any";
    else if (key->type == KEYS_EVERY) kind = "a time, or `N steps`";
    bool unit = key->unit && strcmp(key->unit, "1") != 0 && key->type != KEYS_EVERY;
    kind = tree_print(forest, "%s%s%s%s%s", kind, unit ? " [" : "", unit ? key->unit : "", unit ? "]" : "",
                      guide_range(guide, key));
    if (key->type == KEYS_VALUE) kind = tree_print(forest, "%s; or an expression of x, y, z, r, t", kind);
    if (key->many == KEYS_LIST) return tree_print(forest, "list: %s", kind);
    if (key->many == KEYS_NAMED) return tree_print(forest, "by name: %s", kind);
    return key->many == KEYS_ONE_OR_NAMED ? tree_print(forest, "%s; or a map of these by material", kind) : kind;
}

static void guide_rows(struct guide *guide, const struct keys_section *section)
{
    if (section->base) guide_rows(guide, section->base);
    for (const struct key *key = section->keys; key && key->name; key++) {
        const char *fallback = key->required ? "required" : key->fallback && *key->fallback != '{' ? key->fallback : "";
        text_add(&guide->text, "| `%s` | %s | %s | %s |\n", key->name, guide_kind(guide, key, section), fallback,
                 key->doc ? key->doc : "");
    }
    if (section->others)
        text_add(&guide->text, "| *NAME* | %s |  | %s |\n", guide_kind(guide, section->others, section),
                 section->others->doc);
}

static void guide_table(struct guide *guide, const struct keys_section *section)
{
    if ((!section->keys || !section->keys->name) && !section->base && !section->others) return;
    text_add(&guide->text, "\n| key | value | default | meaning |\n| --- | --- | --- | --- |\n");
    guide_rows(guide, section);
}

/* What a preset sets, key by key. */
static void guide_presets(struct guide *guide, const struct bulla_module *module)
{
    unsigned count = instance_param_count(module);
    const char *rule = "| --- | --- |";
    if (!module->presets || !module->presets->name) return;
    text_add(&guide->text, "\n| preset | what it is |");
    for (unsigned i = 0; i < count; i++) {
        text_add(&guide->text, " `%s` |", module->params[i].name);
        rule = tree_print(guide->forest, "%s --- |", rule);
    }
    text_add(&guide->text, "\n%s\n", rule);
    for (const struct bulla_preset *preset = module->presets; preset->name; preset++) {
        text_add(&guide->text, "| `%s` | %s |", preset->name, preset->doc ? preset->doc : "");
        for (unsigned i = 0; i < count; i++) {
            const char *value = family_preset(guide->forest, module, preset->name, module->params[i].name);
            text_add(&guide->text, " %s |", value ? value : "");
        }
        text_add(&guide->text, "\n");
    }
}

static void guide_module(struct guide *guide, const struct bulla_module *module)
{
    guide_presets(guide, module);
    if (module->cite && *module->cite) text_add(&guide->text, "\nSource: %s.\n", module->cite);
}

/* The cases of a section, each with the keys that it adds. */
static void guide_cases(struct guide *guide, const struct keys_section *section)
{
    for (const char *const *name = family_names(guide->forest, section); *name; name++) {
        const struct keys_section *one = family_find(guide->forest, section, *name);
        text_add(&guide->text, "\n**`%s: %s`** %s\n", section->selector, *name, one->doc ? one->doc : "");
        guide_table(guide, one);
        if (one->module) guide_module(guide, one->module);
        if (one->selector) guide_cases(guide, one);
    }
}

static void guide_section(struct guide *guide, const struct keys_section *section);

/* The sections that the keys of a section lead to. */
static void guide_below(struct guide *guide, const struct keys_section *section)
{
    if (section->base) guide_below(guide, section->base);
    for (const struct key *key = section->keys; key && key->name; key++)
        if (key->type == KEYS_SECTION) guide_section(guide, key->section);
    if (section->others && section->others->section) guide_section(guide, section->others->section);
    for (const char *const *name = section->selector ? family_names(guide->forest, section) : NULL; name && *name;
         name++)
        guide_below(guide, family_find(guide->forest, section, *name));
}

static void guide_section(struct guide *guide, const struct keys_section *section)
{
    for (unsigned i = 0; i < guide->n_done; i++)
        if (guide->done[i] == section) return;
    if (guide->n_done == GUIDE_SECTIONS) return;
    guide->done[guide->n_done++] = section;
    text_add(&guide->text, "\n## %s\n\n%s\n", section->name, section->doc ? section->doc : "");
    if (section->choose)
        text_add(&guide->text, "\nExactly one of the keys up to `%s` is given.\n",
                 section->keys[section->choose - 1].name);
    guide_table(guide, section);
    if (section->selector) guide_cases(guide, section);
    guide_below(guide, section);
}

char *guide_text(void)
{
    struct guide guide = {.forest = tree_forest_new()};
    struct text whole = {0};
    guide_section(&guide, &scene_root_keys);
    text_add(&whole, "# Keys of a case file\n\nMade by `bulla schema --markdown` from the tables that read cases and "
                     "from the loaded modules; [cases.md](cases.md) explains how cases work.\n\nSections:");
    for (unsigned i = 0; i < guide.n_done; i++)
        text_add(&whole, "%s[%s](#%s)", i ? ", " : " ", guide.done[i]->name, guide.done[i]->name);
    text_add(&whole, ".\n%s", guide.text.at);
    text_done(&guide.text);
    tree_forest_free(guide.forest);
    return whole.at;
}
