/* scene_state.c - a state of matter as a case writes it: of layers of paint and of inflows. */
#include "case/scene_draft.h"

#include "base/mem.h"
#include "bulla/eos.h"

#include <math.h>
#include <string.h>

const struct key scene_state_rows[] = {
    {.name = "material", .type = KEYS_TEXT, .doc = "The only material here."},
    {.name = "fractions",
     .type = KEYS_NUMBER,
     .many = KEYS_NAMED,
     .unit = "1",
     .min = 0,
     .max = 1,
     .doc = "Volume fractions by material; they add up to 1."},
    {.name = "density",
     .type = KEYS_VALUE,
     .many = KEYS_ONE_OR_NAMED,
     .unit = "kg/m3",
     .min = KEYS_POSITIVE,
     .max = KEYS_MOST,
     .doc = "Density of the material, or a map of densities by material."},
    {.name = "temperature",
     .type = KEYS_VALUE,
     .unit = "K",
     .min = KEYS_POSITIVE,
     .max = KEYS_MOST,
     .doc = "Temperature, instead of densities or of the pressure."},
    {.name = "pressure", .type = KEYS_VALUE, .unit = "Pa", .doc = "Pressure."},
    {.name = "velocity",
     .type = KEYS_VALUE,
     .many = KEYS_LIST,
     .unit = "m/s",
     .doc = "Velocity, one component per axis, or as many as `domain.velocity-components` says."},
    {0},
};

struct scene_value scene_state_value(const struct keys_value *value)
{
    return (struct scene_value){value->given, value->number, value->script};
}

static double *scene_state_shares(struct draft *draft, const struct keys_value *fractions)
{
    double *shares = mem_new(draft->scene->n_material + 1, sizeof *shares), sum = 0.0;
    bool good = fractions->given;
    for (unsigned i = 0; i < fractions->count; i++) {
        int material = scene_matter_index(draft, &fractions->list[i]);
        good &= material >= 0;
        if (material >= 0) shares[material] = fractions->list[i].number;
        sum += fractions->list[i].number;
    }
    if (good && fabs(sum - 1.0) > 1e-9) {
        keys_error(&draft->keys, fractions, "the volume fractions add up to %.10g, not to 1", sum);
        good = false;
    }
    if (good) return shares;
    mem_free(shares);
    return NULL;
}

double *scene_state_fractions(struct draft *draft, const struct keys_map *map)
{
    const struct keys_value *name = keys_at(map, "material"), *fractions = keys_at(map, "fractions");
    if (name->node && fractions->node) {
        keys_error(&draft->keys, fractions, "either 'material' or 'fractions', not both");
        return NULL;
    }
    if (fractions->node) return scene_state_shares(draft, fractions);
    int material = name->node ? scene_matter_index(draft, name) : -1;
    if (material < 0) return NULL;
    double *shares = mem_new(draft->scene->n_material, sizeof *shares);
    shares[material] = 1.0;
    return shares;
}

/* The material that a single density belongs to, or -1. */
static int scene_state_single(const struct scene *scene, const double *fractions)
{
    int found = -1;
    if (!fractions) return scene->n_material == 1 ? 0 : -1;
    for (unsigned i = 0; i < scene->n_material; i++) {
        if (fractions[i] <= 0.0) continue;
        if (found >= 0) return -1;
        found = (int)i;
    }
    return found;
}

static void scene_state_single_density(struct draft *draft, const struct keys_value *density, const double *fractions,
                                       struct scene_value *ret)
{
    int material = scene_state_single(draft->scene, fractions);
    if (material >= 0) {
        ret[material] = scene_state_value(density);
        return;
    }
    keys_error(&draft->keys, density, "which material has this density? A map is needed");
    diag_help(draft->keys.diag, "write 'density: {%s: ..., %s: ...}'", draft->scene->material[0].name,
              draft->scene->material[1].name);
}

struct scene_value *scene_state_density(struct draft *draft, const struct keys_map *map, const double *fractions)
{
    const struct keys_value *density = keys_at(map, "density");
    const struct scene *scene = draft->scene;
    struct scene_value *values = mem_new(scene->n_material + 1, sizeof *values);
    bool described = keys_at(map, "material")->node || keys_at(map, "fractions")->node;
    if (density->given && density->node->kind != TREE_MAP) {
        if (fractions || !described) scene_state_single_density(draft, density, fractions, values);
        return values;
    }
    for (unsigned i = 0; i < density->count; i++) {
        int material = scene_matter_index(draft, &density->list[i]);
        if (material >= 0) values[material] = scene_state_value(&density->list[i]);
    }
    for (unsigned i = 0; density->given && fractions && i < scene->n_material; i++)
        if (fractions[i] > 0.0 && !values[i].given)
            keys_error(&draft->keys, density, "the density of '%s' is missing", scene->material[i].name);
    return values;
}

void scene_state_vector(struct draft *draft, const struct keys_value *value, struct scene_value ret[SCENE_AXES])
{
    int n = draft->scene->domain.n_velocity, dim = draft->scene->domain.dim;
    if (!value->given || dim == 0) return;
    if (value->count != (unsigned)n) {
        keys_error(&draft->keys, value, "%d component%s needed, %s, not %u", n, n == 1 ? " is" : "s are",
                   n == dim ? "one per axis" : "as 'domain.velocity-components' says", value->count);
        if (n == dim && value->count <= SCENE_AXES && value->count > (unsigned)n &&
            draft->scene->domain.geometry == SCENE_CARTESIAN)
            diag_help(draft->keys.diag, "for motion across the axes give the domain 'velocity-components: %u'",
                      value->count);
        return;
    }
    for (int axis = 0; axis < n; axis++) ret[axis] = scene_state_value(&value->list[axis]);
}

/* Is the state of one material one that its law knows? A forgotten sign or prefix shows here. */
static bool scene_state_check_one(struct draft *draft, unsigned material, double rho, double p,
                                  const struct keys_value *pressure)
{
    const struct instance *eos = &draft->scene->material[material].eos;
    const char *name = draft->scene->material[material].name;
    if (!eos->module) return false;
    const struct bulla_eos *law = eos->module->table;
    double rho_e, c2, least;
    law->p_min(eos->self, 1, &rho, &least);
    law->state(eos->self, 1, &rho, &p, &rho_e, &c2);
    if (p > least && c2 > 0.0 && isfinite(c2) && isfinite(rho_e)) return true;
    keys_error(&draft->keys, pressure, "%.6g Pa at %.6g kg/m3 is no state of '%s'", p, rho, name);
    diag_help(draft->keys.diag, "the pressure of '%s' is above %.6g Pa there", name, least + 0.0);
    return false;
}

/* What says the density of a material: its entry of a map, the only density, or the temperature. */
static const struct keys_value *scene_state_source(const struct keys_map *map, const char *material)
{
    const struct keys_value *density = keys_at(map, "density");
    for (unsigned i = 0; i < density->count; i++)
        if (density->list[i].name && strcmp(density->list[i].name, material) == 0) return &density->list[i];
    return density->given ? density : keys_at(map, "temperature");
}

void scene_state_check(struct draft *draft, const struct keys_map *map, const double *fractions,
                       const struct scene_value *density)
{
    const struct keys_value *pressure = keys_at(map, "pressure"), *temperature = keys_at(map, "temperature");
    if (!pressure->given || pressure->script || !fractions) return;
    for (unsigned i = 0; i < draft->scene->n_material; i++) {
        const struct instance *eos = &draft->scene->material[i].eos;
        double rho = density[i].number, p = pressure->number;
        bool warm = temperature->given && !temperature->script && eos->module;
        if (fractions[i] <= 0.0 || density[i].script || !(density[i].given || warm)) continue;
        if (warm) ((const struct bulla_eos *)eos->module->table)->density(eos->self, 1, &p, &temperature->number, &rho);
        if (scene_state_check_one(draft, i, rho, p, pressure))
            scene_far(draft, i, rho, p, warm ? temperature->number : 0.0,
                      scene_state_source(map, draft->scene->material[i].name));
    }
}
