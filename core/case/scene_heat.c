/* scene_heat.c - what conduction of heat asks of a scene: temperatures that mean something, volume that moves with
 * heat.
 *
 * Laws of which only the temperature depends on cv have a value for it that is nobody's; with conduction it is asked
 * for. The heat capacity of a law can be far from that of the fluid whose conductivity is given: then heat spreads
 * wrongly. */
#include "case/scene_draft.h"

#include "bulla/conductivity.h"
#include "bulla/eos.h"

#include <math.h>
#include <string.h>

static const double scene_heat_far = 1.1; /* a ratio of heat capacities that is worth a word */

/* cp [J/(kg K)] and conductivity [W/(m K)] of water and air at 25 C and 1 atm (IAPWS-95; Lemmon et al., J. Phys. Chem.
 * Ref. Data 29 (2000) 331). */
static const struct scene_heat_fluid {
    const char *name;
    double cp, k;
} scene_heat_fluids[] = {{"water", 4181.0, 0.607}, {"air", 1006.0, 0.0262}};

/* cp of a law at 25 C and 1 atm, by differences of the enthalpy over 1e-4 of the density; NaN: it has none there. */
static double scene_heat_cp(const struct instance *instance)
{
    const struct bulla_eos *law = instance->module->table;
    double p[2] = {101325.0, 101325.0}, T[2] = {298.15, 298.15}, rho[2], e[2], rho_c2[2];
    law->density(instance->self, 1, p, T, rho);
    rho[1] = 0.9999 * rho[0];
    law->temperature(instance->self, 2, rho, p, T);
    law->state(instance->self, 2, rho, p, e, rho_c2);
    double cp = ((e[1] + p[1]) / rho[1] - (e[0] + p[0]) / rho[0]) / (T[1] - T[0]);
    return cp > 0.0 ? cp : (double)NAN;
}

/* The fluid that a conductivity is of: by its preset, else by the name of the material; or NULL. */
static const struct scene_heat_fluid *scene_heat_real(const struct keys_value *conductivity, const char *material)
{
    const struct node *preset = conductivity->node->kind == TREE_MAP ? tree_get(conductivity->node, "preset") : NULL;
    const char *name = preset && preset->kind == TREE_SCALAR ? preset->text : material;
    for (size_t i = 0; i < sizeof scene_heat_fluids / sizeof *scene_heat_fluids; i++)
        if (strcmp(scene_heat_fluids[i].name, name) == 0) return &scene_heat_fluids[i];
    return NULL;
}

/* Is a ratio above 0 far from 1? */
static bool scene_heat_is_far(double ratio)
{
    return ratio > scene_heat_far || 1.0 / ratio > scene_heat_far;
}

/* The conductivity of a material at 25 C and 1 atm. */
static double scene_heat_k(const struct scene_material *material)
{
    const struct bulla_eos *law = material->eos.module->table;
    const struct bulla_conductivity *conductivity = material->conductivity.module->table;
    double p = 101325.0, T = 298.15, rate = 0.0, rho, k;
    law->density(material->eos.self, 1, &p, &T, &rho);
    conductivity->k.value(material->conductivity.self, 1, &rate, &T, &p, &rho, &k);
    return k;
}

/* A conductivity that is as many times smaller as the heat capacity is right: heat spreads by their ratio. */
static void scene_heat_capacity(struct draft *draft, unsigned l, const struct keys_value *conductivity)
{
    struct scene_material *material = &draft->scene->material[l];
    const struct scene_heat_fluid *fluid = scene_heat_real(conductivity, material->name);
    if (!fluid || !material->eos.module || !material->conductivity.module) return;
    material->real = fluid->name;
    material->real_cp = fluid->cp;
    double cp = scene_heat_cp(&material->eos), ratio = fluid->cp / cp;
    if (!scene_heat_is_far(ratio) || !scene_heat_is_far(scene_heat_k(material) * ratio / fluid->k)) return;
    diag_warn(draft->keys.diag, &conductivity->node->mark,
              "%s: cp of '%s' is %.4g J/kg/K in its law %s, that of %s is %.4g: heat spreads %.2g times as fast",
              conductivity->path, material->name, cp, material->eos.module->name, fluid->name, fluid->cp, ratio);
    diag_help(draft->keys.diag, "choose a law with its heat capacity, or a conductivity as many times smaller");
}

/* cv of a law that has one: given, or of a preset. */
static void scene_heat_cv(struct draft *draft, unsigned l, const struct keys_map *map)
{
    const struct bulla_module *law = draft->scene->material[l].eos.module;
    const struct keys_value *eos = keys_at(map, "eos");
    bool has = false;
    for (unsigned i = 0; law && i < instance_param_count(law); i++) has = has || !strcmp(law->params[i].name, "cv");
    if (!has || eos->node->kind != TREE_MAP || tree_get(eos->node, "preset")) return;
    const struct node *cv = tree_get(eos->node, "cv"); /* a default stands where its map does */
    if (!cv || memcmp(&cv->mark, &eos->node->mark, sizeof cv->mark) != 0) return;
    keys_error(&draft->keys, eos, "'%s' conducts heat, but its law %s has no temperatures: no cv is given",
               draft->scene->material[l].name, law->name);
    diag_help(draft->keys.diag, "give 'cv' in J/kg/K, or a preset with temperatures");
}

static void scene_heat_scheme(struct draft *draft)
{
    const struct scene *scene = draft->scene;
    const struct keys_map *scheme = keys_at(draft->root, "scheme")->map;
    const struct keys_value *exchange = keys_at(scheme, "exchange"), *closure = keys_at(scheme, "closure");
    if (scene->n_material < 2) return;
    if (scene->scheme.closure == SCENE_ALLAIRE) {
        keys_error(&draft->keys, closure, "with conduction volume must move with heat, which '%s' does not",
                   closure->text);
        diag_help(draft->keys.diag, "'closure: kapila', or no conductivity");
    } else if (scene->scheme.exchange == SCENE_EXCHANGE_FAST) {
        diag_warn(draft->keys.diag, &exchange->node->mark,
                  "%s: temperatures of interfaces come out wrong with 'fast', and heat goes by them", exchange->path);
        diag_help(draft->keys.diag, "leave it out: with conduction 'auto' means 'full'");
    }
}

void scene_heat(struct draft *draft)
{
    const struct keys_value *materials = keys_at(draft->root, "materials");
    if (!scene_matter_conducts(draft)) return;
    for (unsigned l = 0; l < draft->scene->n_material && l < materials->count; l++) {
        const struct keys_map *map = materials->list[l].map;
        const struct keys_value *conductivity = map ? keys_at(map, "conductivity") : NULL;
        if (!conductivity || !conductivity->node) continue;
        scene_heat_cv(draft, l, map);
        scene_heat_capacity(draft, l, conductivity);
    }
    scene_heat_scheme(draft);
}
