/* scene_material.c - materials, and the opening of the modules that a case names. */
#include "case/scene_draft.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"

#include <string.h>

static const struct key scene_material_law[] = {
    {.name = "type", .type = KEYS_CHOICE, .required = true, .doc = "The equation of state."},
    {0},
};

static const struct key scene_material_elastic[] = {
    {.name = "type", .type = KEYS_CHOICE, .required = true, .doc = "The elastic law."},
    {0},
};

static const struct keys_section scene_material_eos = {.name = "eos",
                                                       .doc = "An equation of state and its numbers.",
                                                       .keys = scene_material_law,
                                                       .selector = "type",
                                                       .kind = "eos"};

static const struct keys_section scene_material_constitutive = {.name = "constitutive",
                                                                .doc = "The elastic law of a solid and its numbers.",
                                                                .keys = scene_material_elastic,
                                                                .selector = "type",
                                                                .kind = "constitutive"};

static const struct key scene_material_transport[] = {
    {.name = "type", .type = KEYS_CHOICE, .required = true, .doc = "The law."},
    {0},
};

static const struct keys_section scene_material_viscosity = {.name = "viscosity",
                                                             .doc = "A law of viscosity and its numbers.",
                                                             .keys = scene_material_transport,
                                                             .selector = "type",
                                                             .kind = "viscosity",
                                                             .amount = "newtonian",
                                                             .amount_key = "mu"};

static const struct keys_section scene_material_conductivity = {.name = "conductivity",
                                                                .doc = "A law of heat conduction and its numbers.",
                                                                .keys = scene_material_transport,
                                                                .selector = "type",
                                                                .kind = "conductivity",
                                                                .amount = "constant",
                                                                .amount_key = "k"};

static const struct key scene_material_rows[] = {
    {.name = "eos",
     .type = KEYS_SECTION,
     .section = &scene_material_eos,
     .required = true,
     .doc = "The equation of state."},
    {.name = "constitutive",
     .type = KEYS_SECTION,
     .section = &scene_material_constitutive,
     .doc = "The elastic law, which makes the material a solid; its pressure is that of the equation of state."},
    {.name = "viscosity",
     .type = KEYS_SECTION,
     .section = &scene_material_viscosity,
     .doc = "Viscosity: a number with a unit (`0.89 mPa s`) for a constant one, or a law; without it the material has "
            "none."},
    {.name = "drag",
     .type = KEYS_NUMBER,
     .unit = "kg/m3/s",
     .max = KEYS_MOST,
     .fallback = "0",
     .doc = "Resistance k of the material against its motion, as in a porous medium (viscosity over permeability): a "
            "force -alpha k u, whose work is heat."},
    {.name = "conductivity",
     .type = KEYS_SECTION,
     .section = &scene_material_conductivity,
     .doc = "Conductivity of heat: a number with a unit (`0.607 W/m/K`) for a constant one, or a law; without it the "
            "material has none. Heat goes from cell to cell, and through interfaces to other materials that conduct."},
    {0},
};

const struct keys_section scene_material_keys = {.name = "material", .doc = "A material.", .keys = scene_material_rows};

static int scene_material_find(const struct scene *scene, const char *name)
{
    for (unsigned i = 0; i < scene->n_material; i++)
        if (strcmp(scene->material[i].name, name) == 0) return (int)i;
    return -1;
}

static const char *const *scene_material_names(struct draft *draft)
{
    const struct scene *scene = draft->scene;
    const char **names = tree_take(draft->keys.forest, (scene->n_material + 1) * sizeof *names);
    for (unsigned i = 0; i < scene->n_material; i++) names[i] = scene->material[i].name;
    return names;
}

int scene_material_index(struct draft *draft, const struct keys_value *value)
{
    const char *name = value->name ? value->name : value->text;
    if (!value->given && !value->name) return -1;
    int index = scene_material_find(draft->scene, name);
    if (index >= 0 || keys_at(draft->root, "materials")->count == 0) return index;
    keys_error(&draft->keys, value, "there is no material '%s'", name);
    diag_suggest(draft->keys.diag, name, scene_material_names(draft));
    return -1;
}

const char *scene_material_solid(const struct draft *draft)
{
    const struct keys_value *materials = keys_at(draft->root, "materials");
    for (unsigned i = 0; i < draft->scene->n_material; i++)
        if (scene_material_is_solid(draft, i)) return materials->list[i].name;
    return NULL;
}

bool scene_material_is_solid(const struct draft *draft, unsigned material)
{
    return keys_at(keys_at(draft->root, "materials")->list[material].map, "constitutive")->node != NULL;
}

void scene_material_open(struct draft *draft, const struct keys_value *value, struct instance *ret_instance)
{
    const struct keys_map *map = value->map;
    if (!map || !map->chosen || !map->chosen->module) return;
    const struct bulla_module *module = map->chosen->module;
    unsigned count = instance_param_count(module);
    struct bulla_value *values = mem_new(count + 1, sizeof *values);
    bool good = true;
    for (unsigned i = 0; i < count; i++) {
        const struct keys_value *param = keys_at(map, module->params[i].name);
        good &= param->given || !(param->node || param->key->required);
        values[i] = (struct bulla_value){.number = param->number, .text = param->text ? param->text : ""};
        if (module->params[i].type == BULLA_FILE && param->given && *param->text)
            values[i].text = scene_file(draft, param);
    }
    if (good && instance_open(module, values, ret_instance)) keys_error(&draft->keys, value, "%s", status_text());
    mem_free(values);
}

void scene_material(struct draft *draft)
{
    const struct keys_value *materials = keys_at(draft->root, "materials");
    struct scene *scene = draft->scene;
    if (!materials->node || materials->node->kind != TREE_MAP) return;
    if (materials->count > SCENE_MATERIALS)
        keys_error(&draft->keys, materials, "%u materials are more than %d", materials->count, SCENE_MATERIALS);
    if (materials->count == 0) keys_error(&draft->keys, materials, "at least one material is needed");
    for (unsigned i = 0; i < materials->count && scene->n_material < SCENE_MATERIALS; i++) {
        const struct keys_value *entry = &materials->list[i];
        struct scene_material *material = &scene->material[scene->n_material++];
        snprintf(material->name, SCENE_NAME, "%s", entry->name);
        if (!text_is_identifier(entry->name) || strlen(entry->name) > SCENE_NAME / 2)
            diag_error(draft->keys.diag, &materials->node->keys[i]->mark,
                       "materials: '%s' is no identifier (letters, digits and _, at most %d)", entry->name,
                       SCENE_NAME / 2);
        scene_material_open(draft, keys_at(entry->map, "eos"), &material->eos);
        scene_material_open(draft, keys_at(entry->map, "constitutive"), &material->constitutive);
        scene_material_open(draft, keys_at(entry->map, "viscosity"), &material->viscosity);
        scene_material_open(draft, keys_at(entry->map, "conductivity"), &material->conductivity);
        material->drag = entry->map ? keys_at(entry->map, "drag")->number : 0.0;
    }
}
