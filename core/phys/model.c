/* model.c - a scene's fields and laws, resolved once so that kernels meet only indices and calls. */
#include "phys/model.h"

#include "base/mem.h"
#include "plug/registry.h"

#include <math.h>
#include <stddef.h>

/* A density for points where the material is absent: any well-posed value serves, because its
 * weight is zero there; the first density the case gives keeps tables and Newton at home. */
static double model_fill_density(const struct scene *scene, unsigned l, const struct model_eos *eos)
{
    for (unsigned i = 0; i < scene->n_layer; i++) {
        const struct scene_layer *layer = &scene->layers[i];
        if (!layer->has_material || !layer->fractions || !layer->density) continue;
        const struct scene_value *density = &layer->density[l];
        if (layer->fractions[l] > 0 && density->given && !density->script) return density->number;
    }
    double p = 101325.0, T = 300.0, rho = 0.0;
    eos->law->density(eos->self, 1, &p, &T, &rho);
    return rho > 0 && isfinite(rho) ? rho : 1.0;
}

static void model_name_fields(struct model *model)
{
    static const char *const momentum[] = {"momentum_x", "momentum_y", "momentum_z"};
    unsigned at = 0;
    model->field_names = mem_new(model->n_field + 1, sizeof *model->field_names);
    for (unsigned l = 0; l < model->n_alpha; l++)
        model->field_names[at++] = mem_print("alpha_%s", model->scene->material[l].name);
    for (unsigned l = 0; l < model->n_material; l++)
        model->field_names[at++] = mem_print("partial_density_%s", model->scene->material[l].name);
    for (int d = 0; d < model->dim; d++) model->field_names[at++] = mem_text(momentum[d]);
    model->field_names[at] = mem_text("total_energy");
}

/* Names that derive.c understands for this scene. */
static void model_name_derived(struct model *model)
{
    static const char *const plain[] = {"density",    "pressure",        "velocity",     "velocity_x",
                                        "velocity_y", "velocity_z",      "temperature",  "sound_speed",
                                        "mach",       "internal_energy", "total_energy", "vorticity",
                                        "schlieren",  "level",           "rank",         "cost"};
    size_t n_plain = sizeof plain / sizeof *plain, n_each = 4, at = 0;
    model->names = mem_new(n_plain + n_each * model->n_material + 1, sizeof *model->names);
    for (size_t i = 0; i < n_plain; i++) model->names[at++] = mem_text(plain[i]);
    for (unsigned l = 0; l < model->n_material; l++) {
        const char *name = model->scene->material[l].name;
        model->names[at++] = mem_print("alpha_%s", name);
        model->names[at++] = mem_print("density_%s", name);
        model->names[at++] = mem_print("temperature_%s", name);
        model->names[at++] = mem_print("partial_density_%s", name);
    }
}

/* The model of a region that holds nothing but material l: works on the same blocks, leaves the
 * fractions and the other materials' components alone, and gives bitwise what the full model would. */
static struct model *model_purify(const struct model *model, unsigned l)
{
    struct model *pure = mem_new(1, sizeof *pure);
    *pure = *model;
    pure->n_material = 1;
    pure->n_alpha = 0;
    pure->first = l;
    pure->i_m = model->i_m + l;
    pure->kapila = false;
    pure->eos[0] = model->eos[l];
    pure->linear = model->eos[l].law->linear != NULL;
    pure->n_active = 0;
    pure->active[pure->n_active++] = pure->i_m;
    for (unsigned q = model->i_u; q < model->n_field; q++) pure->active[pure->n_active++] = q;
    return pure;
}

struct model *model_new(const struct scene *scene)
{
    struct model *model = mem_new(1, sizeof *model);
    model->scene = scene;
    model->dim = scene->dim;
    model->beta = (int)scene->geometry;
    model->n_material = scene->n_material;
    model->n_alpha = scene->n_material > 1 ? scene->n_material : 0;
    model->i_alpha = 0;
    model->i_m = model->n_alpha;
    model->i_u = model->i_m + model->n_material;
    model->i_E = model->i_u + (unsigned)scene->dim;
    model->n_field = model->i_E + 1;
    model->kapila = scene->closure == SCENE_KAPILA && model->n_alpha > 0;
    model->linear = true;
    for (unsigned l = 0; l < model->n_material; l++) {
        const struct instance *instance = &scene->material[l].eos;
        struct model_eos *eos = &model->eos[l];
        eos->law = instance->module->table;
        eos->self = instance->self;
        eos->rho_fill = model_fill_density(scene, l, eos);
        if (!eos->law->linear) model->linear = false;
    }
    model->limiter = (struct model_limiter){scene->limiter.module->table, scene->limiter.self};
    model->limiter_alpha =
        (struct model_limiter){scene->interface_limiter.module->table, scene->interface_limiter.self};
    model->riemann = scene->riemann.module->table;
    model->riemann_self = scene->riemann.self;
    const struct registry_entry *robust = registry_find("riemann", "rusanov");
    model->robust = robust ? robust->module->table : model->riemann;
    model->mixed = model->n_alpha > 0;
    for (unsigned q = 0; q < model->n_field; q++) model->active[model->n_active++] = q;
    for (unsigned l = 0; l < model->n_alpha; l++) model->pure[l] = model_purify(model, l);
    model_name_fields(model);
    model_name_derived(model);
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
    model_free_names(model->names);
    model_free_names(model->field_names);
    mem_free(model);
}
