/* scene_field.c - the names of fields, as cases, files and pictures use them. */
#include "case/scene_draft.h"

#include "base/mem.h"
#include "base/text.h"

#include <string.h>

static const char *const scene_field_plain[] = {"density",    "pressure",        "velocity",     "velocity_x",
                                                "velocity_y", "velocity_z",      "temperature",  "sound_speed",
                                                "mach",       "internal_energy", "total_energy", "vorticity",
                                                "schlieren",  "level",           "rank",         "cost",
                                                NULL};

static const char *const scene_field_by_material[] = {"alpha", "density", "temperature", "partial_density", NULL};

static const char *const scene_field_of_solids[] = {"stress_xx",     "stress_yy",  "stress_zz",  "stress_xy",
                                                    "stress_xz",     "stress_yz",  "sigma_max",  "sigma_min",
                                                    "sigma_shear",   "von_mises",  "stretch_xx", "stretch_yy",
                                                    "stretch_zz",    "stretch_xy", "stretch_xz", "stretch_yz",
                                                    "strain_energy", NULL};

static bool scene_field_in(const char *name, const char *const *names)
{
    for (; *names; names++)
        if (strcmp(*names, name) == 0) return true;
    return false;
}

/* What people write on paper. */
static const char *scene_field_of_symbol(const char *symbol)
{
    static const char *const symbols[][2] = {{"p", "pressure"},    {"P", "pressure"}, {"rho", "density"},
                                             {"u", "velocity"},    {"v", "velocity"}, {"T", "temperature"},
                                             {"c", "sound_speed"}, {"M", "mach"},     {"omega", "vorticity"}};
    for (size_t i = 0; i < sizeof symbols / sizeof *symbols; i++)
        if (strcmp(symbol, symbols[i][0]) == 0) return symbols[i][1];
    return NULL;
}

/* All names this scene has; NULL-terminated, in the forest. */
static const char *const *scene_field_names(struct draft *draft)
{
    const struct scene *scene = draft->scene;
    struct forest *forest = draft->keys.forest;
    unsigned count = 0;
    while (scene_field_plain[count]) count++;
    const char **names = tree_take(forest, (count + 4 * scene->n_material + 1) * sizeof *names);
    memcpy(names, scene_field_plain, count * sizeof *names);
    for (unsigned i = 0; i < scene->n_material; i++)
        for (unsigned k = 0; scene_field_by_material[k]; k++)
            names[count++] = tree_print(forest, "%s_%s", scene_field_by_material[k], scene->material[i].name);
    return names;
}

bool scene_field(struct draft *draft, const struct keys_value *value, char ret_name[SCENE_NAME])
{
    if (!value->given) return false;
    const char *const *names = scene_field_names(draft);
    if (scene_field_in(value->text, names) && strlen(value->text) < SCENE_NAME) {
        snprintf(ret_name, SCENE_NAME, "%s", value->text);
        return true;
    }
    if (scene_field_in(value->text, scene_field_of_solids)) {
        keys_error(&draft->keys, value, "'%s' is a field of solids, and this version computes fluids only",
                   value->text);
        return false;
    }
    keys_error(&draft->keys, value, "there is no field '%s'", value->text);
    const char *name = scene_field_of_symbol(value->text);
    if (name) diag_help(draft->keys.diag, "did you mean '%s'?", name);
    else diag_suggest(draft->keys.diag, value->text, names);
    return false;
}

bool scene_field_list(struct draft *draft, const struct keys_value *list, char (**ret_names)[SCENE_NAME],
                      unsigned *ret_count)
{
    char(*names)[SCENE_NAME] = mem_new(list->count + 1, sizeof *names);
    bool good = list->given;
    for (unsigned i = 0; i < list->count; i++) {
        good &= scene_field(draft, &list->list[i], names[i]);
        for (unsigned k = 0; k < i; k++)
            if (list->list[i].given && strcmp(names[i], names[k]) == 0)
                keys_error(&draft->keys, &list->list[i], "'%s' is listed twice", names[i]);
    }
    *ret_names = names;
    *ret_count = list->count;
    return good;
}
