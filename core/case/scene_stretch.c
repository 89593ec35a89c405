/* scene_stretch.c - the initial stretch of a solid: what a layer may say about it.
 *
 * A list [xx, yy, zz] or a map of components; the rest is that of the identity. Only its shape counts: painting
 * divides it by the cube root of its determinant (paint_values.c, which also judges expressions). */
#include "case/scene_draft.h"

static const struct key scene_stretch_rows[] = {
#define DIAGONAL(word, text)                                                                 \
    {                                                                                        \
        .name = word, .type = KEYS_VALUE, .unit = "1", .min = 1e-6, .max = 1e6, .doc = text, \
    }
    DIAGONAL("xx", "Along the first axis (the radius in curved geometries)."),
    DIAGONAL("yy", "Along the second axis, or across a line; around the centre in spherical geometry, equal to zz."),
    DIAGONAL("zz", "Along the third axis, or across a plane; around the axis or the centre in curved geometries."),
#undef DIAGONAL
    {.name = "xy", .type = KEYS_VALUE, .unit = "1", .doc = "Shear, where velocities have two components."},
    {.name = "xz", .type = KEYS_VALUE, .unit = "1", .doc = "Shear, where velocities have three components."},
    {.name = "yz", .type = KEYS_VALUE, .unit = "1", .doc = "Shear, where velocities have three components."},
    {0},
};

const struct keys_section scene_stretch_keys = {
    .name = "stretch",
    .doc = "The symmetric left stretch of a solid, [xx, yy, zz] or components by name; those that are not given are 1 "
           "on the diagonal and 0 beside it. It is divided by the cube root of its determinant: volume is a matter of "
           "the density.",
    .keys = scene_stretch_rows,
    .positional = 3};

int scene_stretch_needs(unsigned component)
{
    return component < 3 ? 1 : component == 3 ? 2 : 3;
}

static bool scene_stretch_identity(const struct scene_value V[6])
{
    for (unsigned c = 0; c < 6; c++)
        if (V[c].given && (V[c].script || V[c].number != (c < 3 ? 1.0 : 0.0))) return false;
    return true;
}

/* Are numbers, as far as all are numbers, those of a positive definite tensor? */
static bool scene_stretch_definite(const struct scene_value V[6])
{
    double v[6];
    for (unsigned c = 0; c < 6; c++) {
        if (V[c].script) return true;
        v[c] = V[c].given ? V[c].number : c < 3 ? 1.0 : 0.0;
    }
    double minor = v[0] * v[1] - v[3] * v[3];
    double det = minor * v[2] - v[0] * v[5] * v[5] + 2.0 * v[3] * v[4] * v[5] - v[1] * v[4] * v[4];
    return v[0] > 0.0 && minor > 0.0 && det > 0.0;
}

/* Does the layer bring a material, and is that no solid? Then its name. */
static const char *scene_stretch_fluid(const struct draft *draft, const struct scene_layer *layer)
{
    const struct scene *scene = draft->scene;
    const char *fluid = NULL;
    for (unsigned l = 0; layer->fractions && l < scene->n_material; l++) {
        if (layer->fractions[l] <= 0.0) continue;
        if (scene_matter_is_solid(draft, l)) return NULL;
        fluid = scene->material[l].name;
    }
    return fluid;
}

/* Records components that no velocity of this scene can change. */
static bool scene_stretch_components(struct draft *draft, const struct keys_map *map)
{
    const struct scene *scene = draft->scene;
    bool good = true;
    for (unsigned c = 0; c < 6; c++) {
        const struct keys_value *value = keys_at(map, scene_stretch_rows[c].name);
        if (!value->node || scene->domain.dim == 0 || scene->domain.n_velocity >= scene_stretch_needs(c)) continue;
        keys_error(&draft->keys, value, "velocities have %d component%s here: there is no such shear",
                   scene->domain.n_velocity, scene->domain.n_velocity == 1 ? "" : "s");
        if (scene->domain.geometry == SCENE_CARTESIAN)
            diag_help(draft->keys.diag, "'velocity-components: %d' under 'domain' gives motion across the axes",
                      scene_stretch_needs(c));
        good = false;
    }
    return good;
}

/* What the numbers say, as far as they are numbers. */
static void scene_stretch_judge(struct draft *draft, const struct scene_layer *layer, const struct keys_value *value)
{
    const struct scene_value *V = layer->stretch;
    const char *fluid = scene_stretch_fluid(draft, layer);
    bool round = draft->scene->domain.geometry == SCENE_SPHERICAL && !V[1].script && !V[2].script;
    double yy = V[1].given ? V[1].number : 1.0, zz = V[2].given ? V[2].number : 1.0;
    if (fluid && !scene_stretch_identity(V))
        keys_error(&draft->keys, value, "'%s' is a fluid, which keeps no stretch", fluid);
    else if (!scene_stretch_definite(V))
        keys_error(&draft->keys, value, "this is no stretch: it has principal values that are not above 0");
    else if (round && yy != zz)
        keys_error(&draft->keys, value, "yy and zz both stand around the centre and are equal, not %g and %g", yy, zz);
}

void scene_stretch(struct draft *draft, struct scene_layer *layer, const struct keys_value *value)
{
    if (!value->node) return;
    if (!scene_matter_solid(draft)) {
        keys_error(&draft->keys, value, "a stretch is for solids, and no material has a 'constitutive' law");
        return;
    }
    if (!value->map) return;
    for (unsigned c = 0; c < 6; c++)
        layer->stretch[c] = scene_state_value(keys_at(value->map, scene_stretch_rows[c].name));
    if (scene_stretch_components(draft, value->map)) scene_stretch_judge(draft, layer, value);
}
