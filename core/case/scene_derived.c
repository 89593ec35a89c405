/* scene_derived.c - fields that modules make, by the names that a case gives them. They must be known before anything
 * names a field. */
#include "case/scene_draft.h"

#include "base/mem.h"
#include "base/text.h"

#include <string.h>

static const struct key scene_derived_rows[] = {
    {.name = "type", .type = KEYS_CHOICE, .required = true, .doc = "The module that makes the field."},
    {0},
};

const struct keys_section scene_derived_keys = {.name = "module-field",
                                                .doc = "A field that a module makes, and its numbers.",
                                                .keys = scene_derived_rows,
                                                .selector = "type",
                                                .kind = "field"};

/* The name of an output; none may be a field's already, or too long. */
static bool scene_derived_name(struct draft *draft, const struct keys_value *entry, const char *suffix,
                               char ret_name[SCENE_NAME])
{
    const char *name = tree_print(draft->keys.forest, "%s%s%s", entry->name, *suffix ? "_" : "", suffix);
    if (!text_is_identifier(name) || strlen(name) > SCENE_NAME / 2) {
        keys_error(&draft->keys, entry, "'%s' is no identifier (letters, digits and _, at most %d)", name,
                   SCENE_NAME / 2);
        return false;
    }
    if (scene_field_find(draft, name) || scene_peak_is(name)) {
        keys_error(&draft->keys, entry, "'%s' is a field already: call this one something else", name);
        return false;
    }
    strncpy(ret_name, name, SCENE_NAME - 1);
    return true;
}

static void scene_derived_read(struct draft *draft, const struct keys_value *entry)
{
    struct scene *scene = draft->scene;
    struct scene_derived derived = {0};
    scene_matter_open(draft, entry, &derived.law);
    if (!derived.law.module) return;
    const struct bulla_field *law = derived.law.module->table;
    bool good = true;
    for (unsigned k = 0; good && law->outputs[k].unit; k++)
        good = scene_derived_name(draft, entry, law->outputs[k].suffix, derived.names[k]);
    if (!good) {
        instance_done(&derived.law);
        return;
    }
    scene->derived = mem_grow(scene->derived, scene->n_derived, scene->n_derived + 1, sizeof *scene->derived);
    scene->derived[scene->n_derived++] = derived;
}

void scene_derived(struct draft *draft)
{
    const struct keys_value *fields = keys_at(draft->root, "fields");
    for (unsigned i = 0; i < fields->count; i++) scene_derived_read(draft, &fields->list[i]);
}
