/* scene_domain.c - the region, its cells and its faces. */
#include "case/scene_draft.h"

#include "base/mem.h"

#include <math.h>
#include <string.h>

static const struct key scene_domain_boundaries[] = {
    {.name = "x-", .type = KEYS_SECTION, .section = &scene_boundary_keys, .doc = "Lower end of the first axis."},
    {.name = "x+", .type = KEYS_SECTION, .section = &scene_boundary_keys, .doc = "Upper end of the first axis."},
    {.name = "y-", .type = KEYS_SECTION, .section = &scene_boundary_keys, .doc = "Lower end of the second axis."},
    {.name = "y+", .type = KEYS_SECTION, .section = &scene_boundary_keys, .doc = "Upper end of the second axis."},
    {.name = "z-", .type = KEYS_SECTION, .section = &scene_boundary_keys, .doc = "Lower end of the third axis."},
    {.name = "z+", .type = KEYS_SECTION, .section = &scene_boundary_keys, .doc = "Upper end of the third axis."},
    {0},
};

/* A boundary of one of some types, written as a word or as a map. */
#define SCENE_DOMAIN_IS(types) \
    "{'anyOf': [{'enum': [" types "]}, {'type': 'object', 'properties': {'type': {'enum': [" types "]}}}]}"
#define SCENE_DOMAIN_AXIS SCENE_DOMAIN_IS("'axis'")
#define SCENE_DOMAIN_CENTRE SCENE_DOMAIN_IS("'axis', 'symmetry'")
#define SCENE_DOMAIN_PERIODIC SCENE_DOMAIN_IS("'periodic'")

/* Faces that are periodic come in pairs; only x- can be an axis (scene_boundary.c). */
#define SCENE_DOMAIN_PAIR(face, other)                                                                       \
    "{'if': {'required': ['" face "', '" other "'], 'properties': {'" face "': " SCENE_DOMAIN_PERIODIC "}}," \
    " 'then': {'properties': {'" other "': " SCENE_DOMAIN_PERIODIC "}}},"
#define SCENE_DOMAIN_PAIRS(axis) SCENE_DOMAIN_PAIR(axis "-", axis "+") SCENE_DOMAIN_PAIR(axis "+", axis "-")

static const char scene_domain_faces[] = SCENE_DOMAIN_PAIRS("x") SCENE_DOMAIN_PAIRS("y")
    SCENE_DOMAIN_PAIRS("z") "{'patternProperties': {'^(x[+]|y|z)': {'not': " SCENE_DOMAIN_AXIS "}}}";

/* Where the radius begins at 0 there is nothing to say but axis or symmetry; elsewhere x- is a face like others. */
#define SCENE_DOMAIN_GEOMETRY                                                                             \
    "{'if': {'properties': {'geometry': {'const': 'cartesian'}}}, 'then': {'properties': {'boundaries': " \
    "{'required': ['x-'], 'properties': {'x-': {'not': " SCENE_DOMAIN_AXIS "}}}}},"                       \
    " 'else': {'properties': {'lower': {'maxItems': 2, 'items': [{'minimum': 0}]}}}},"                    \
    "{'if': {'required': ['geometry', 'lower'], 'properties': {'geometry': {'enum': ['axisymmetric', "    \
    "'spherical']}, 'lower': {'items': [{'const': 0}]}}},"                                                \
    " 'then': {'properties': {'boundaries': {'properties': {'x-': " SCENE_DOMAIN_CENTRE "}}}}},"          \
    "{'if': {'required': ['geometry'], 'properties': {'geometry': {'const': 'spherical'}}},"              \
    " 'then': {'properties': {'lower': {'maxItems': 1}, 'velocity-components': false}}},"

/* The length of `lower` is the dimension, which all others follow; faces of axes that are not there are errors. */
#define SCENE_DOMAIN_AXES(n, faces, none)                                                                       \
    "{'if': {'required': ['lower'], 'properties': {'lower': {'minItems': " n ", 'maxItems': " n "}}}, 'then': " \
    "{'patternProperties': {'^(upper|cells)$': {'minItems': " n ", 'maxItems': " n "}}, 'properties': {"        \
    "'velocity-components': {'minimum': " n "}, "                                                               \
    "'boundaries': {'required': [" faces "], 'properties': {" none "}}}}},"

#define SCENE_DOMAIN_MOST "{'properties': {'lower': {'minItems': 1, 'maxItems': 3}}}"

static const char scene_domain_rules[] =
    SCENE_DOMAIN_GEOMETRY SCENE_DOMAIN_AXES("1", "'x+'", "'y-': false, 'y+': false, 'z-': false, 'z+': false")
        SCENE_DOMAIN_AXES("2", "'x+', 'y-', 'y+'", "'z-': false, 'z+': false")
            SCENE_DOMAIN_AXES("3", "'x+', 'y-', 'y+', 'z-', 'z+'", "") SCENE_DOMAIN_MOST;

static const struct keys_section scene_domain_boundaries_keys = {.name = "boundaries",
                                                                 .doc = "What lies behind each face of the domain.",
                                                                 .keys = scene_domain_boundaries,
                                                                 .rules = scene_domain_faces};

static const struct key scene_domain_rows[] = {
    {.name = "geometry",
     .type = KEYS_CHOICE,
     .choices = "cartesian|axisymmetric|spherical",
     .fallback = "cartesian",
     .doc = "Coordinates: x, y, z; or r, z; or r."},
    {.name = "lower",
     .type = KEYS_NUMBER,
     .many = KEYS_LIST,
     .unit = "m",
     .required = true,
     .doc = "Lower corner; its length is the dimension: [x], [x, y], [x, y, z], axisymmetric [r, z]."},
    {.name = "upper", .type = KEYS_NUMBER, .many = KEYS_LIST, .unit = "m", .required = true, .doc = "Upper corner."},
    {.name = "cells",
     .type = KEYS_INTEGER,
     .many = KEYS_LIST,
     .min = 1,
     .max = 1 << 24,
     .required = true,
     .doc = "Cells of the coarsest level along each axis."},
    {.name = "velocity-components",
     .type = KEYS_INTEGER,
     .min = 1,
     .max = 3,
     .doc = "Components of velocities, from the number of axes (the default) to 3: with more, matter also moves across "
            "the axes, as in the shear waves of a line. In an axisymmetric domain the third turns around the axis "
            "(swirl)."},
    {.name = "boundaries",
     .type = KEYS_SECTION,
     .section = &scene_domain_boundaries_keys,
     .required = true,
     .doc = "What lies behind each face of the domain: x-, x+, y-, ..."},
    {0},
};

const struct keys_section scene_domain_keys = {.name = "domain",
                                               .doc = "The region, its cells and its boundaries.",
                                               .keys = scene_domain_rows,
                                               .rules = scene_domain_rules};

bool scene_domain_vector(struct draft *draft, const struct keys_value *value, double ret[SCENE_AXES])
{
    int dim = draft->scene->domain.dim;
    for (int axis = 0; axis < SCENE_AXES; axis++) ret[axis] = 0.0;
    if (!value->given || dim == 0) return false;
    if (value->count != (unsigned)dim) {
        keys_error(&draft->keys, value, "%d number%s needed, one per axis of the domain, not %u", dim,
                   dim == 1 ? " is" : "s are", value->count);
        return false;
    }
    for (int axis = 0; axis < dim; axis++) ret[axis] = value->list[axis].number;
    return true;
}

bool scene_domain_direction(struct draft *draft, const struct keys_value *value, double ret[SCENE_AXES])
{
    if (!scene_domain_vector(draft, value, ret)) return false;
    double length = sqrt(ret[0] * ret[0] + ret[1] * ret[1] + ret[2] * ret[2]);
    for (int axis = 0; axis < SCENE_AXES; axis++) ret[axis] /= length;
    if (length > 0.0 && isfinite(length)) return true;
    keys_error(&draft->keys, value, "a direction is needed, not [0, ...]");
    return false;
}

/* The dimension is the length of `lower`, if that is a list of one to three. */
static int scene_domain_dim(struct draft *draft, const struct keys_value *lower)
{
    if (!lower->node || lower->node->kind != TREE_LIST) return 0;
    if (lower->count >= 1 && lower->count <= SCENE_AXES) return (int)lower->count;
    keys_error(&draft->keys, lower, "1, 2 or 3 numbers are needed, not %u", lower->count);
    return 0;
}

static void scene_domain_geometry(struct draft *draft, const struct keys_map *domain)
{
    struct scene *scene = draft->scene;
    const struct keys_value *geometry = keys_at(domain, "geometry"), *lower = keys_at(domain, "lower");
    scene->domain.geometry = (enum scene_geometry)geometry->integer;
    if (!geometry->given) scene->domain.dim = 0; /* what depends on it is not judged */
    if (scene->domain.geometry == SCENE_CARTESIAN || scene->domain.dim == 0) return;
    int most = scene->domain.geometry == SCENE_SPHERICAL ? 1 : 2;
    if (scene->domain.dim > most)
        keys_error(&draft->keys, geometry, "%s has %s, but 'lower' has %d numbers", geometry->text,
                   most == 1 ? "one axis, [r]" : "the axes [r, z]", scene->domain.dim);
    if (scene->domain.lower[0] < 0.0)
        keys_error(&draft->keys, &lower->list[0], "the first axis is the radius, which is not negative");
}

static void scene_domain_corners(struct draft *draft, const struct keys_map *domain)
{
    struct scene *scene = draft->scene;
    const struct keys_value *lower = keys_at(domain, "lower"), *upper = keys_at(domain, "upper");
    bool good = scene_domain_vector(draft, lower, scene->domain.lower);
    good &= scene_domain_vector(draft, upper, scene->domain.upper);
    for (int axis = 0; good && axis < scene->domain.dim; axis++)
        if (scene->domain.upper[axis] <= scene->domain.lower[axis])
            keys_error(&draft->keys, &upper->list[axis], "%g m is not above the lower end, %g m",
                       scene->domain.upper[axis], scene->domain.lower[axis]);
}

static void scene_domain_cells(struct draft *draft, const struct keys_map *domain)
{
    struct scene *scene = draft->scene;
    const struct keys_value *cells = keys_at(domain, "cells");
    for (int axis = 0; axis < SCENE_AXES; axis++) scene->domain.cells[axis] = 1;
    if (!cells->given || scene->domain.dim == 0) return;
    if (cells->count != (unsigned)scene->domain.dim) {
        keys_error(&draft->keys, cells, "%d integer%s needed, one per axis, not %u", scene->domain.dim,
                   scene->domain.dim == 1 ? " is" : "s are", cells->count);
        return;
    }
    for (int axis = 0; axis < scene->domain.dim; axis++) scene->domain.cells[axis] = (int)cells->list[axis].integer;
    const struct mark *mark = &cells->node->mark;
    scene->domain.cells_place = mem_print("%s:%d:%d", mark->source->name, mark->line, mark->column);
}

/* As many components as axes, or more; around a centre nothing tells them apart. */
static void scene_domain_velocity(struct draft *draft, const struct keys_map *domain)
{
    struct scene *scene = draft->scene;
    const struct keys_value *velocity = keys_at(domain, "velocity-components");
    scene->domain.n_velocity = scene->domain.dim;
    if (!velocity->given || scene->domain.dim == 0) return;
    if (scene->domain.geometry == SCENE_SPHERICAL)
        keys_error(&draft->keys, velocity, "in a spherical domain matter moves along the radius alone");
    else if (velocity->integer < scene->domain.dim)
        keys_error(&draft->keys, velocity, "%ld component%s less than the domain has axes, %d", velocity->integer,
                   velocity->integer == 1 ? " is" : "s are", scene->domain.dim);
    else scene->domain.n_velocity = (int)velocity->integer;
}

int scene_domain_axis(struct draft *draft, const struct keys_value *along)
{
    const struct scene *scene = draft->scene;
    if (!along->given || scene->domain.dim == 0) return -1;
    bool axial = along->integer > 2;
    int axis = along->integer == 3 ? 0 : along->integer == 4 ? 1 : (int)along->integer;
    if (axial && scene->domain.geometry == SCENE_CARTESIAN)
        keys_error(&draft->keys, along, "cartesian domains have no '%s': use x, y or z", along->text);
    else if (axis >= scene->domain.dim)
        keys_error(&draft->keys, along, "the domain has only %d ax%s", scene->domain.dim,
                   scene->domain.dim == 1 ? "is" : "es");
    return axis;
}

double scene_domain_width(const struct scene *scene, int axis)
{
    return ldexp((scene->domain.upper[axis] - scene->domain.lower[axis]) / scene->domain.cells[axis],
                 -scene->mesh.levels);
}

void scene_domain(struct draft *draft)
{
    const struct keys_map *domain = keys_at(draft->root, "domain")->map;
    draft->scene->domain.dim = scene_domain_dim(draft, keys_at(domain, "lower"));
    scene_domain_corners(draft, domain);
    scene_domain_geometry(draft, domain);
    scene_domain_cells(draft, domain);
    scene_domain_velocity(draft, domain);
}
