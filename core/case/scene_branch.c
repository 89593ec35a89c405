/* scene_branch.c - the Maxwell branches of a solid: `viscoelastic` of a material. */
#include "case/scene_draft.h"

#include "bulla/constitutive.h"
#include "bulla/eos.h"

#include <math.h>

static const struct key scene_branch_rows[] = {
    {.name = "shear-modulus",
     .type = KEYS_NUMBER,
     .unit = "Pa",
     .min = KEYS_POSITIVE,
     .max = 1e13,
     .required = true,
     .doc = "Modulus G of its spring: what it bears before it relaxes."},
    {.name = "relaxation-time",
     .type = KEYS_NUMBER,
     .unit = "s",
     .min = KEYS_POSITIVE,
     .max = KEYS_MOST,
     .required = true,
     .doc = "Time tau in which a stress that is not renewed falls by e; its viscosity is G tau."},
    {.name = "reference-density",
     .type = KEYS_NUMBER,
     .unit = "kg/m3",
     .min = KEYS_POSITIVE,
     .max = KEYS_MOST,
     .doc = "Density at which that is its modulus; that of the elastic law if not given."},
    {0},
};

const struct keys_section scene_branch_keys = {.name = "branch",
                                               .doc = "A Maxwell branch: a spring and a dashpot in a row, beside the "
                                                      "elastic law of the solid.",
                                               .keys = scene_branch_rows};

/* One branch; `density` of the elastic law, NAN if it has none. */
static void scene_branch_one(struct draft *draft, const struct keys_value *value, double density,
                             struct scene_material *material)
{
    const struct keys_value *own = keys_at(value->map, "reference-density");
    struct scene_branch *branch = &material->branch[material->n_branch];
    if (!value->map) return;
    *branch = (struct scene_branch){.modulus = keys_at(value->map, "shear-modulus")->number,
                                    .density = own->given ? own->number : density,
                                    .time = keys_at(value->map, "relaxation-time")->number};
    if (isnan(branch->density)) {
        keys_error(&draft->keys, value, "the elastic law of '%s' knows no density at which a modulus is one",
                   material->name);
        diag_help(draft->keys.diag, "give the branch a 'reference-density'");
    }
    material->n_branch++;
}

/* What branches want: a solid, which does not flow otherwise. */
static bool scene_branch_fits(struct draft *draft, const struct keys_map *entry, const struct keys_value *list,
                              const struct scene_material *material)
{
    if (!keys_at(entry, "constitutive")->node) {
        keys_error(&draft->keys, list, "'%s' is a fluid: branches stand beside an elastic law", material->name);
        diag_help(draft->keys.diag, "of a Maxwell fluid that law bears nothing: constitutive: {type: neo-hookean, "
                                    "shear-modulus: 0 Pa, reference-density: ...}");
        return false;
    }
    if (keys_at(entry, "plastic")->node)
        keys_error(&draft->keys, list, "'%s' is plastic: a solid that yields has no branches yet", material->name);
    return true;
}

/* The density at which the modulus of an elastic law is one; NAN: it knows none. */
static double scene_branch_density(const struct instance *law)
{
    int row = law->module ? instance_param_find(law->module, "reference-density") : -1;
    return row < 0 ? (double)NAN : law->values[row].number;
}

/* A law that bears nothing is one of a Maxwell fluid. */
static void scene_branch_slack(struct draft *draft, const struct keys_map *entry, const struct scene_material *material)
{
    const struct instance *law = &material->constitutive;
    double I1 = 3.5, I2 = 3.25, e, e_1, e_2;
    if (!law->module || material->n_branch) return;
    ((const struct bulla_constitutive *)law->module->table)->energy(law->self, 1, &I1, &I2, &e, &e_1, &e_2);
    if (e_1 != 0.0 || e_2 != 0.0) return;
    keys_error(&draft->keys, keys_at(entry, "constitutive"), "'%s' bears nothing, so it is a fluid", material->name);
    diag_help(draft->keys.diag, "leave 'constitutive' out, or give a Maxwell fluid its 'viscoelastic' branches");
}

void scene_branch(struct draft *draft, const struct keys_map *entry, struct scene_material *material)
{
    const struct keys_value *list = keys_at(entry, "viscoelastic");
    unsigned before = 0;
    for (unsigned l = 0; l < draft->scene->n_material; l++) before += draft->scene->material[l].n_branch;
    if (before + list->count > SCENE_BRANCHES)
        keys_error(&draft->keys, list, "%u branches in all are more than %d", before + list->count, SCENE_BRANCHES);
    else if (list->node && scene_branch_fits(draft, entry, list, material))
        for (unsigned b = 0; b < list->count; b++)
            scene_branch_one(draft, &list->list[b], scene_branch_density(&material->constitutive), material);
    scene_branch_slack(draft, entry, material);
}

/* A bound of the time step of a level where a material fills its cells, from its fastest unrelaxed wave [s]; NAN:
 * unknown. */
static double scene_branch_step(const struct scene *scene, const struct scene_material *material, int level)
{
    const struct bulla_eos *law = material->eos.module->table;
    double rho = material->branch[0].density, p = 101325.0, rho_e, M, all = 0.0;
    int row = instance_param_find(material->constitutive.module, "shear-modulus");
    law->state(material->eos.self, 1, &rho, &p, &rho_e, &M);
    if (row >= 0) M += 4.0 / 3.0 * material->constitutive.values[row].number;
    for (unsigned b = 0; b < material->n_branch; b++) M += 4.0 / 3.0 * material->branch[b].modulus;
    for (int d = 0; d < scene->domain.dim; d++)
        all += scene->domain.cells[d] / (scene->domain.upper[d] - scene->domain.lower[d]);
    double step = scene->scheme.dt_fixed > 0.0 ? scene->scheme.dt_fixed : scene->scheme.cfl / (all * sqrt(M / rho));
    return ldexp(step, -level);
}

/* A branch that relaxes within a step damps more than G tau: 1 % if in one step, 5 % if in half of one. */
static void scene_branch_resolve(struct draft *draft, const struct scene_material *material, unsigned b,
                                 const struct keys_value *value)
{
    const struct scene *scene = draft->scene;
    double tau = material->branch[b].time, coarse = scene_branch_step(scene, material, 0);
    double fine = ldexp(coarse, -scene->mesh.levels), G = material->branch[b].modulus;
    const struct keys_value *time = keys_at(value->map, "relaxation-time");
    if (tau < fine) {
        keys_error(&draft->keys, time,
                   "this branch relaxes within one time step, which is about %.3g s on the finest level", fine);
        diag_help(draft->keys.diag,
                  "the same viscosity of %.3g Pa s: a 'relaxation-time' of some steps with a lower "
                  "'shear-modulus', or 'viscosity: %.3g Pa s' in its place",
                  G * tau, G * tau);
    } else if (tau < 2.0 * coarse) {
        diag_warn(draft->keys.diag, &time->node->mark,
                  "%s: a time step is about %.3g s on the coarsest level: the branch damps more than it should there",
                  time->path, coarse);
    }
}

/* Stages that are mixed hold means of what has relaxed for different times: of first order (docs/numerics.md 6e). */
static void scene_branch_stages(struct draft *draft)
{
    const struct keys_value *scheme = keys_at(draft->root, "scheme");
    const struct keys_value *integrator = scheme->map ? keys_at(scheme->map, "integrator") : NULL;
    unsigned n_branch = 0;
    for (unsigned l = 0; l < draft->scene->n_material; l++) n_branch += draft->scene->material[l].n_branch;
    if (!n_branch || draft->scene->scheme.integrator != SCENE_SSPRK3 || !integrator || !integrator->node) return;
    diag_warn(draft->keys.diag, &integrator->node->mark,
              "%s: the branches of solids relax to first order in time with 'ssprk3'", integrator->path);
    diag_help(draft->keys.diag, "'midpoint', the default, is of second order there");
}

void scene_branch_times(struct draft *draft)
{
    const struct keys_value *materials = keys_at(draft->root, "materials");
    scene_branch_stages(draft);
    for (unsigned l = 0; l < draft->scene->n_material; l++) {
        const struct scene_material *material = &draft->scene->material[l];
        const struct keys_value *list = keys_at(materials->list[l].map, "viscoelastic");
        for (unsigned b = 0; material->eos.module && material->constitutive.module && b < material->n_branch; b++)
            scene_branch_resolve(draft, material, b, &list->list[b]);
    }
}
