/* scene_initial.c - the initial state: layers of paint, in the order of the file. */
#include "case/scene_draft.h"

#include "base/mem.h"
#include "case/keys_read.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

static const struct keys_section scene_initial_state = {.name = "state",
                                                        .base = &scene_shape_keys,
                                                        .keys = scene_state_rows};

static const struct key scene_initial_checkpoint_rows[] = {
    {.name = "file", .type = KEYS_TEXT, .required = true, .doc = "A checkpoint, `checkpoints/CASE_STEP.chk` of a run."},
    {.name = "at",
     .type = KEYS_NUMBER,
     .many = KEYS_LIST,
     .unit = "m",
     .doc = "Where the origin of that run's coordinates (the centre of a spherical one) lies here; the origin if not "
            "given."},
    {.name = "axis",
     .type = KEYS_CHOICE,
     .choices = "x|y|z",
     .doc = "Of an axisymmetric run in a 3D scene: the axis along which its own lies, z if not given."},
    {0},
};

static const struct keys_section scene_initial_checkpoint_keys = {
    .name = "checkpoint",
    .doc = "The state of another run: of the same geometry and number of axes, spherical in an axisymmetric or 3D "
           "scene, or "
           "axisymmetric in a 3D scene.",
    .keys = scene_initial_checkpoint_rows};

static const struct key scene_initial_rows[] = {
    {.name = "stretch",
     .type = KEYS_SECTION,
     .section = &scene_stretch_keys,
     .doc = "Initial stretch of a solid: [xx, yy, zz] or a map of components."},
    {.name = "balance",
     .type = KEYS_CHOICE,
     .choices = "tension",
     .doc = "`tension`: the pressure is the one outside of a sphere, and sigma times the curvature (2/R of a ball, 1/R "
            "of a disc or around an axis in one dimension) is added to it."},
    {.name = "lua",
     .type = KEYS_TEXT,
     .doc = "File or block: function(x, y, z) that returns a table of named fields, {pressure = ..., alpha = {...}}."},
    {.name = "repeat",
     .type = KEYS_TREE,
     .doc = "The layer many times: names that its expressions use, each with how often (counted from 0) or [first, "
            "last]."},
    {.name = "cloud",
     .type = KEYS_SECTION,
     .section = &scene_cloud_keys,
     .doc = "Many spheres at random places instead of a shape."},
    {.name = "checkpoint",
     .type = KEYS_SECTION,
     .section = &scene_initial_checkpoint_keys,
     .doc = "The state of another run, where it has one."},
    {0},
};

/* A shape or `lua`; with a material a whole state; with `lua` none of its own (scene_initial_layer). */
#define SCENE_INITIAL_RULES                                                                                            \
    "{'if': {'not': {'anyOf': [{'required': ['lua']}, {'required': ['checkpoint']}]}}, 'then': {'oneOf': "             \
    "[{'required': ['everywhere']}, {'required': ['box']},"                                                            \
    "{'required': ['half-space']}, {'required': ['sphere']}, {'required': ['cylinder']}, {'required': ['ellipsoid']}," \
    "{'required': ['ring']}, {'required': ['polygon']}, {'required': ['surface']}, {'required': ['image']},"           \
    "{'required': ['array']}, {'required': ['rotated']}, {'required': ['extruded']}, {'required': ['difference']},"    \
    "{'required': ['complement']}, {'required': ['union']},"                                                           \
    "{'required': ['intersection']}, {'required': ['cloud']}]},"                                                       \
    " 'else': {'properties': {'material': false, 'fractions': false, 'density': false, 'temperature': false,"          \
    " 'pressure': false, 'velocity': false, 'stretch': false, 'balance': false}}},"                                    \
    "{'if': {'not': {'required': ['lua']}, 'anyOf': [{'required': ['material']}, {'required': ['fractions']}]},"       \
    " 'then': {'anyOf': [{'required': ['density', 'pressure']}, {'required': ['temperature', 'pressure']},"            \
    " {'required': ['density', 'temperature']}]}},"                                                                    \
    "{'not': {'required': ['density', 'temperature', 'pressure']}},"                                                   \
    "{'if': {'required': ['fractions'], 'properties': {'fractions': {'minProperties': 2, 'additionalProperties': "     \
    "{'type': 'number', 'exclusiveMinimum': 0}}}},"                                                                    \
    " 'then': {'required': ['pressure'], 'properties': {'density': {'type': 'object'}}}}"

const struct keys_section scene_initial_keys = {.name = "layer",
                                                .doc = "A region and the state in it; without a material only the "
                                                       "given fields change.",
                                                .base = &scene_initial_state,
                                                .keys = scene_initial_rows,
                                                .rules = SCENE_INITIAL_RULES};

/* r in expressions is measured from the centre of round shapes, else from the origin. */
static void scene_initial_centre(struct scene_layer *layer)
{
    const struct shape *shape = layer->shape;
    if (!shape) return;
    bool round = shape->type == SHAPE_SPHERE || shape->type == SHAPE_ELLIPSOID || shape->type == SHAPE_RING;
    if (round) memcpy(layer->centre, shape->a, sizeof layer->centre);
}

/* A shape with a unit that was forgotten lies far outside, or covers all. */
static void scene_initial_look(struct draft *draft, const struct scene_layer *layer, const struct keys_value *value)
{
    const struct scene *scene = draft->scene;
    if (!layer->shape || layer->shape->type == SHAPE_EVERYWHERE || scene->domain.dim == 0) return;
    for (int axis = 0; axis < scene->domain.dim; axis++)
        if (scene->domain.upper[axis] <= scene->domain.lower[axis]) return;
    double covered = shape_fraction(layer->shape, scene->domain.lower, scene->domain.upper, scene->domain.dim, 0);
    if (covered < 1.0 && shape_reaches(layer->shape, scene->domain.lower, scene->domain.upper, scene->domain.dim))
        return;
    diag_warn(draft->keys.diag, &value->node->mark, "%s: this shape %s", value->path,
              covered > 0.0 ? "covers the whole domain" : "lies outside of the domain");
    diag_help(draft->keys.diag, "the domain is %g to %g m along the first axis: are the units right?",
              scene->domain.lower[0], scene->domain.upper[0]);
}

static void scene_initial_need(struct draft *draft, const struct keys_map *map, const char *what, const char *help)
{
    diag_error(draft->keys.diag, &map->node->mark, "%s: %s", map->path, what);
    diag_help(draft->keys.diag, "%s", help);
}

/* Is the key there, or a misspelt one that is reported already? */
static bool scene_initial_says(const struct keys_map *map, const char *name)
{
    return keys_at(map, name)->node || keys_at(map, name)->meant;
}

/* What a layer with a material must say: everything that makes a state. */
static void scene_initial_complete(struct draft *draft, struct scene_layer *layer, const struct keys_map *map)
{
    bool density = scene_initial_says(map, "density"), temperature = scene_initial_says(map, "temperature");
    bool pressure = scene_initial_says(map, "pressure");
    unsigned present = 0;
    if (density && temperature && pressure && keys_at(map, "temperature")->node) {
        keys_error(&draft->keys, keys_at(map, "temperature"),
                   "density and pressure make a state, and so a temperature");
        diag_help(draft->keys.diag, "give two of 'density', 'pressure' and 'temperature'");
    }
    if (!layer->has_material) return;
    for (unsigned i = 0; layer->fractions && i < draft->scene->n_material; i++) present += layer->fractions[i] > 0.0;
    if (!density && !temperature)
        scene_initial_need(draft, map, "the density is missing", "give 'density: 998.2 kg/m3' or 'temperature: 300 K'");
    if (!pressure && !(density && temperature && present < 2))
        scene_initial_need(draft, map, "the pressure is missing", "give 'pressure: 101325 Pa'");
}

static void scene_initial_lua_alone(struct draft *draft, const struct keys_map *map, const char *name)
{
    if (keys_at(map, name)->node)
        keys_error(&draft->keys, keys_at(map, name), "a layer that is made by 'lua' has no '%s' of its own", name);
}

static void scene_initial_lua(struct draft *draft, struct scene_layer *layer, const struct keys_map *map)
{
    layer->script = scene_file_lua(draft, keys_at(map, "lua"));
    for (const struct key *row = scene_state_rows; row->name; row++) scene_initial_lua_alone(draft, map, row->name);
    scene_initial_lua_alone(draft, map, "stretch");
    scene_initial_lua_alone(draft, map, "balance");
}

/* Snapshots are what people look at: they are rounded, and lack what a state needs. */
static void scene_initial_snapshot(struct draft *draft, const struct keys_value *file)
{
    size_t length = strlen(file->text);
    if (length < 4 || strcmp(file->text + length - 4, ".hdf") != 0) return;
    keys_error(&draft->keys, file, "'%s' is a snapshot, whose numbers are rounded: a run goes on from a checkpoint",
               file->text);
    diag_help(draft->keys.diag,
              "let that run write some: 'output: {checkpoints: {every: 10 us}}'; they are in checkpoints/");
}

/* A layer out of a checkpoint is where that run was, and says all. */
static void scene_initial_checkpoint(struct draft *draft, struct scene_layer *layer, const struct keys_map *map)
{
    const struct keys_value *checkpoint = keys_at(map, "checkpoint");
    const struct keys_value *file = keys_at(checkpoint->map, "file"), *at = keys_at(checkpoint->map, "at");
    for (unsigned i = 0; i < map->count; i++) {
        const struct keys_value *value = &map->values[i];
        if (value->node && value != checkpoint)
            keys_error(&draft->keys, value, "a layer that is made of a 'checkpoint' has no '%s' of its own",
                       value->key->name);
    }
    const struct keys_value *axis = keys_at(checkpoint->map, "axis");
    if (at->node) scene_domain_vector(draft, at, layer->at);
    layer->axis = axis->given ? (int)axis->integer : -1;
    if (!file->given) return;
    scene_initial_snapshot(draft, file);
    const char *path = scene_file(draft, file);
    layer->checkpoint = mem_text(path);
    if (access(path, R_OK) == 0) return;
    keys_error(&draft->keys, file, "'%s' cannot be read: %s", path, strerror(errno));
    diag_help(draft->keys.diag,
              "a run writes checkpoints where 'output.checkpoints' says 'every:', or when it is stopped");
}

static void scene_initial_layer(struct draft *draft, struct scene_layer *layer, const struct keys_map *map)
{
    const struct keys_value *lua = keys_at(map, "lua"), *shape = NULL;
    if (!map) return;
    layer->line = map->node->mark.line;
    if (keys_at(map, "checkpoint")->node) {
        scene_initial_checkpoint(draft, layer, map);
        return;
    }
    layer->shape = scene_shape(draft, map, !lua->node, &shape);
    if (shape) scene_initial_look(draft, layer, shape);
    scene_initial_centre(layer);
    if (lua->given) {
        scene_initial_lua(draft, layer, map);
        return;
    }
    layer->has_material = keys_at(map, "material")->node || keys_at(map, "fractions")->node;
    layer->fractions = scene_state_fractions(draft, map);
    layer->density = scene_state_density(draft, map, layer->fractions);
    layer->temperature = scene_state_value(keys_at(map, "temperature"));
    layer->pressure = scene_state_value(keys_at(map, "pressure"));
    scene_state_vector(draft, keys_at(map, "velocity"), layer->velocity);
    scene_stretch(draft, layer, keys_at(map, "stretch"));
    scene_initial_complete(draft, layer, map);
    scene_state_check(draft, map, layer->fractions, layer->density);
}

/* Every cell needs a state: the layers that give a whole one must cover the domain. */
static void scene_initial_cover(struct draft *draft, const struct keys_value *initial)
{
    const struct scene *scene = draft->scene;
    struct shape all = {.type = SHAPE_UNION};
    all.parts = mem_new(scene->n_layer + 1, sizeof *all.parts);
    for (unsigned i = 0; i < scene->n_layer; i++) {
        const struct scene_layer *layer = &scene->layers[i];
        bool whole = layer->has_material || layer->script || layer->checkpoint;
        if (whole && layer->shape && layer->shape->type != SHAPE_EVERYWHERE) all.parts[all.n++] = layer->shape;
        else if (whole) all.type = SHAPE_EVERYWHERE;
    }
    double covered = 1.0;
    if (all.type == SHAPE_UNION)
        covered = all.n ? shape_fraction(&all, scene->domain.lower, scene->domain.upper, scene->domain.dim, 0) : 0.0;
    if (covered < 0.999) {
        keys_error(&draft->keys, initial, "%.3g %% of the domain get no state", 100.0 * (1.0 - covered));
        diag_help(draft->keys.diag,
                  "begin with a layer '{everywhere: true, material: ..., density: ..., pressure: ...}'");
    }
    mem_free(all.parts);
}

/* Puts the spheres of clouds into the list of layers, and reads it anew. */
static void scene_initial_clouds(struct draft *draft)
{
    const struct keys_value *initial = keys_at(draft->root, "initial");
    struct node *layers = tree_list(draft->keys.forest, &initial->node->mark);
    bool any = false;
    for (unsigned i = 0; i < initial->count; i++) {
        const struct keys_value *layer = &initial->list[i], *cloud = keys_at(layer->map, "cloud");
        any = any || cloud->node;
        struct node *some = cloud->node ? scene_cloud(draft, cloud, layer->node) : NULL;
        if (!some) tree_append(draft->keys.forest, layers, layer->node);
        for (unsigned k = 0; some && k < some->count; k++) tree_append(draft->keys.forest, layers, some->items[k]);
    }
    if (!any || diag_errors(draft->keys.diag)) return;
    initial->node->items = layers->items;
    initial->node->count = layers->count;
    keys_read_again(&draft->keys, draft->root, "initial");
}

void scene_initial(struct draft *draft)
{
    if (keys_at(draft->root, "initial")->given && draft->scene->domain.dim > 0) scene_initial_clouds(draft);
    const struct keys_value *initial = keys_at(draft->root, "initial");
    struct scene *scene = draft->scene;
    unsigned before = diag_errors(draft->keys.diag);
    scene->layers = mem_new(initial->count + 1, sizeof *scene->layers);
    scene->n_layer = initial->count;
    for (unsigned i = 0; i < initial->count; i++) {
        if (keys_at(initial->list[i].map, "cloud")->node) continue; /* it has been refused */
        scene_initial_layer(draft, &scene->layers[i], initial->list[i].map);
        scene_tension_balance(draft, keys_at(initial->list[i].map, "balance"), i);
    }
    if (initial->given && scene->domain.dim > 0 && diag_errors(draft->keys.diag) == before)
        scene_initial_cover(draft, initial);
}
