/* scene_source.c - what acts throughout the domain: body forces, heating, sources of mass.
 *
 * Forces, heating and mass are what research asks for. Rates of fractions and of the stretch stand for no device: they
 * complete manufactured solutions, whose fields are chosen first and whose sources follow from the equations. */
#include "case/scene_draft.h"

#include "base/mem.h"

static const struct key scene_source_stretch_rows[] = {
#define RATE(word, text)                                              \
    {                                                                 \
        .name = word, .type = KEYS_VALUE, .unit = "1/s", .doc = text, \
    }
    RATE("xx", "Of the component along the first axis."),
    RATE("yy", "Of the component along the second axis."),
    RATE("zz", "Of the component along the third axis, or around the axis or the centre."),
    RATE("xy", "Shear, where velocities have two components."),
    RATE("xz", "Shear, where velocities have three components."),
    RATE("yz", "Shear, where velocities have three components."),
#undef RATE
    {0},
};

static const struct keys_section scene_source_stretch = {.name = "stretch-rate",
                                                         .doc = "How fast the stretch of the solids is changed.",
                                                         .keys = scene_source_stretch_rows};

static const struct key scene_source_rows[] = {
    {.name = "acceleration",
     .type = KEYS_VALUE,
     .many = KEYS_LIST,
     .unit = "m/s2",
     .doc = "Body force per mass, such as gravity; one component per component of the velocity."},
    {.name = "force",
     .type = KEYS_VALUE,
     .many = KEYS_LIST,
     .unit = "N/m3",
     .doc = "Body force per volume, such as acoustic radiation force; one component per component of the velocity."},
    {.name = "heating",
     .type = KEYS_VALUE,
     .many = KEYS_ONE_OR_NAMED,
     .unit = "W/m3",
     .doc = "Power per volume, such as absorbed light or ultrasound; by material: per volume of that material."},
    {.name = "mass",
     .type = KEYS_VALUE,
     .many = KEYS_NAMED,
     .unit = "kg/m3/s",
     .doc =
         "Mass of a material that appears per volume and time, in the state that the material has there; where it is "
         "absent none does."},
    {.name = "fractions",
     .type = KEYS_VALUE,
     .many = KEYS_NAMED,
     .unit = "1/s",
     .doc = "Rate of volume fractions, for manufactured solutions."},
    {.name = "stretch",
     .type = KEYS_SECTION,
     .section = &scene_source_stretch,
     .doc = "Rate of the stretch of the solids, for manufactured solutions."},
    {.name = "lua",
     .type = KEYS_TEXT,
     .doc =
         "File or block: function(x, y, z, t) that returns a table of sources, {force = {...}, heating = ...}, which "
         "are added to the others."},
    {0},
};

const struct keys_section scene_source_keys = {
    .name = "sources",
    .doc = "What acts throughout the domain, per volume; r in expressions is the distance from the origin.",
    .keys = scene_source_rows,
    .rules = "{'minProperties': 1, 'errorMessage': 'At least one source is needed.'}"};

/* A value for each material that the map names, or one for all into `whole` (NULL: there is no such thing). */
static void scene_source_by_material(struct draft *draft, const struct keys_value *value, struct scene_value *whole,
                                     struct scene_value *ret)
{
    if (!value->given) return;
    if (whole && value->node->kind != TREE_MAP) {
        *whole = scene_state_value(value);
        return;
    }
    for (unsigned i = 0; i < value->count; i++) {
        int material = scene_matter_index(draft, &value->list[i]);
        if (material >= 0) ret[material] = scene_state_value(&value->list[i]);
    }
}

static void scene_source_fractions(struct draft *draft, const struct keys_value *value, struct scene_value *ret)
{
    scene_source_by_material(draft, value, NULL, ret);
    if (value->given && draft->scene->n_material == 1)
        keys_error(&draft->keys, value, "one material has no volume fraction");
}

static void scene_source_stretches(struct draft *draft, const struct keys_value *value, struct scene_value ret[6])
{
    const struct scene *scene = draft->scene;
    if (!value->node) return;
    if (!scene_matter_solid(draft)) {
        keys_error(&draft->keys, value, "a stretch is for solids, and no material has a 'constitutive' law");
        return;
    }
    for (unsigned c = 0; c < 6; c++) {
        const struct keys_value *rate = keys_at(value->map, scene_source_stretch_rows[c].name);
        ret[c] = scene_state_value(rate);
        if (rate->node && scene->domain.dim > 0 && scene->domain.n_velocity < scene_stretch_needs(c))
            keys_error(&draft->keys, rate, "velocities have %d component%s here: there is no such shear",
                       scene->domain.n_velocity, scene->domain.n_velocity == 1 ? "" : "s");
    }
}

void scene_source(struct draft *draft)
{
    const struct keys_value *sources = keys_at(draft->root, "sources");
    const struct keys_map *map = sources->map;
    if (!map) return;
    struct scene_sources *ret = draft->scene->sources = mem_new(1, sizeof *ret);
    scene_state_vector(draft, keys_at(map, "acceleration"), ret->value + SCENE_SOURCE_ACCELERATION);
    scene_state_vector(draft, keys_at(map, "force"), ret->value + SCENE_SOURCE_FORCE);
    scene_source_by_material(draft, keys_at(map, "heating"), ret->value + SCENE_SOURCE_HEATING,
                             ret->value + SCENE_SOURCE_HEATING_OF);
    scene_source_by_material(draft, keys_at(map, "mass"), NULL, ret->value + SCENE_SOURCE_MASS);
    scene_source_fractions(draft, keys_at(map, "fractions"), ret->value + SCENE_SOURCE_FRACTION);
    scene_source_stretches(draft, keys_at(map, "stretch"), ret->value + SCENE_SOURCE_STRETCH);
    if (keys_at(map, "lua")->given) ret->script = scene_file_lua(draft, keys_at(map, "lua"));
    if (map->node->count == 0) keys_error(&draft->keys, sources, "at least one source is needed");
}
