/* scene_tension.c - surface tension between pairs of materials, and layers that begin in balance with it. */
#include "case/scene_draft.h"

#include "base/mem.h"

#include <string.h>

/* Index of a material by name, or -1 after an error. */
static int scene_tension_material(struct draft *draft, const struct keys_value *pair, const char *name)
{
    struct keys_value named = *pair;
    named.name = name;
    return scene_matter_index(draft, &named);
}

bool scene_tension_split(struct draft *draft, const struct keys_value *pair, unsigned *ret_one, unsigned *ret_other)
{
    const char *plus = strchr(pair->name, '+');
    if (!plus || strchr(plus + 1, '+')) {
        keys_error(&draft->keys, pair, "'%s' is no pair of materials", pair->name);
        diag_help(draft->keys.diag, "write two names with a + between them, as in 'water+air'");
        return false;
    }
    char *first = mem_text_n(pair->name, (size_t)(plus - pair->name));
    int one = scene_tension_material(draft, pair, first), other = scene_tension_material(draft, pair, plus + 1);
    mem_free(first);
    if (one >= 0 && one == other) keys_error(&draft->keys, pair, "a material has no surface tension with itself");
    if (one < 0 || other < 0 || one == other) return false;
    *ret_one = (unsigned)one;
    *ret_other = (unsigned)other;
    return true;
}

unsigned scene_tension_find(const struct scene *scene, unsigned one, unsigned other)
{
    for (unsigned k = 0; k < scene->n_tension; k++) {
        const struct scene_tension *old = &scene->tension[k];
        if (old->one == one && old->other == other) return k;
        if (old->one == other && old->other == one) return k;
    }
    return scene->n_tension;
}

/* What is computed so far. */
static void scene_tension_geometry(struct draft *draft, const struct keys_value *section)
{
    const struct scene_domain *domain = &draft->scene->domain;
    if (domain->dim == 1 && domain->geometry == SCENE_CARTESIAN) {
        keys_error(&draft->keys, section, "interfaces are flat here: surface tension would do nothing");
        diag_help(draft->keys.diag, "give the domain 'geometry: spherical' or 'geometry: axisymmetric'");
    }
}

/* An interface that leaves the finest level takes its curvature from coarser cells. */
static void scene_tension_levels(struct draft *draft, const struct keys_value *section)
{
    const struct scene_mesh *mesh = &draft->scene->mesh;
    bool follows = mesh->levels == 0;
    for (unsigned i = 0; i < mesh->n_refine; i++) follows = follows || mesh->refines[i].kind == SCENE_REFINE_INTERFACE;
    if (follows) return;
    diag_warn(draft->keys.diag, &section->node->mark,
              "surface tension acts where materials meet, but nothing refines there");
    diag_help(draft->keys.diag, "add '{interface: %s}' to mesh.refine",
              draft->scene->material[draft->scene->tension[0].other].name);
}

void scene_tension(struct draft *draft)
{
    const struct keys_value *section = keys_at(draft->root, "surface-tension");
    struct scene *scene = draft->scene;
    if (!section->node) return;
    if (scene->n_material == 1)
        keys_error(&draft->keys, section, "surface tension is between two materials, and there is one");
    if (section->count > SCENE_PAIRS)
        keys_error(&draft->keys, section, "%u pairs are more than %d", section->count, SCENE_PAIRS);
    for (unsigned i = 0; i < section->count && scene->n_tension < SCENE_PAIRS && scene->n_material > 1; i++) {
        struct scene_tension pair = {.sigma = section->list[i].number};
        if (!section->list[i].given || !scene_tension_split(draft, &section->list[i], &pair.one, &pair.other)) continue;
        if (scene_tension_find(scene, pair.one, pair.other) < scene->n_tension)
            keys_error(&draft->keys, &section->list[i], "this pair has a surface tension already");
        else scene->tension[scene->n_tension++] = pair;
    }
    scene_tension_geometry(draft, section);
    if (scene->n_tension) scene_tension_levels(draft, section);
}

/* The one material of a layer, or -1. */
static int scene_tension_alone(const struct scene *scene, const struct scene_layer *layer)
{
    for (unsigned l = 0; layer->fractions && l < scene->n_material; l++)
        if (layer->fractions[l] == 1.0) return (int)l;
    return -1;
}

/* sigma between a layer and the one that it is painted on; 0: none. */
static double scene_tension_below(const struct scene *scene, unsigned index)
{
    int one = scene_tension_alone(scene, &scene->layers[index]), other = -1;
    for (unsigned i = 0; i < index; i++)
        if (scene->layers[i].has_material) other = scene_tension_alone(scene, &scene->layers[i]);
    for (unsigned k = 0; k < scene->n_tension; k++) {
        int a = (int)scene->tension[k].one, b = (int)scene->tension[k].other;
        if ((a == one && b == other) || (a == other && b == one)) return scene->tension[k].sigma;
    }
    return 0.0;
}

/* Around an axis a sphere beside it is a ring, whose curvature varies. */
static bool scene_tension_rings(const struct scene_domain *domain, const struct shape *shape)
{
    return domain->geometry == SCENE_AXISYMMETRIC && domain->dim == 2 && shape->a[0] != 0.0;
}

void scene_tension_balance(struct draft *draft, const struct keys_value *balance, unsigned index)
{
    struct scene *scene = draft->scene;
    struct scene_layer *layer = &scene->layers[index];
    double sigma = scene_tension_below(scene, index);
    if (!balance->given) return;
    if (!layer->shape || layer->shape->type != SHAPE_SPHERE) {
        keys_error(&draft->keys, balance, "only a sphere is in balance with its surface tension");
    } else if (scene_tension_rings(&scene->domain, layer->shape)) {
        keys_error(&draft->keys, balance, "a sphere beside the axis is a ring: no one pressure balances it");
    } else if (layer->pressure.script || !layer->pressure.given) {
        keys_error(&draft->keys, balance, "this needs the pressure outside of the sphere as a number");
        diag_help(draft->keys.diag, "give 'pressure: 1 atm'; %s sigma/R is added to it",
                  scene_domain_turns(&scene->domain) > 1 ? "2" : "1");
    } else if (!(sigma > 0.0)) {
        keys_error(&draft->keys, balance, "the material has no surface tension with the one that it is painted on");
        diag_help(draft->keys.diag, "give it: 'surface-tension: {water+air: 72.8 mN/m}'");
    } else {
        layer->pressure.number += scene_domain_turns(&scene->domain) * sigma / layer->shape->radius;
    }
}
