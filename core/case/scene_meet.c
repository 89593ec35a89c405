/* scene_meet.c - what the scheme does where materials meet: how steep their surfaces are, and what solids bear there of
 * fluids beside them. */
#include "case/scene_draft.h"

#include "bulla/constitutive.h"
#include "bulla/eos.h"

/* A solid whose shear waves are faster than this is stiff [m/s], and a gas at 1 atm softer than that [Pa]. */
#define SCENE_MEET_STIFF 100.0
#define SCENE_MEET_SOFT 1e7

/* c_s^2 = mu/rho0 = 2 (e_1 + e_2) without strain, and what the springs of branches add. */
static bool scene_meet_is_stiff(const struct scene_material *material)
{
    double I = 3.0, e, e_1, e_2, springs = 0.0;
    if (!material->constitutive.module) return false;
    const struct bulla_constitutive *law = material->constitutive.module->table;
    law->energy(material->constitutive.self, 1, &I, &I, &e, &e_1, &e_2);
    for (unsigned b = 0; b < material->n_branch; b++)
        springs += material->branch[b].modulus / material->branch[b].density;
    return 2.0 * (e_1 + e_2) + springs > SCENE_MEET_STIFF * SCENE_MEET_STIFF;
}

static bool scene_meet_is_gas(const struct scene_material *material)
{
    double p = 101325.0, T = 298.15, rho, e, rho_c2;
    if (material->constitutive.module || !material->eos.module) return false;
    const struct bulla_eos *law = material->eos.module->table;
    law->density(material->eos.self, 1, &p, &T, &rho);
    law->state(material->eos.self, 1, &rho, &p, &e, &rho_c2);
    return rho_c2 < SCENE_MEET_SOFT;
}

/* Does a stiff solid meet a gas, on a surface that lies as it likes? */
static bool scene_meet_stiff(struct draft *draft)
{
    const struct scene *scene = draft->scene;
    bool stiff = false, gas = false;
    if (scene->domain.dim < 2) return false;
    for (unsigned l = 0; l < scene->n_material; l++) {
        stiff = stiff || scene_meet_is_stiff(&scene->material[l]);
        gas = gas || scene_meet_is_gas(&scene->material[l]);
    }
    return stiff && gas;
}

/* The same of an elastic one that shares its traction. */
bool scene_meet_hard(struct draft *draft)
{
    if (draft->scene->scheme.traction == SCENE_TRACTION_PRESSURE) return false;
    if (scene_matter_strength(draft) || scene_matter_branched(draft)) return false;
    return scene_meet_stiff(draft);
}

/* A surface that bears no shear. */
bool scene_meet_free(struct draft *draft, const struct keys_map *scheme)
{
    enum { AUTO, FREE } shear = (int)keys_at(scheme, "surface-shear")->integer;
    return shear == AUTO ? scene_meet_hard(draft) : shear == FREE;
}

/* Solids that are strained by what of them comes to the faces. */
bool scene_meet_sheltered(struct draft *draft, const struct keys_map *scheme)
{
    enum { AUTO, SHARE } strain = (int)keys_at(scheme, "surface-strain")->integer;
    bool kapila = draft->scene->scheme.closure == SCENE_KAPILA;
    if (strain == SHARE && !kapila)
        diag_warn(draft->keys.diag, &keys_at(scheme, "surface-strain")->node->mark,
                  "'surface-strain: share' goes with 'closure: kapila', and has no effect here");
    return kapila && (strain == AUTO ? scene_meet_stiff(draft) : strain == SHARE);
}

/* Keys that say how solids meet fluids, in a scene that has no solid. */
void scene_meet_idle(struct draft *draft, const struct keys_map *scheme)
{
    static const char *const keys[] = {"traction", "surface-shear", "surface-strain"};
    for (size_t k = 0; k < sizeof keys / sizeof *keys && !scene_matter_solid(draft); k++) {
        const struct keys_value *value = keys_at(scheme, keys[k]);
        if (!value->given || value->integer == 0) continue;
        diag_warn(draft->keys.diag, &value->node->mark,
                  "'%s' says how elastic solids meet fluids, and has no effect here", keys[k]);
        diag_help(draft->keys.diag, "a material with 'constitutive:' is a solid");
    }
}

bool scene_meet_drawn(struct draft *draft)
{
    bool drawn = keys_at(draft->root, "surface-tension")->count > 0 && draft->scene->domain.dim > 1;
    return drawn && !scene_matter_solid(draft);
}

bool scene_meet_slanted(struct draft *draft, const struct keys_map *scheme)
{
    enum { AUTO, NORMAL } along = (int)keys_at(scheme, "interface-along")->integer;
    const struct scene *scene = draft->scene;
    if (along == AUTO) return scene_meet_drawn(draft);
    if (along != NORMAL || (scene->domain.dim > 1 && scene->n_material > 1)) return along == NORMAL;
    diag_warn(draft->keys.diag, &keys_at(scheme, "interface-along")->node->mark,
              "'interface-along: normal' is about surfaces between materials that lie as they like, and has no effect "
              "here");
    diag_help(draft->keys.diag, "on a line and around a centre the axis is the normal");
    return false;
}
