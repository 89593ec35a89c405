/* scene_material.c - materials, and the opening of the modules that a case names. */
#include "case/scene_draft.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "bulla/constitutive.h"
#include "bulla/inelastic.h"

#include <math.h>
#include <string.h>

static const struct key scene_material_law[] = {
    {.name = "type", .type = KEYS_CHOICE, .required = true, .doc = "The equation of state."},
    {0},
};

static const struct key scene_material_elastic[] = {
    {.name = "type", .type = KEYS_CHOICE, .required = true, .doc = "The elastic law."},
    {0},
};

static const struct key scene_material_inelastic[] = {
    {.name = "type", .type = KEYS_CHOICE, .required = true, .doc = "The law of its strength."},
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

static const struct keys_section scene_material_plastic = {.name = "plastic",
                                                           .doc = "The strength of a solid and its numbers.",
                                                           .keys = scene_material_inelastic,
                                                           .selector = "type",
                                                           .kind = "inelastic"};
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
    {.name = "plastic",
     .type = KEYS_SECTION,
     .section = &scene_material_plastic,
     .doc = "The strength of a solid: stresses beyond it flow off, and their work is heat. Without it the solid is "
            "elastic."},
    {.name = "viscoelastic",
     .type = KEYS_SECTION,
     .many = KEYS_LIST,
     .section = &scene_branch_keys,
     .doc = "Maxwell branches of a solid, whose stresses add to that of its elastic law and relax."},
    {.name = "damage",
     .type = KEYS_SECTION,
     .section = &scene_damage_keys,
     .doc = "How a solid breaks: its elastic energy falls to (1 - D)^2 as its damage D goes from 0 to 1. Without it "
            "the solid "
            "never does."},
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

unsigned scene_material_strength(const struct draft *draft)
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

bool scene_material_branched(const struct draft *draft)
{
    bool any = false;
    for (unsigned i = 0; i < draft->scene->n_material; i++) any = any || draft->scene->material[i].n_branch > 0;
    return any;
}

/* Has some material such a key? */
static bool scene_material_has(const struct draft *draft, const char *key)
{
    const struct keys_value *materials = keys_at(draft->root, "materials");
    for (unsigned i = 0; i < materials->count; i++)
        if (materials->list[i].map && keys_at(materials->list[i].map, key)->node) return true;
    return false;
}

bool scene_material_conducts(const struct draft *draft)
{
    return scene_material_has(draft, "conductivity");
}

bool scene_material_breaks(const struct draft *draft)
{
    return scene_material_has(draft, "damage");
}

bool scene_material_viscous(const struct draft *draft)
{
    return scene_material_has(draft, "viscosity");
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

/* Number of a parameter of a law; NAN: it has none of that name. */
static double scene_material_number(const struct instance *law, const char *name)
{
    int row = instance_param_find(law->module, name);
    return row < 0 ? (double)NAN : law->values[row].number;
}

/* The strength of an unstrained body at rest, at 1 bar, and what its law would know of its density. */
static double scene_material_yield(const struct scene_material *material, double rho)
{
    const struct bulla_inelastic *law = material->plastic.module->table;
    double none = 0.0, p = 101325.0, T = 300.0, Y;
    rho = rho > 0.0 ? rho : 1000.0;
    law->strength(material->plastic.self, 1, &none, &none, &p, &T, &rho, &Y);
    return Y;
}

/* A strength that leaves nothing elastic, or everything. */
static void scene_material_weigh(struct draft *draft, const struct scene_material *material,
                                 const struct keys_value *plastic)
{
    double modulus = scene_material_number(&material->constitutive, "shear-modulus");
    double yield = scene_material_yield(material, scene_material_number(&material->constitutive, "reference-density"));
    if (!(yield > 0.0))
        keys_error(&draft->keys, plastic, "'%s' bears nothing: its strength at 300 K, unstrained, is %.4g Pa",
                   material->name, yield);
    else if (yield >= modulus) {
        keys_error(&draft->keys, plastic, "the strength of '%s', %.4g Pa, is not below its shear modulus, %.4g Pa",
                   material->name, yield, modulus);
        diag_help(draft->keys.diag, "such a solid would stretch without end before it yields; leave 'plastic' out");
    } else if (yield > 0.1 * modulus) {
        diag_warn(draft->keys.diag, &plastic->node->mark,
                  "%s: the strength of '%s', %.4g Pa, is %.2g of its shear modulus: strains are large before it yields",
                  plastic->path, material->name, yield, yield / modulus);
    }
}

/* Did the case say this number of a section, or a preset that has it? Defaults stand where their section does. */
static bool scene_material_says(const struct keys_value *section, const char *key)
{
    const struct keys_value *value = keys_at(section->map, key);
    const struct mark *there = &section->map->node->mark, *here = value->node ? &value->node->mark : there;
    return tree_get(section->map->node, "preset") || here->line != there->line || here->column != there->column;
}

void scene_material_warm(struct draft *draft, const struct keys_value *asking, const struct scene_material *material,
                         const char *what)
{
    const struct keys_value *entry = &keys_at(draft->root, "materials")->list[material - draft->scene->material];
    const struct keys_value *eos = keys_at(entry->map, "eos");
    if (!material->eos.module || !eos->map) return;
    int row = instance_param_find(material->eos.module, "cv");
    if (row < 0 || isnan(material->eos.module->params[row].fallback) || scene_material_says(eos, "cv")) return;
    keys_error(&draft->keys, asking, "'%s' looks at temperatures, and nothing is said of the specific heat of '%s'",
               what, material->name);
    diag_help(draft->keys.diag, "give 'cv' in its 'eos', or set 'melting-temperature: 0' where the law has that key");
}

/* A strength wants a solid. */
static void scene_material_strong(struct draft *draft, const struct keys_map *entry, struct scene_material *material)
{
    const struct keys_value *plastic = keys_at(entry, "plastic");
    if (!plastic->node) return;
    if (!keys_at(entry, "constitutive")->node) {
        keys_error(&draft->keys, plastic, "'%s' is a fluid: a strength needs an elastic law", material->name);
        diag_help(draft->keys.diag, "constitutive: {type: neo-hookean, shear-modulus: ..., reference-density: ...}");
        return;
    }
    scene_material_open(draft, plastic, &material->plastic);
    if (!material->plastic.module || !material->constitutive.module) return;
    if (!((const struct bulla_constitutive *)material->constitutive.module->table)->first_only)
        keys_error(&draft->keys, plastic, "'%s' depends on I2: plastic flow is there for laws of I1 alone",
                   material->constitutive.module->name);
    scene_material_weigh(draft, material, plastic);
    const struct bulla_inelastic *law = material->plastic.module->table;
    if (law->needs(material->plastic.self) & BULLA_INELASTIC_TEMPERATURE)
        scene_material_warm(draft, plastic, material, material->plastic.module->name);
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
        if (entry->map) scene_material_strong(draft, entry->map, material);
        if (entry->map) scene_branch(draft, entry->map, material);
        if (entry->map) scene_damage(draft, entry->map, material);
        scene_material_open(draft, keys_at(entry->map, "viscosity"), &material->viscosity);
        scene_material_open(draft, keys_at(entry->map, "conductivity"), &material->conductivity);
        material->drag = entry->map ? keys_at(entry->map, "drag")->number : 0.0;
    }
}
