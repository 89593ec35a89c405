/* scene_material.c - materials, and the opening of the modules that a case names. */
#include "case/scene_draft.h"

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
    scene_matter_open(draft, plastic, &material->plastic);
    if (!material->plastic.module || !material->constitutive.module) return;
    if (!((const struct bulla_constitutive *)material->constitutive.module->table)->first_only)
        keys_error(&draft->keys, plastic, "'%s' depends on I2: plastic flow is there for laws of I1 alone",
                   material->constitutive.module->name);
    scene_material_weigh(draft, material, plastic);
    const struct bulla_inelastic *law = material->plastic.module->table;
    if (law->needs(material->plastic.self) & BULLA_INELASTIC_TEMPERATURE)
        scene_matter_warm(draft, plastic, material, material->plastic.module->name);
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
        scene_matter_open(draft, keys_at(entry->map, "eos"), &material->eos);
        scene_matter_open(draft, keys_at(entry->map, "constitutive"), &material->constitutive);
        if (entry->map) scene_material_strong(draft, entry->map, material);
        if (entry->map) scene_branch(draft, entry->map, material);
        if (entry->map) scene_damage(draft, entry->map, material);
        scene_matter_open(draft, keys_at(entry->map, "viscosity"), &material->viscosity);
        scene_matter_open(draft, keys_at(entry->map, "conductivity"), &material->conductivity);
        material->drag = entry->map ? keys_at(entry->map, "drag")->number : 0.0;
    }
}
