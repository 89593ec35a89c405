/* scene_field_name.c - a field that a case names, or writes down as an expression. */
#include "case/scene_draft.h"

#include "base/mem.h"

#include <stdio.h>
#include <string.h>

static bool scene_field_name_in(const char *name, const char *const *names)
{
    for (; *names; names++)
        if (strcmp(*names, name) == 0) return true;
    return false;
}

/* What people write on paper. */
static const char *scene_field_name_of_symbol(const char *symbol)
{
    static const char *const symbols[][2] = {{"p", "pressure"},    {"P", "pressure"}, {"rho", "density"},
                                             {"u", "velocity"},    {"v", "velocity"}, {"T", "temperature"},
                                             {"c", "sound_speed"}, {"M", "mach"},     {"omega", "vorticity"}};
    for (size_t i = 0; i < sizeof symbols / sizeof *symbols; i++)
        if (strcmp(symbol, symbols[i][0]) == 0) return symbols[i][1];
    return NULL;
}

/* All names this scene has; NULL-terminated, in the forest. */
static const char *const *scene_field_name_all(struct draft *draft)
{
    const struct scene_field *all = scene_field_all(draft);
    unsigned count = 0;
    while (all[count].name) count++;
    const char **names = tree_take(draft->keys.forest, (count + 1) * sizeof *names);
    for (unsigned i = 0; i < count; i++) names[i] = all[i].name;
    return names;
}

bool scene_field_name(struct draft *draft, const struct keys_value *value, char ret_name[SCENE_NAME])
{
    if (!value->given) return false;
    if (scene_formula_is(value)) return scene_formula(draft, value, NULL, ret_name);
    const char *const *names = scene_field_name_all(draft);
    bool known = scene_field_name_in(value->text, names) || scene_peak_find(draft, value->text, names);
    if (known && strlen(value->text) < SCENE_NAME) {
        snprintf(ret_name, SCENE_NAME, "%s", value->text);
        return true;
    }
    if (scene_field_miss(draft, value)) return false;
    keys_error(&draft->keys, value, "there is no field '%s'", value->text);
    const char *name = scene_field_name_of_symbol(value->text);
    if (name) diag_help(draft->keys.diag, "did you mean '%s'?", name);
    else diag_suggest(draft->keys.diag, value->text, names);
    return false;
}

bool scene_field_name_list(struct draft *draft, const struct keys_value *list, char (**ret_names)[SCENE_NAME],
                           unsigned *ret_count)
{
    char(*names)[SCENE_NAME] = mem_new(list->count + 1, sizeof *names);
    bool good = list->given;
    for (unsigned i = 0; i < list->count; i++) {
        bool known = scene_field_name(draft, &list->list[i], names[i]); /* else it has no name to compare */
        for (unsigned k = 0; known && k < i; k++)
            if (strcmp(names[i], names[k]) == 0)
                keys_error(&draft->keys, &list->list[i], "'%s' is listed twice", names[i]);
        good &= known;
    }
    *ret_names = names;
    *ret_count = list->count;
    return good;
}
