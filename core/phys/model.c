/* model.c - a scene's fields and laws, resolved once so that kernels meet only indices and calls. */
#include "phys/model.h"

#include "base/mem.h"
#include "phys/elastic_tensor.h"
#include "phys/model_family.h"
#include "phys/model_law.h"
#include "plug/registry.h"

#include <math.h>
#include <stddef.h>

const char *const model_tensor[] = {"xx", "yy", "zz", "xy", "xz", "yz"};

/* Of a component of stretch k: with the name of its solid where there are several; the branches of one count from 1. */
static char *model_stretch_name(const struct model *model, unsigned k, unsigned c)
{
    const char *solid = model->scene->material[model->solids[model_bearer(model, k)].material].name;
    unsigned number = 1;
    for (unsigned b = model->n_solid; b < k; b++) number += model_bearer(model, b) == model_bearer(model, k);
    if (k >= model->n_solid) return mem_print("stretch_%s_%u_%s", solid, number, model_tensor[c]);
    return model->n_solid == 1 ? mem_print("stretch_%s", model_tensor[c])
                               : mem_print("stretch_%s_%s", solid, model_tensor[c]);
}

static void model_name_fields(struct model *model)
{
    static const char *const momentum[] = {"momentum_x", "momentum_y", "momentum_z"};
    static const char *const normal[] = {"normal_x", "normal_y", "normal_z"};
    static const char *const slant[] = {"slant_x", "slant_y", "slant_z"};
    unsigned at = 0;
    model->field_names = mem_new(model->n_field + 1, sizeof *model->field_names);
    for (unsigned l = 0; l < model->n_alpha; l++)
        model->field_names[at++] = mem_print("alpha_%s", model->scene->material[l].name);
    for (unsigned l = 0; l < model->n_material; l++)
        model->field_names[at++] = mem_print("partial_density_%s", model->scene->material[l].name);
    for (unsigned d = 0; d < model->n_velocity; d++) model->field_names[at++] = mem_text(momentum[d]);
    model->field_names[at++] = mem_text("total_energy");
    for (unsigned k = 0; k < model->n_memory; k++) {
        const struct model_solid *solid = &model->solids[model->memories[k].solid];
        const char *what = model->memories[k].field == solid->strain ? "plastic_strain" : "damage";
        model->field_names[at++] = mem_print("%s_mass_%s", what, model->scene->material[solid->material].name);
    }
    for (unsigned k = 0; k < model_stretches(model); k++)
        for (unsigned c = 0; c < model->n_stretch; c++) model->field_names[at++] = model_stretch_name(model, k, c);
    for (unsigned d = 0; d < model->n_normal; d++) model->field_names[at++] = mem_text(normal[d]);
    for (unsigned k = 0; k < model->n_pair; k++)
        model->field_names[at++] = mem_print("curvature_%s_%s", model->scene->material[model->pairs[k].inside].name,
                                             model->scene->material[model->pairs[k].outside].name);
    for (unsigned d = 0; d < model->n_slant; d++) model->field_names[at++] = mem_text(slant[d]);
}

/* Names that derive.c understands for this scene. */
static void model_name_derived(struct model *model)
{
    static const char *const plain[] = {"density",      "pressure",    "velocity",    "velocity_x", "velocity_y",
                                        "velocity_z",   "temperature", "sound_speed", "mach",       "internal_energy",
                                        "total_energy", "vorticity",   "heat_flux",   "schlieren",  "surface_energy",
                                        "level",        "rank",        "cost"};
    static const char *const solid[] = {"stress_xx",       "stress_yy",         "stress_zz",         "stress_xy",
                                        "stress_xz",       "stress_yz",         "stretch_xx",        "stretch_yy",
                                        "stretch_zz",      "stretch_xy",        "stretch_xz",        "stretch_yz",
                                        "stretch_max",     "sigma_max",         "sigma_min",         "sigma_shear",
                                        "sigma_max_dev",   "sigma_min_dev",     "principal_max",     "principal_min",
                                        "principal_shear", "principal_max_dev", "principal_min_dev", "von_mises",
                                        "strain_energy",   "invariant_1",       "invariant_2"};
    static const char *const viscous[] = {"stress_viscous_xx", "stress_viscous_yy", "stress_viscous_zz",
                                          "stress_viscous_xy", "stress_viscous_xz", "stress_viscous_yz",
                                          "dissipation"};
    size_t n_plain = sizeof plain / sizeof *plain, n_each = 5, at = 0;
    static const char *const plastic[] = {"flow_stress",
                                          "plastic_strain"}; /* with a strength; one that knows strains */
    size_t n_solid = model->elastic ? sizeof solid / sizeof *solid : 0;
    size_t n_plastic = model->aged ? 2 : model->plastic ? 1 : 0, n_branched = model->n_branch > 0;
    size_t n_viscous = model->viscous ? sizeof viscous / sizeof *viscous : 0;
    size_t n_derived = (size_t)model->scene->n_derived * BULLA_FIELD_OUTPUTS, n_rigid = model->scene->n_rigid > 0;
    model->names = mem_new(n_plain + n_viscous + n_solid + n_plastic + model->damaged + n_branched + n_rigid +
                               (n_each + 4) * model->n_material + n_derived + 1,
                           sizeof *model->names);
    for (size_t i = 0; i < n_plain; i++) model->names[at++] = mem_text(plain[i]);
    for (size_t i = 0; i < n_viscous; i++) model->names[at++] = mem_text(viscous[i]);
    for (size_t i = 0; i < n_solid; i++) model->names[at++] = mem_text(solid[i]);
    for (size_t i = 0; i < n_plastic; i++) model->names[at++] = mem_text(plastic[i]);
    if (model->damaged) model->names[at++] = mem_text("damage");
    if (n_branched) model->names[at++] = mem_text("overstress");
    if (n_rigid) model->names[at++] = mem_text("body");
    for (unsigned l = 0; l < model->n_material; l++) {
        const char *name = model->scene->material[l].name;
        model->names[at++] = mem_print("alpha_%s", name);
        model->names[at++] = mem_print("density_%s", name);
        model->names[at++] = mem_print("temperature_%s", name);
        model->names[at++] = mem_print("partial_density_%s", name);
        model->names[at++] = mem_print("curvature_%s", name);
        if (!scene_phase_of(model->scene, l)) continue;
        model->names[at++] = mem_print("quality_%s", name);
        model->names[at++] = mem_print("saturation_pressure_%s", name);
        model->names[at++] = mem_print("saturation_temperature_%s", name);
        model->names[at++] = mem_print("superheat_%s", name);
    }
    for (unsigned i = 0; i < model->scene->n_derived; i++) {
        const struct bulla_field *law = model->scene->derived[i].law.module->table;
        for (unsigned k = 0; law->outputs[k].unit; k++)
            model->names[at++] = mem_text(model->scene->derived[i].names[k]);
    }
}

/* At 300 K and 1 bar. */
static double model_usual(const struct model_viscosity *viscosity, double rho)
{
    const struct bulla_coefficient *mu = &viscosity->law->mu;
    double T = 300.0, p = 1e5, value;
    if (mu->needs & BULLA_NEEDS_RATE) return viscosity->mu.number;
    mu->value(viscosity->mu.self, 1, NULL, &T, &p, &rho, &value);
    return value;
}

static void model_viscosity(const struct instance *instance, double rho, struct model_viscosity *ret)
{
    if (!instance->module) return;
    ret->law = instance->module->table;
    ret->mu = (struct model_coefficient){&ret->law->mu, instance->self, 0.0};
    bool rate = ret->mu.law->needs & BULLA_NEEDS_RATE, only = !(ret->mu.law->needs & ~(uint32_t)BULLA_NEEDS_RATE);
    if (rate) ret->mu.number = ret->mu.law->most(instance->self);
    else if (only) ret->mu.law->value(instance->self, 1, NULL, NULL, NULL, NULL, &ret->mu.number);
    if (only && ret->law->zeta) ret->law->zeta(instance->self, 1, NULL, NULL, NULL, &ret->zeta);
    ret->usual = model_usual(ret, rho);
    ret->thick = !rate && ret->usual >= MODEL_THICK;
}

static void model_around_state(struct model *model)
{
    model->i_around_rho = model->n_around;
    for (unsigned l = 0; l < model->n_material; l++) model->around[model->n_around++] = (unsigned char)(model->i_m + l);
    model->i_around_p = model->n_around;
    model->around[model->n_around++] = (unsigned char)model->i_E;
}

/* Two materials have 0 and 1. Of more those of like viscosity have like colours, so that no mixture of the thick and
 * the thin looks like something between them: the fourth root of what part of the largest viscosity they have. */
static void model_colours(struct model *model)
{
    double most = 0.0, own[SCENE_MATERIALS] = {0};
    for (unsigned l = 0; l < model->n_material; l++)
        if (model->viscosity[l].usual > most) most = model->viscosity[l].usual;
    for (unsigned l = 0; l < model->n_material && most > 0.0; l++) own[l] = pow(model->viscosity[l].usual / most, 0.25);
    for (unsigned l = 0; l < model->n_material; l++)
        model->colour[l] = model->n_material > 2 ? own[l] - own[0] : (double)l;
}

/* Laws of transport, and what their terms look at across edges. */
static void model_transport(struct model *model)
{
    bool sees = false; /* does a viscosity follow the state? */
    for (unsigned l = 0; l < model->n_material; l++) {
        model_viscosity(&model->scene->material[l].viscosity, model->eos[l].rho_fill, &model->viscosity[l]);
        model->viscous = model->viscous || model->viscosity[l].law;
        sees = sees || (model->viscosity[l].law && model->viscosity[l].mu.law->needs & ~(uint32_t)BULLA_NEEDS_RATE);
    }
    model_colours(model);
    bool clings = model_clings(model), surfaces = model->viscous || model->fronts || model->n_normal || clings;
    for (unsigned l = 1; surfaces && l < model->n_alpha; l++)
        model->around[model->n_around++] = (unsigned char)(model->i_alpha + l);
    model->n_around_alpha = model->n_around;
    for (unsigned d = 0; (model->viscous || clings) && d < model->n_velocity; d++)
        model->around[model->n_around++] = (unsigned char)(model->i_u + d);
    if (sees && model->n_alpha) model_around_state(model);
    model->calm = model->scene->scheme.calm && model->dim > 1;
    if (model->calm) model->around[model->n_around++] = (unsigned char)model->i_E;
}

/* Those pairs that a narrowed model has both materials of. */
static void model_pair_narrow(const struct model *model, struct model *narrow)
{
    narrow->n_pair = 0;
    for (unsigned k = 0; k < model->n_pair; k++) {
        struct model_pair pair = model->pairs[k];
        pair.inside -= narrow->first; /* wraps where it stands before */
        pair.outside -= narrow->first;
        if (pair.inside < narrow->n_alpha && pair.outside < narrow->n_alpha) narrow->pairs[narrow->n_pair++] = pair;
    }
}

/* The branches of solid s, which becomes the next solid of a narrowed model. */
static void model_narrow_branches(const struct model *model, unsigned s, struct model *narrow)
{
    for (unsigned b = 0; b < model->n_branch; b++) {
        if (model->branches[b].solid != s) continue;
        narrow->branches[narrow->n_branch] = model->branches[b];
        narrow->branches[narrow->n_branch++].solid = narrow->n_solid;
    }
}

/* What solid s remembers, which becomes the next solid of a narrowed model; its void's gas may be outside of that. */
static void model_narrow_memories(const struct model *model, unsigned s, struct model *narrow)
{
    struct model_damage *damage = &narrow->solids[narrow->n_solid].damage;
    narrow->damaged = narrow->damaged || damage->law;
    damage->gas -= narrow->first; /* wraps where it stands before */
    damage->opens = damage->opens && damage->gas < narrow->n_alpha;
    for (unsigned k = 0; k < model->n_memory; k++) {
        if (model->memories[k].solid != s) continue;
        narrow->memories[narrow->n_memory] = model->memories[k];
        narrow->memories[narrow->n_memory++].solid = narrow->n_solid;
    }
}

/* The model of a region that holds nothing but the n materials from `first`: works on the same blocks, leaves the
 * other materials' components alone, and the stretch where none of them is a solid; gives bitwise what the full model
 * would. One material alone needs no fractions either. */
static struct model *model_narrow(const struct model *model, unsigned first, unsigned n)
{
    struct model *narrow = mem_new(1, sizeof *narrow);
    *narrow = *model;
    narrow->n_material = n;
    narrow->n_alpha = n > 1 ? n : 0;
    narrow->first = first;
    narrow->i_alpha = model->i_alpha + (n > 1 ? first : 0);
    narrow->i_m = model->i_m + first;
    narrow->kapila = model->kapila && n > 1;
    narrow->linear = true;
    narrow->n_solid = narrow->n_active = narrow->n_branch = narrow->n_memory = 0;
    narrow->viscous = false;
    narrow->plastic = narrow->damaged = false;
    for (unsigned l = 0; l < n; l++) {
        narrow->eos[l] = model->eos[first + l];
        narrow->viscosity[l] = model->viscosity[first + l];
        narrow->viscous = narrow->viscous || narrow->viscosity[l].law;
        narrow->conductivity[l] = model->conductivity[first + l];
        narrow->linear = narrow->linear && narrow->eos[l].law->linear;
    }
    for (unsigned s = 0; s < model->n_solid; s++) {
        unsigned l = model->solids[s].material - first; /* wraps where it stands before */
        if (l >= n) continue;
        narrow->plastic = narrow->plastic || model->solids[s].strength;
        model_narrow_branches(model, s, narrow);
        narrow->solids[narrow->n_solid] = model->solids[s];
        model_narrow_memories(model, s, narrow);
        narrow->solids[narrow->n_solid++].material = l;
    }
    if (narrow->n_solid == 0) narrow->n_stretch = 0;
    narrow->n_normal = 0; /* nothing meets there */
    narrow->split = model->split && narrow->n_solid && !model->n_normal;
    model_pair_narrow(model, narrow);
    model_family_narrow(model, narrow);
    narrow->lagged = narrow->split || model_jumps(narrow);
    for (unsigned l = 0; l < narrow->n_alpha; l++) narrow->active[narrow->n_active++] = narrow->i_alpha + l;
    for (unsigned l = 0; l < n; l++) narrow->active[narrow->n_active++] = narrow->i_m + l;
    for (unsigned q = model->i_u; q <= model->i_E; q++) narrow->active[narrow->n_active++] = q;
    for (unsigned k = 0; k < narrow->n_memory; k++) narrow->active[narrow->n_active++] = narrow->memories[k].field;
    for (unsigned k = 0; k < model_stretches(narrow); k++)
        for (unsigned c = 0; c < narrow->n_stretch; c++)
            narrow->active[narrow->n_active++] = model_stretch(narrow, k) + c;
    for (unsigned k = 0; k < narrow->n_pair; k++) narrow->active[narrow->n_active++] = narrow->pairs[k].i_kappa;
    narrow->n_slant = narrow->n_alpha ? model->n_slant : 0;
    for (unsigned d = 0; d < narrow->n_slant; d++) narrow->active[narrow->n_active++] = narrow->i_slant + d;
    return narrow;
}

/* Bears a law nothing, however it is stretched? */
static bool model_is_slack(const struct model_solid *solid)
{
    double I1 = 3.5, I2 = 3.25, e, e_1, e_2;
    solid->law->energy(solid->self, 1, &I1, &I2, &e, &e_1, &e_2);
    return e_1 == 0.0 && e_2 == 0.0;
}

/* The fields of stretches: of each solid, then of each Maxwell branch. */
static void model_stretch_all(struct model *model)
{
    model->n_stretch = model->elastic ? elastic_tensor_count(model->n_velocity) : 0;
    model->n_field = model->i_V;
    for (unsigned s = 0; s < model->n_solid; s++) {
        model->solids[s].stretch = model->n_field;
        model->n_field += model->n_stretch;
    }
    for (unsigned s = 0; s < model->n_solid; s++) {
        const struct scene_material *material = &model->scene->material[model->solids[s].material];
        for (unsigned b = 0; b < material->n_branch; b++) {
            const struct scene_branch *branch = &material->branch[b];
            model->branches[model->n_branch++] = (struct model_branch){.solid = s,
                                                                       .field = model->n_field,
                                                                       .k = 0.5 * branch->modulus / branch->density,
                                                                       .time = branch->time};
            model->n_field += model->n_stretch;
        }
    }
    model->n_stretched = model->n_field - model->i_V;
}

/* A field of what the last solid remembers. */
static unsigned model_remember(struct model *model, double most)
{
    unsigned field = model->i_inner + model->n_inner++;
    model->memories[model->n_memory++] =
        (struct model_memory){.solid = model->n_solid - 1, .field = field, .most = most};
    return field;
}

/* The strength of the last solid. */
static void model_strength(struct model *model, const struct instance *plastic)
{
    struct model_solid *solid = &model->solids[model->n_solid - 1];
    if (!plastic->module) return;
    solid->strength = plastic->module->table;
    solid->strength_self = plastic->self;
    solid->needs = solid->strength->needs(plastic->self);
    model->plastic = true;
    if (!(solid->needs & BULLA_INELASTIC_STRAIN)) return;
    solid->strain = model_remember(model, HUGE_VAL);
    model->aged = true;
}

/* How the last solid breaks. */
static void model_damage(struct model *model, const struct scene_damage *scene)
{
    struct model_damage *damage = &model->solids[model->n_solid - 1].damage;
    if (!scene->law.module) return;
    *damage = (struct model_damage){.law = scene->law.module->table,
                                    .self = scene->law.self,
                                    .field = model_remember(model, 1.0),
                                    .time = scene->time,
                                    .opens = scene->opens,
                                    .gas = scene->gas,
                                    .p = scene->pressure,
                                    .rho = scene->density};
    damage->needs = damage->law->needs(scene->law.self);
    model->damaged = true;
}

/* The solids of a scene. */
static void model_solids(struct model *model)
{
    for (unsigned l = 0; l < model->n_material; l++) {
        const struct scene_material *material = &model->scene->material[l];
        const struct instance *law = &material->constitutive;
        if (!law->module) continue;
        struct model_solid *solid = &model->solids[model->n_solid++];
        *solid = (struct model_solid){.law = law->module->table, .self = law->self, .material = l};
        solid->slack = model_is_slack(solid);
        model_strength(model, &material->plastic);
        model_damage(model, &material->damage);
    }
    model->elastic = model->n_solid > 0;
}

/* Does the scene have an acceleration along an axis of the mesh? */
static bool model_is_forced(const struct scene *scene)
{
    bool any = false;
    for (int d = 0; scene->sources && d < scene->domain.dim; d++)
        any = any || scene->sources->value[SCENE_SOURCE_ACCELERATION + d].given;
    return any;
}

/* Pairs with surface tension, and the fields of their curvature. */
static void model_pair_up(struct model *model)
{
    const struct scene *scene = model->scene;
    model->n_pair = scene->n_tension;
    for (unsigned k = 0; k < model->n_pair; k++)
        model->pairs[k] = (struct model_pair){.inside = scene->tension[k].one,
                                              .outside = scene->tension[k].other,
                                              .i_kappa = model->n_field++,
                                              .sigma = scene->tension[k].sigma};
}

/* The fluids alone, if they stand together: they need neither the stretch nor the solids' components. Viscous films at
 * corners see tiles across them, which may hold a solid. */
static struct model *model_liquefy(const struct model *model)
{
    unsigned from = 0, n = model->n_material - model->n_solid;
    while (from < model->n_material && model->scene->material[from].constitutive.module) from++;
    if (!model->elastic || n < 2 || model->viscous) return NULL;
    for (unsigned l = from; l < from + n; l++)
        if (l >= model->n_material || model->scene->material[l].constitutive.module) return NULL;
    return model_narrow(model, from, n);
}

/* Laws of conduction; a constant of 0 is none. */
static void model_conduct(struct model *model)
{
    for (unsigned l = 0; l < model->n_material; l++) {
        const struct instance *instance = &model->scene->material[l].conductivity;
        if (!instance->module) continue;
        const struct bulla_conductivity *table = instance->module->table;
        struct model_conductivity law = {.law = &table->k, .self = instance->self};
        if (!table->k.needs) table->k.value(law.self, 1, NULL, NULL, NULL, NULL, &law.k);
        if (!table->k.needs && law.k == 0.0) continue;
        model->conductivity[l] = law;
        model->conducts = true;
    }
}

/* Do the materials of a cell share their traction? In the plane solids that flow have one pressure unless they are
 * asked to, which takes less time (docs/decisions/shells.md). Solids that meet share their pressure there, so that
 * without a fluid nothing is left to share. */
static bool model_is_split(const struct model *model)
{
    if (model->dim > 1 && model->n_solid == model->n_material) return false;
    enum scene_traction traction = model->scene->scheme.traction;
    bool flows = model->plastic || model->n_branch > 0, common = model->dim == 1 || !flows;
    bool wanted = traction == SCENE_TRACTION_AUTO ? common : traction == SCENE_TRACTION_COMMON;
    return wanted && model->elastic && model->n_alpha > 0;
}

/* Does a solver resist shear? Tables of older modules end before they say so. */
static bool model_resists(const struct bulla_riemann *riemann)
{
    bool told = riemann->size >= offsetof(struct bulla_riemann, resists) + sizeof riemann->resists;
    return told && riemann->resists;
}

static struct model_limiter model_limit(const struct instance *instance)
{
    return (struct model_limiter){instance->module->table, instance->self};
}

struct model *model_new(const struct scene *scene)
{
    struct model *model = mem_new(1, sizeof *model);
    model->scene = scene;
    model->dim = scene->domain.dim;
    model->beta = (int)scene->domain.geometry;
    model->n_material = scene->n_material;
    model->n_alpha = scene->n_material > 1 ? scene->n_material : 0;
    model->i_alpha = 0;
    model->i_m = model->n_alpha;
    model->i_u = model->i_m + model->n_material;
    model->n_velocity = (unsigned)scene->domain.n_velocity;
    model->i_E = model->i_u + model->n_velocity;
    model->i_inner = model->i_E + 1;
    model_solids(model);
    model->i_V = model->i_inner + model->n_inner;
    model_stretch_all(model);
    model->i_normal = model->n_field;
    model->split = model_is_split(model);
    model->tilted = model->split && model->dim > 1;
    if (model->tilted) model->n_normal = (unsigned)model->dim;
    model->n_field += model->n_normal;
    model_pair_up(model);
    model->i_slant = model->n_field;
    model->n_slant = scene->scheme.slanted ? (unsigned)model->dim : 0;
    model->n_field += model->n_slant;
    model_family_all(model);
    model->kapila = scene->scheme.closure == SCENE_KAPILA && model->n_alpha > 0;
    model->lagged = model->split || model_jumps(model);
    model->forced = model_is_forced(scene) || model_jumps(model) || model_turns(model);
    model->linear = true;
    for (unsigned l = 0; l < model->n_material; l++) {
        model_law_open(model, l);
        if (!model->eos[l].law->linear) model->linear = false;
    }
    model_transport(model);
    model_conduct(model);
    model->thermal = scene->scheme.exchange == SCENE_EXCHANGE_AUTO
                         ? !model->linear || model->conducts || model->n_phase || model->n_fick
                         : scene->scheme.exchange == SCENE_EXCHANGE_FULL;
    model->limiter = model_limit(&scene->scheme.limiter);
    model->limiter_alpha = model_limit(&scene->scheme.interface_limiter);
    model->limiter_along = model_limit(scene_instance_along(&scene->scheme));
    model->reconstruction = scene->scheme.reconstruction.module->table;
    model->reconstruction_self = scene->scheme.reconstruction.self;
    model->riemann = scene->scheme.riemann.module->table;
    model->riemann_self = scene->scheme.riemann.self;
    model->resists = model_resists(model->riemann);
    const struct registry_entry *robust = registry_find("riemann", "rusanov");
    model->robust = robust ? robust->module->table : model->riemann;
    model->mixed = model->n_alpha > 0;
    for (unsigned q = 0; q < model->n_field; q++) model->active[model->n_active++] = q;
    model_name_fields(model);
    model_name_derived(model);
    for (unsigned l = 0; l < model->n_alpha; l++) model->pure[l] = model_narrow(model, l, 1); /* with the names */
    model->fluids = model_liquefy(model);
    return model;
}

static void model_free_names(char **names)
{
    for (char **name = names; name && *name; name++) mem_free(*name);
    mem_free(names);
}

void model_free(struct model *model)
{
    if (!model) return;
    for (unsigned l = 0; l < model->n_alpha; l++) mem_free(model->pure[l]);
    mem_free(model->fluids);
    model_free_names(model->names);
    model_free_names(model->field_names);
    mem_free(model);
}
