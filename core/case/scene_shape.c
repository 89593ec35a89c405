/* scene_shape.c - the words for regions, and the regions made from them. */
#include "case/scene_draft.h"

#include "base/mem.h"
#include "case/keys_read.h"

#include <math.h>
#include <string.h>

#define POINT(word, text)                                                                                \
    {                                                                                                    \
        .name = word, .type = KEYS_NUMBER, .many = KEYS_LIST, .unit = "m", .required = true, .doc = text \
    }
#define LENGTH(word, text)                                                                                        \
    {                                                                                                             \
        .name = word, .type = KEYS_NUMBER, .unit = "m", .min = KEYS_POSITIVE, .max = KEYS_MOST, .required = true, \
        .doc = text                                                                                               \
    }

static const struct key scene_shape_box[] = {POINT("lower", "Lower corner."), POINT("upper", "Upper corner."), {0}};
static const struct key scene_shape_half_space[] = {POINT("point", "A point of the plane."),
                                                    {.name = "normal",
                                                     .type = KEYS_NUMBER,
                                                     .many = KEYS_LIST,
                                                     .unit = "1",
                                                     .required = true,
                                                     .doc = "Direction that points into the region; any length."},
                                                    {0}};
static const struct key scene_shape_sphere[] = {POINT("center", "Centre."), LENGTH("radius", "Radius."), {0}};
static const struct key scene_shape_cylinder[] = {POINT("from", "Centre of one end."),
                                                  POINT("to", "Centre of the other end."),
                                                  LENGTH("radius", "Radius."),
                                                  {0}};
static const struct key scene_shape_ellipsoid[] = {POINT("center", "Centre."),
                                                   {.name = "semi-axes",
                                                    .type = KEYS_NUMBER,
                                                    .many = KEYS_LIST,
                                                    .unit = "m",
                                                    .min = KEYS_POSITIVE,
                                                    .max = KEYS_MOST,
                                                    .required = true,
                                                    .doc = "Half-lengths along the axes."},
                                                   {0}};
static const struct key scene_shape_ring[] = {POINT("center", "Centre."),
                                              LENGTH("outer", "Outer radius."),
                                              LENGTH("inner", "Inner radius."),
                                              {0}};
static const struct key scene_shape_polygon[] = {
    {.name = "vertices", .type = KEYS_TREE, .required = true, .doc = "List of [x, y], in order around the region."},
    {0}};

/* One number per axis of the domain; [x, y] of a polygon. */
#define SCENE_SHAPE_RULES                                                                                              \
    "{'properties': {'vertices': {'type': 'array', 'minItems': 3, 'items': {'type': 'array', 'minItems': 2, "          \
    "'maxItems': 2}}}}, {'patternProperties': {'^(lower|upper|point|normal|center|from|to|semi-axes)$': {'minItems': " \
    "1, 'maxItems': 3}}}"

#define SHAPE(variable, word, text)                                                                   \
    static const struct keys_section scene_shape_##variable##_keys = {.name = word,                   \
                                                                      .doc = text,                    \
                                                                      .keys = scene_shape_##variable, \
                                                                      .rules = SCENE_SHAPE_RULES};

SHAPE(box, "box", "A box along the axes.")
SHAPE(half_space, "half-space", "All on one side of a plane.")
SHAPE(sphere, "sphere", "A sphere; in 2D cartesian geometry a disc, in 1D an interval.")
SHAPE(cylinder, "cylinder", "A cylinder between two points, in 3D.")
SHAPE(ellipsoid, "ellipsoid", "An ellipsoid along the axes.")
SHAPE(ring, "ring", "A ring or spherical shell.")
SHAPE(polygon, "polygon", "A polygon in the plane of the first two axes.")

static const struct key scene_shape_rows[] = {
    {.name = "everywhere", .type = KEYS_FLAG, .doc = "The whole domain: `everywhere: true`."},
    {.name = "box", .type = KEYS_SECTION, .section = &scene_shape_box_keys, .doc = "A box along the axes."},
    {.name = "half-space",
     .type = KEYS_SECTION,
     .section = &scene_shape_half_space_keys,
     .doc = "All on one side of a plane."},
    {.name = "sphere",
     .type = KEYS_SECTION,
     .section = &scene_shape_sphere_keys,
     .doc = "A sphere; in 2D cartesian geometry a disc, in 1D an interval."},
    {.name = "cylinder", .type = KEYS_SECTION, .section = &scene_shape_cylinder_keys, .doc = "A cylinder, in 3D."},
    {.name = "ellipsoid",
     .type = KEYS_SECTION,
     .section = &scene_shape_ellipsoid_keys,
     .doc = "An ellipsoid along the axes."},
    {.name = "ring", .type = KEYS_SECTION, .section = &scene_shape_ring_keys, .doc = "A ring or spherical shell."},
    {.name = "polygon",
     .type = KEYS_SECTION,
     .section = &scene_shape_polygon_keys,
     .doc = "A polygon in the plane of the first two axes."},
    {.name = "surface",
     .type = KEYS_SECTION,
     .section = &scene_body_surface_keys,
     .doc = "What a closed surface of triangles encloses (an STL file), in 3D."},
    {.name = "image",
     .type = KEYS_SECTION,
     .section = &scene_body_image_keys,
     .doc = "The dark or bright part of a PNG image, in the plane of the first two axes."},
    {.name = "array",
     .type = KEYS_SECTION,
     .section = &scene_body_array_keys,
     .doc = "Where the values of an array (a NumPy file) are below or above one."},
    {.name = "rotated", .type = KEYS_SECTION, .section = &scene_body_turned_keys, .doc = "A shape, rotated."},
    {.name = "extruded",
     .type = KEYS_SECTION,
     .section = &scene_body_prism_keys,
     .doc = "A polygon or image between two places of the third axis."},
    {.name = "difference",
     .type = KEYS_SECTION,
     .many = KEYS_LIST,
     .section = &scene_shape_keys,
     .doc = "All of the first of several shapes that is in none of the others."},
    {.name = "complement", .type = KEYS_SECTION, .section = &scene_shape_keys, .doc = "All outside of a shape."},
    {.name = "union",
     .type = KEYS_SECTION,
     .many = KEYS_LIST,
     .section = &scene_shape_keys,
     .doc = "All that is in one of several shapes."},
    {.name = "intersection",
     .type = KEYS_SECTION,
     .many = KEYS_LIST,
     .section = &scene_shape_keys,
     .doc = "All that is in each of several shapes."},
    {0},
};

const struct keys_section scene_shape_keys = {.name = "shape",
                                              .doc = "A region.",
                                              .keys = scene_shape_rows,
                                              .choose = sizeof scene_shape_rows / sizeof *scene_shape_rows - 1,
                                              .rules = "{'properties': {'everywhere': {'const': true}}}"};

static bool scene_shape_corners(struct draft *draft, struct shape *shape, const struct keys_value *value)
{
    const struct keys_map *map = value->map;
    bool good = scene_domain_vector(draft, keys_at(map, "lower"), shape->a);
    good &= scene_domain_vector(draft, keys_at(map, "upper"), shape->b);
    for (int axis = 0; good && axis < draft->scene->domain.dim; axis++) {
        if (shape->b[axis] > shape->a[axis]) continue;
        keys_error(&draft->keys, &keys_at(map, "upper")->list[axis], "%g m is not above the lower end, %g m",
                   shape->b[axis], shape->a[axis]);
        good = false;
    }
    return good;
}

static bool scene_shape_plane(struct draft *draft, struct shape *shape, const struct keys_value *value)
{
    const struct keys_map *map = value->map;
    bool good = scene_domain_vector(draft, keys_at(map, "point"), shape->a);
    return scene_domain_direction(draft, keys_at(map, "normal"), shape->b) && good;
}

static bool scene_shape_ball(struct draft *draft, struct shape *shape, const struct keys_value *value)
{
    const struct keys_map *map = value->map;
    const struct keys_value *inner = keys_at(map, "inner");
    bool ring = shape->type == SHAPE_RING, good = scene_domain_vector(draft, keys_at(map, "center"), shape->a);
    shape->radius = keys_at(map, ring ? "outer" : "radius")->number;
    shape->inner = inner->number;
    good &= shape->radius > 0.0;
    if (ring && inner->given && shape->inner >= shape->radius) {
        keys_error(&draft->keys, inner, "the inner radius is not less than the outer one");
        good = false;
    }
    return good;
}

static bool scene_shape_oval(struct draft *draft, struct shape *shape, const struct keys_value *value)
{
    const struct keys_map *map = value->map;
    bool good = scene_domain_vector(draft, keys_at(map, "center"), shape->a);
    good &= scene_domain_vector(draft, keys_at(map, "semi-axes"), shape->b);
    return good;
}

static bool scene_shape_rod(struct draft *draft, struct shape *shape, const struct keys_value *value)
{
    const struct keys_map *map = value->map;
    bool good = scene_domain_vector(draft, keys_at(map, "from"), shape->a);
    good &= scene_domain_vector(draft, keys_at(map, "to"), shape->b);
    shape->radius = keys_at(map, "radius")->number;
    good &= shape->radius > 0.0;
    const struct keys_value here = {.node = map->node, .path = map->path};
    if (draft->scene->domain.dim != 3) {
        keys_error(&draft->keys, &here, "a cylinder needs three axes; in fewer use a box or a sphere (a disc in 2D)");
        return false;
    }
    if (good && memcmp(shape->a, shape->b, sizeof shape->a) == 0) {
        keys_error(&draft->keys, &here, "the two ends are the same point");
        return false;
    }
    return good;
}

/* A list of numbers, read with a row of its own. */
const struct keys_value *scene_shape_vertex(struct draft *draft, struct node *node, const char *path)
{
    static const struct key vertex[] = {{.name = "vertex", .type = KEYS_NUMBER, .many = KEYS_LIST, .unit = "m"}, {0}};
    static const struct keys_section section = {.name = "vertex", .keys = vertex};
    struct node *map = tree_map(draft->keys.forest, &node->mark);
    tree_set(draft->keys.forest, map, "vertex", node);
    return keys_at(keys_read(&draft->keys, map, &section, path), "vertex");
}

/* One [x, y] of a polygon. */
static bool scene_shape_corner(struct draft *draft, struct node *node, const char *path, double ret[2])
{
    const struct keys_value *value = scene_shape_vertex(draft, node, path);
    if (value->given && value->count != 2)
        keys_error(&draft->keys, value, "two numbers are needed, not %u", value->count);
    if (!value->given || value->count != 2) return false;
    for (int i = 0; i < 2; i++) ret[i] = value->list[i].number;
    return true;
}

static bool scene_shape_outline(struct draft *draft, struct shape *shape, const struct keys_value *value)
{
    const struct keys_map *map = value->map;
    const struct keys_value *vertices = keys_at(map, "vertices");
    if (!vertices->given || draft->scene->domain.dim == 0) return false;
    if (draft->scene->domain.dim < 2 || vertices->node->kind != TREE_LIST || vertices->node->count < 3) {
        keys_error(&draft->keys, vertices,
                   draft->scene->domain.dim < 2 ? "a polygon needs two axes"
                                                : "a list of at least three [x, y] is needed");
        return false;
    }
    bool good = true;
    shape->n = vertices->node->count;
    shape->vertex = mem_new(shape->n, sizeof *shape->vertex);
    for (unsigned i = 0; i < shape->n; i++) {
        const char *path = tree_print(draft->keys.forest, "%s[%u]", vertices->path, i);
        good &= scene_shape_corner(draft, vertices->node->items[i], path, shape->vertex[i]);
    }
    return good;
}

static bool scene_shape_everywhere(struct draft *draft, struct shape *shape, const struct keys_value *value)
{
    (void)shape;
    if (value->given && !value->integer) keys_error(&draft->keys, value, "only 'everywhere: true' makes sense");
    return value->given;
}

static bool scene_shape_surface(struct draft *draft, struct shape *shape, const struct keys_value *value)
{
    return scene_body_surface(draft, shape, value->map);
}

static bool scene_shape_image(struct draft *draft, struct shape *shape, const struct keys_value *value)
{
    return scene_body_raster(draft, shape, value->map, true);
}

static bool scene_shape_array(struct draft *draft, struct shape *shape, const struct keys_value *value)
{
    return scene_body_raster(draft, shape, value->map, false);
}

static struct shape *scene_shape_of(struct draft *draft, const struct keys_map *map, bool wanted,
                                    const struct keys_value **ret_value);

/* The shape within a word that has one. */
static struct shape *scene_shape_within(struct draft *draft, const struct keys_value *value)
{
    const struct keys_value *which;
    return value->map ? scene_shape_of(draft, keys_at(value->map, "shape")->map, true, &which) : NULL;
}

static bool scene_shape_turned(struct draft *draft, struct shape *shape, const struct keys_value *value)
{
    struct shape *part = scene_shape_within(draft, value);
    return part && scene_body_turned(draft, shape, part, value->map);
}

static bool scene_shape_prism(struct draft *draft, struct shape *shape, const struct keys_value *value)
{
    struct shape *part = scene_shape_within(draft, value);
    return part && scene_body_prism(draft, shape, part, value->map);
}

static bool scene_shape_parts(struct draft *draft, struct shape *shape, const struct keys_value *value)
{
    bool list = value->key->many == KEYS_LIST, good = true;
    unsigned count = list ? value->count : 1;
    const struct keys_value *which;
    shape->parts = mem_new(count + 1, sizeof *shape->parts);
    for (unsigned i = 0; i < count; i++) {
        struct shape *part = scene_shape_of(draft, list ? value->list[i].map : value->map, true, &which);
        if (part) shape->parts[shape->n++] = part;
        good &= part != NULL;
    }
    if (list && count == 0) keys_error(&draft->keys, value, "at least one shape is needed");
    return good && count > 0;
}

/* The first, and what is outside of each other one. */
static bool scene_shape_difference(struct draft *draft, struct shape *shape, const struct keys_value *value)
{
    bool good = scene_shape_parts(draft, shape, value);
    for (unsigned i = 1; i < shape->n; i++) {
        struct shape *outside = mem_new(1, sizeof *outside);
        *outside = (struct shape){.type = SHAPE_COMPLEMENT, .n = 1, .parts = mem_new(1, sizeof *outside->parts)};
        outside->parts[0] = shape->parts[i];
        shape->parts[i] = outside;
    }
    return good;
}

/* The words, what they make and who reads it. */
static const struct scene_shape_word {
    const char *name;
    enum shape_type type;
    bool (*read)(struct draft *draft, struct shape *shape, const struct keys_value *value);
} scene_shape_words[] = {
    {"everywhere", SHAPE_EVERYWHERE, scene_shape_everywhere},
    {"box", SHAPE_BOX, scene_shape_corners},
    {"half-space", SHAPE_HALF_SPACE, scene_shape_plane},
    {"sphere", SHAPE_SPHERE, scene_shape_ball},
    {"cylinder", SHAPE_CYLINDER, scene_shape_rod},
    {"ellipsoid", SHAPE_ELLIPSOID, scene_shape_oval},
    {"ring", SHAPE_RING, scene_shape_ball},
    {"polygon", SHAPE_POLYGON, scene_shape_outline},
    {"surface", SHAPE_SURFACE, scene_shape_surface},
    {"image", SHAPE_RASTER, scene_shape_image},
    {"array", SHAPE_RASTER, scene_shape_array},
    {"rotated", SHAPE_TURNED, scene_shape_turned},
    {"extruded", SHAPE_INTERSECTION, scene_shape_prism},
    {"difference", SHAPE_INTERSECTION, scene_shape_difference},
    {"complement", SHAPE_COMPLEMENT, scene_shape_parts},
    {"union", SHAPE_UNION, scene_shape_parts},
    {"intersection", SHAPE_INTERSECTION, scene_shape_parts},
    {NULL, SHAPE_EVERYWHERE, NULL},
};

static struct shape *scene_shape_of(struct draft *draft, const struct keys_map *map, bool wanted,
                                    const struct keys_value **ret_value)
{
    const struct keys_value *found = NULL;
    const struct scene_shape_word *chosen = NULL;
    for (const struct scene_shape_word *word = scene_shape_words; map && word->name; word++) {
        const struct keys_value *value = keys_at(map, word->name);
        if (value->node && found) {
            keys_error(&draft->keys, value, "one shape is enough: '%s' is already given", found->key->name);
            diag_help(draft->keys.diag, "'union' and 'intersection' combine shapes");
            return NULL;
        }
        if (!value->node) continue;
        found = value;
        chosen = word;
    }
    if (!found) {
        if (!map || !wanted) return NULL;
        diag_error(draft->keys.diag, &map->node->mark, "%s: a shape is missing", map->path);
        diag_help(
            draft->keys.diag,
            "one of everywhere, box, half-space, sphere, cylinder, ellipsoid, ring, polygon, surface, image, array, "
            "rotated, extruded, difference, complement, union, intersection");
        return NULL;
    }
    *ret_value = found;
    struct shape *shape = mem_new(1, sizeof *shape);
    shape->type = chosen->type;
    bool readable = found->map || found->key->type != KEYS_SECTION || found->key->many == KEYS_LIST;
    if (readable && chosen->read(draft, shape, found)) return shape;
    shape_free(shape);
    return NULL;
}

struct shape *scene_shape(struct draft *draft, const struct keys_map *map, bool wanted,
                          const struct keys_value **ret_value)
{
    *ret_value = NULL;
    return scene_shape_of(draft, map, wanted, ret_value);
}
