/* scene_matter.c - what the readers of a case ask about its materials: which one a name means, what it is and can do;
 * and the opening of the module that a section names. What a material may say is in scene_material.c. */
#include "case/scene_draft.h"

#include "base/mem.h"
#include "base/status.h"
#include "bulla/inelastic.h"

#include <math.h>
#include <string.h>

static int scene_matter_find(const struct scene *scene, const char *name)
{
    for (unsigned i = 0; i < scene->n_material; i++)
        if (strcmp(scene->material[i].name, name) == 0) return (int)i;
    return -1;
}

static const char *const *scene_matter_names(struct draft *draft)
{
    const struct scene *scene = draft->scene;
    const char **names = tree_take(draft->keys.forest, (scene->n_material + 1) * sizeof *names);
    for (unsigned i = 0; i < scene->n_material; i++) names[i] = scene->material[i].name;
    return names;
}

int scene_matter_index(struct draft *draft, const struct keys_value *value)
{
    const char *name = value->name ? value->name : value->text;
    if (!value->given && !value->name) return -1;
    int index = scene_matter_find(draft->scene, name);
    if (index >= 0 || keys_at(draft->root, "materials")->count == 0) return index;
    keys_error(&draft->keys, value, "there is no material '%s'", name);
    diag_suggest(draft->keys.diag, name, scene_matter_names(draft));
    return -1;
}

const char *scene_matter_solid(const struct draft *draft)
{
    const struct keys_value *materials = keys_at(draft->root, "materials");
    for (unsigned i = 0; i < draft->scene->n_material; i++)
        if (scene_matter_is_solid(draft, i)) return materials->list[i].name;
    return NULL;
}

bool scene_matter_is_solid(const struct draft *draft, unsigned material)
{
    return keys_at(keys_at(draft->root, "materials")->list[material].map, "constitutive")->node != NULL;
}

unsigned scene_matter_strength(const struct draft *draft)
{
    unsigned known = 0;
    for (unsigned i = 0; i < draft->scene->n_material; i++) {
        const struct instance *plastic = &draft->scene->material[i].plastic;
        if (!plastic->module) continue;
        const struct bulla_inelastic *law = plastic->module->table;
        unsigned here = law->needs(plastic->self) & BULLA_INELASTIC_STRAIN ? 2 : 1;
        known = here > known ? here : known;
    }
    return known;
}

bool scene_matter_branched(const struct draft *draft)
{
    bool any = false;
    for (unsigned i = 0; i < draft->scene->n_material; i++) any = any || draft->scene->material[i].n_branch > 0;
    return any;
}

/* Has some material such a key? */
static bool scene_matter_has(const struct draft *draft, const char *key)
{
    const struct keys_value *materials = keys_at(draft->root, "materials");
    for (unsigned i = 0; i < materials->count; i++)
        if (materials->list[i].map && keys_at(materials->list[i].map, key)->node) return true;
    return false;
}

bool scene_matter_conducts(const struct draft *draft)
{
    return scene_matter_has(draft, "conductivity");
}

bool scene_matter_breaks(const struct draft *draft)
{
    return scene_matter_has(draft, "damage");
}

bool scene_matter_viscous(const struct draft *draft)
{
    return scene_matter_has(draft, "viscosity");
}

void scene_matter_open(struct draft *draft, const struct keys_value *value, struct instance *ret_instance)
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

/* Did the case say this number of a section, or a preset that has it? Defaults stand where their section does. */
static bool scene_matter_says(const struct keys_value *section, const char *key)
{
    const struct keys_value *value = keys_at(section->map, key);
    const struct mark *there = &section->map->node->mark, *here = value->node ? &value->node->mark : there;
    return tree_get(section->map->node, "preset") || here->line != there->line || here->column != there->column;
}

void scene_matter_warm(struct draft *draft, const struct keys_value *asking, const struct scene_material *material,
                       const char *what)
{
    const struct keys_value *entry = &keys_at(draft->root, "materials")->list[material - draft->scene->material];
    const struct keys_value *eos = keys_at(entry->map, "eos");
    if (!material->eos.module || !eos->map) return;
    int row = instance_param_find(material->eos.module, "cv");
    if (row < 0 || isnan(material->eos.module->params[row].fallback) || scene_matter_says(eos, "cv")) return;
    keys_error(&draft->keys, asking, "'%s' looks at temperatures, and nothing is said of the specific heat of '%s'",
               what, material->name);
    diag_help(draft->keys.diag, "give 'cv' in its 'eos', or set 'melting-temperature: 0' where the law has that key");
}
