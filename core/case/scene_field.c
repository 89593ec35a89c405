/* scene_field.c - the names of fields, as cases, files and pictures use them. */
#include "case/scene_draft.h"

#include "base/mem.h"
#include "base/text.h"

#include <string.h>

static const struct scene_field scene_field_plain[] = {
    {"density", "kg/m3", SCENE_FIELD_POSITIVE},
    {"pressure", "Pa", 0},
    {"velocity", "m/s", SCENE_FIELD_VECTOR | SCENE_FIELD_VANISHING},
    {"velocity_x", "m/s", SCENE_FIELD_VANISHING},
    {"velocity_y", "m/s", SCENE_FIELD_VANISHING},
    {"velocity_z", "m/s", SCENE_FIELD_VANISHING},
    {"temperature", "K", SCENE_FIELD_POSITIVE},
    {"sound_speed", "m/s", SCENE_FIELD_POSITIVE},
    {"mach", "1", SCENE_FIELD_VANISHING},
    {"internal_energy", "J/kg", 0},
    {"total_energy", "J/m3", 0},
    {"vorticity", "1/s", SCENE_FIELD_VECTOR | SCENE_FIELD_VANISHING},
    {"schlieren", "1", SCENE_FIELD_FRACTION},
    {"level", "1", 0},
    {"rank", "1", 0},
    {"cost", "1", SCENE_FIELD_POSITIVE},
};

/* Followed by _ and the name of a material. */
static const struct scene_field scene_field_by_material[] = {
    {"alpha", "1", SCENE_FIELD_FRACTION},
    {"density", "kg/m3", SCENE_FIELD_VANISHING},
    {"temperature", "K", SCENE_FIELD_VANISHING},
    {"partial_density", "kg/m3", SCENE_FIELD_VANISHING},
};

enum {
    SCENE_FIELD_PLAIN = sizeof scene_field_plain / sizeof *scene_field_plain,
    SCENE_FIELD_EACH = sizeof scene_field_by_material / sizeof *scene_field_by_material
};

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

const struct scene_field *scene_field_all(struct draft *draft)
{
    const struct scene *scene = draft->scene;
    struct forest *forest = draft->keys.forest;
    struct scene_field *list =
        tree_take(forest, (SCENE_FIELD_PLAIN + SCENE_FIELD_EACH * scene->n_material + 1) * sizeof *list);
    unsigned count = SCENE_FIELD_PLAIN;
    memcpy(list, scene_field_plain, sizeof scene_field_plain);
    for (unsigned i = 0; i < scene->n_material; i++)
        for (unsigned k = 0; k < SCENE_FIELD_EACH; k++) {
            list[count] = scene_field_by_material[k];
            list[count++].name = tree_print(forest, "%s_%s", scene_field_by_material[k].name, scene->material[i].name);
        }
    return list;
}

static const char *const *scene_field_list_names(struct forest *forest, const struct scene_field *fields, unsigned n)
{
    const char **names = tree_take(forest, (n + 1) * sizeof *names);
    for (unsigned i = 0; i < n; i++) names[i] = fields[i].name;
    return names;
}

const char *const *scene_field_always(struct forest *forest)
{
    return scene_field_list_names(forest, scene_field_plain, SCENE_FIELD_PLAIN);
}

const char *const *scene_field_each(struct forest *forest)
{
    return scene_field_list_names(forest, scene_field_by_material, SCENE_FIELD_EACH);
}

/* All names this scene has; NULL-terminated, in the forest. */
static const char *const *scene_field_names(struct draft *draft)
{
    const struct scene_field *all = scene_field_all(draft);
    unsigned count = 0;
    while (all[count].name) count++;
    const char **names = tree_take(draft->keys.forest, (count + 1) * sizeof *names);
    for (unsigned i = 0; i < count; i++) names[i] = all[i].name;
    return names;
}

const struct scene_field *scene_field_find(struct draft *draft, const char *name)
{
    for (const struct scene_field *field = scene_field_all(draft); field->name; field++)
        if (strcmp(field->name, name) == 0) return field;
    return NULL;
}

const char *scene_field_constant(struct draft *draft, const char *name)
{
    const struct scene *scene = draft->scene;
    bool one = scene->n_material == 1, y = strcmp(name, "velocity_y") == 0, z = strcmp(name, "velocity_z") == 0;
    if (strcmp(name, "level") == 0) return "the same in all cells of a level";
    if (strcmp(name, "rank") == 0) return "a matter of how many ranks compute, on which results do not depend";
    if ((y && scene->dim < 2) || (z && scene->dim < 3)) return "0 everywhere: the domain has no such axis";
    if (strcmp(name, "vorticity") == 0 && scene->dim == 1) return "0 everywhere: the domain has one axis";
    if (one && (strcmp(name, "cost") == 0 || strncmp(name, "alpha_", 6) == 0))
        return "1 everywhere: there is one material";
    return NULL;
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
