/* scene_damage.c - how a solid breaks: `damage` of a material, and the void that opens where it does. */
#include "case/scene_draft.h"

#include "bulla/constitutive.h"
#include "bulla/damage.h"
#include "bulla/eos.h"
#include "bulla/inelastic.h"

#include <math.h>

/* Cells that a wave crosses while a solid breaks, at the least; and how much stiffer than its pressure a gas may be. */
#define SCENE_DAMAGE_CELLS 5.0
#define SCENE_DAMAGE_GAS 10.0

/* A new void, if the case does not say: nearly nothing, but far above what the energy of a stiff cell resolves. */
#define SCENE_DAMAGE_PRESSURE 1e3
#define SCENE_DAMAGE_TEMPERATURE 300.0

static const struct key scene_damage_rows[] = {
    {.name = "type", .type = KEYS_CHOICE, .required = true, .doc = "When it breaks."},
    {.name = "time",
     .type = KEYS_NUMBER,
     .unit = "s",
     .max = KEYS_MOST,
     .doc = "Time in which it breaks at the fastest; that in which a wave crosses 5 cells of the finest level if not "
            "given. 0: "
            "at once, at the mesh's whim."},
    {.name = "opens",
     .type = KEYS_TEXT,
     .doc =
         "A gas of the scene that fills the void which opens where the broken solid is in tension; without it a broken "
         "solid is a fluid that still bears tension."},
    {.name = "void-pressure",
     .type = KEYS_NUMBER,
     .unit = "Pa",
     .min = KEYS_POSITIVE,
     .max = 1e7,
     .doc = "Pressure in a new void; 1 kPa if not given."},
    {.name = "void-temperature",
     .type = KEYS_NUMBER,
     .unit = "K",
     .min = KEYS_POSITIVE,
     .max = 1e5,
     .doc = "Temperature of the gas in a new void, which with the pressure gives its density; 300 K if not given."},
    {0},
};

const struct keys_section scene_damage_keys = {.name = "damage",
                                               .doc = "How a solid breaks: a criterion and its numbers.",
                                               .keys = scene_damage_rows,
                                               .selector = "type",
                                               .kind = "damage"};

/* What the criterion looks at must be there. */
static void scene_damage_fits(struct draft *draft, const struct keys_value *value,
                              const struct scene_material *material)
{
    const struct instance *law = &material->damage.law, *plastic = &material->plastic;
    unsigned needs = ((const struct bulla_damage *)law->module->table)->needs(law->self);
    unsigned strong =
        plastic->module ? ((const struct bulla_inelastic *)plastic->module->table)->needs(plastic->self) : 0;
    if (needs & (BULLA_DAMAGE_STRAIN | BULLA_DAMAGE_RATE) && !plastic->module) {
        keys_error(&draft->keys, value, "'%s' looks at plastic strain, and '%s' has no 'plastic' law",
                   law->module->name, material->name);
        diag_help(draft->keys.diag,
                  "plastic: {type: von-mises, yield: ..., strain: always}, or a criterion of stress or stretch");
    } else if (needs & BULLA_DAMAGE_STRAIN && !(strong & BULLA_INELASTIC_STRAIN)) {
        keys_error(&draft->keys, value, "'%s' looks at plastic strain, which the strength of '%s' does not keep",
                   law->module->name, material->name);
        diag_help(draft->keys.diag, "'strain: always' in a von-mises law keeps it");
    }
    if (needs & BULLA_DAMAGE_TEMPERATURE) scene_matter_warm(draft, value, material, law->module->name);
}

void scene_damage(struct draft *draft, const struct keys_map *entry, struct scene_material *material)
{
    const struct keys_value *value = keys_at(entry, "damage");
    if (!value->node) return;
    if (!keys_at(entry, "constitutive")->node) {
        keys_error(&draft->keys, value, "'%s' is a fluid: what breaks has an elastic law", material->name);
        diag_help(draft->keys.diag,
                  "constitutive: {type: neo-hookean, shear-modulus: ..., reference-density: ...}; for a "
                  "liquid that cavitates, 'phase-change'");
        return;
    }
    scene_matter_open(draft, value, &material->damage.law);
    if (material->damage.law.module && value->map) scene_damage_fits(draft, value, material);
}

/* The state of the gas in a new void; false after an error. */
static bool scene_damage_gas(struct draft *draft, const struct keys_value *opens, const struct scene_material *gas,
                             struct scene_damage *damage, double T)
{
    const struct bulla_eos *law = gas->eos.module ? gas->eos.module->table : NULL;
    double rho_e, rho_c2, p = damage->pressure;
    if (!law) return false;
    law->density(gas->eos.self, 1, &p, &T, &damage->density);
    law->state(gas->eos.self, 1, &damage->density, &p, &rho_e, &rho_c2);
    if (damage->density > 0.0 && rho_c2 > 0.0 && rho_c2 < SCENE_DAMAGE_GAS * p) return true;
    keys_error(&draft->keys, opens, "'%s' is no gas: at %g Pa and %g K it has %.4g kg/m3 and rho c^2 = %.4g Pa",
               gas->name, p, T, damage->density, rho_c2);
    diag_help(draft->keys.diag, "a material such as vapour: {eos: {type: ideal-gas, gamma: 1.33, cv: 1400 J/kg/K}}");
    return false;
}

/* What fills the voids of material l. */
static void scene_damage_opens(struct draft *draft, unsigned l, const struct keys_map *map)
{
    const struct keys_value *opens = keys_at(map, "opens");
    struct scene_damage *damage = &draft->scene->material[l].damage;
    int gas = scene_matter_index(draft, opens);
    if (gas < 0) return;
    const struct scene_material *filling = &draft->scene->material[gas];
    if (scene_matter_is_solid(draft, (unsigned)gas)) {
        keys_error(&draft->keys, opens, "'%s' is a solid: a void is filled by a gas", filling->name);
        return;
    }
    const struct keys_value *p = keys_at(map, "void-pressure"), *T = keys_at(map, "void-temperature");
    damage->pressure = p->given ? p->number : SCENE_DAMAGE_PRESSURE;
    damage->gas = (unsigned)gas;
    damage->opens = scene_damage_gas(draft, opens, filling, damage, T->given ? T->number : SCENE_DAMAGE_TEMPERATURE);
}

/* Keys of a void that never opens. */
static void scene_damage_idle(struct draft *draft, const struct keys_map *map)
{
    static const char *const names[] = {"void-pressure", "void-temperature"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const struct keys_value *value = keys_at(map, names[i]);
        if (!value->given || keys_at(map, "opens")->given) continue;
        keys_error(&draft->keys, value, "there is no void: nothing 'opens'");
        diag_help(draft->keys.diag, "opens: a gas of the scene");
    }
}

/* In which the fastest wave of an unstretched solid crosses a cell of the finest level [s]. */
static double scene_damage_crossing(const struct scene *scene, const struct scene_material *material)
{
    const struct instance *solid = &material->constitutive;
    const struct bulla_eos *law = material->eos.module->table;
    double rho, rho_e, M, p = 101325.0, T = 300.0, unstretched = 3.0, e, e_1, e_2, h = HUGE_VAL;
    int row = instance_param_find(solid->module, "reference-density");
    law->density(material->eos.self, 1, &p, &T, &rho);
    if (row >= 0) rho = solid->values[row].number;
    law->state(material->eos.self, 1, &rho, &p, &rho_e, &M);
    ((const struct bulla_constitutive *)solid->module->table)
        ->energy(solid->self, 1, &unstretched, &unstretched, &e, &e_1, &e_2);
    M += 4.0 / 3.0 * rho * 2.0 * (e_1 + e_2);
    for (unsigned b = 0; b < material->n_branch; b++) M += 4.0 / 3.0 * material->branch[b].modulus;
    for (int d = 0; d < scene->domain.dim; d++)
        h = fmin(h, (scene->domain.upper[d] - scene->domain.lower[d]) / scene->domain.cells[d]);
    return ldexp(h, -scene->mesh.levels) / sqrt(M / rho);
}

/* How fast it may break. */
static void scene_damage_time(struct draft *draft, struct scene_material *material, const struct keys_map *map)
{
    const struct keys_value *time = keys_at(map, "time");
    double crossing = scene_damage_crossing(draft->scene, material), least = SCENE_DAMAGE_CELLS * crossing;
    material->damage.time = time->given ? time->number : least;
    if (time->given && time->number < 0.99 * least)
        diag_warn(
            draft->keys.diag, &time->node->mark,
            "%s: a wave crosses %.2g cells meanwhile (%.3g s each): where and how much breaks depends on the mesh",
            time->path, time->number / crossing, crossing);
}

/* The damage section of material l, if it has a good one. */
static const struct keys_map *scene_damage_map(const struct draft *draft, unsigned l)
{
    const struct keys_value *entry = &keys_at(draft->root, "materials")->list[l];
    return draft->scene->material[l].damage.law.module ? keys_at(entry->map, "damage")->map : NULL;
}

void scene_damage_voids(struct draft *draft)
{
    for (unsigned l = 0; l < draft->scene->n_material; l++) {
        const struct keys_map *map = scene_damage_map(draft, l);
        if (!map) continue;
        scene_damage_opens(draft, l, map);
        scene_damage_idle(draft, map);
    }
}

void scene_damage_times(struct draft *draft)
{
    for (unsigned l = 0; l < draft->scene->n_material; l++) {
        struct scene_material *material = &draft->scene->material[l];
        const struct keys_map *map = scene_damage_map(draft, l);
        if (map && material->eos.module && material->constitutive.module) scene_damage_time(draft, material, map);
    }
}
