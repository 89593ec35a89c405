/* scene_body.c - shapes from files: closed surfaces (STL), images (PNG), arrays (NumPy); and shapes that are turned. */
#include "case/scene_draft.h"

#include "base/mem.h"
#include "base/status.h"
#include "case/raster.h"
#include "case/surface.h"

#include <math.h>
#include <string.h>

#define SCENE_BODY_STRETCH 0.02 /* that far pixels may be from square */

#define POINT(word, must, text)                                                                          \
    {                                                                                                    \
        .name = word, .type = KEYS_NUMBER, .many = KEYS_LIST, .unit = "m", .required = must, .doc = text \
    }
#define FILE_NAME(text)                                                  \
    {                                                                    \
        .name = "file", .type = KEYS_TEXT, .required = true, .doc = text \
    }

static const struct key scene_body_surface_rows[] = {
    FILE_NAME("An STL file, text or binary."),
    {.name = "scale",
     .type = KEYS_NUMBER,
     .unit = "m",
     .min = KEYS_POSITIVE,
     .max = KEYS_MOST,
     .required = true,
     .doc = "Length of 1 in the file: `1 mm`."},
    POINT("center", false, "Where the middle of the box around it lies; as in the file if not given."),
    {0}};

static const struct key scene_body_image_rows[] = {
    FILE_NAME("A PNG image."),
    POINT("lower", true, "Lower corner of the image, [x, y]."),
    POINT("upper", true, "Upper corner of the image, [x, y]."),
    {.name = "inside", .type = KEYS_CHOICE, .choices = "dark|bright", .fallback = "dark", .doc = "What is the region."},
    {.name = "threshold",
     .type = KEYS_NUMBER,
     .unit = "1",
     .max = 1.0,
     .fallback = "0.5",
     .doc = "Grey at its edge: 0 is black, 1 is white."},
    {0}};

static const struct key scene_body_array_rows[] = {
    FILE_NAME("A file of numpy.save with as many axes as the domain, [x, y, z]."),
    POINT("lower", true, "Lower corner of the array."),
    POINT("upper", true, "Upper corner of the array."),
    {.name = "inside",
     .type = KEYS_CHOICE,
     .choices = "below|above",
     .fallback = "below",
     .doc = "What is the region."},
    {.name = "threshold",
     .type = KEYS_NUMBER,
     .unit = "1",
     .min = -KEYS_MOST,
     .max = KEYS_MOST,
     .fallback = "0",
     .doc = "The value at its edge."},
    {0}};

static const struct key scene_body_turned_rows[] = {
    {.name = "shape", .type = KEYS_SECTION, .section = &scene_shape_keys, .required = true, .doc = "What is turned."},
    {.name = "angle",
     .type = KEYS_NUMBER,
     .unit = "rad",
     .min = -KEYS_MOST,
     .max = KEYS_MOST,
     .required = true,
     .doc = "By how much, counterclockwise seen against the axis: `30 deg`."},
    POINT("about", false, "A point of the axis; the origin if not given."),
    {.name = "axis",
     .type = KEYS_NUMBER,
     .many = KEYS_LIST,
     .unit = "1",
     .doc = "Direction of the axis, in three dimensions; z if not given."},
    {0}};

static const struct key scene_body_prism_rows[] = {{.name = "shape",
                                                    .type = KEYS_SECTION,
                                                    .section = &scene_shape_keys,
                                                    .required = true,
                                                    .doc = "Its cross-section: a polygon or an image."},
                                                   {.name = "from",
                                                    .type = KEYS_NUMBER,
                                                    .unit = "m",
                                                    .min = -KEYS_MOST,
                                                    .max = KEYS_MOST,
                                                    .required = true,
                                                    .doc = "Its lower end."},
                                                   {.name = "to",
                                                    .type = KEYS_NUMBER,
                                                    .unit = "m",
                                                    .min = -KEYS_MOST,
                                                    .max = KEYS_MOST,
                                                    .required = true,
                                                    .doc = "Its upper end."},
                                                   {0}};

/* One number per axis of what they place. */
#define SCENE_BODY_RULES "{'patternProperties': {'^(lower|upper|center|about|axis)$': {'minItems': 1, 'maxItems': 3}}}"
#define BODY(variable, word, text)                                                                  \
    const struct keys_section scene_body_##variable##_keys = {.name = word,                         \
                                                              .doc = text,                          \
                                                              .keys = scene_body_##variable##_rows, \
                                                              .rules = SCENE_BODY_RULES};

BODY(surface, "surface", "What a closed surface of triangles encloses, in 3D.")
BODY(image, "image", "The dark or bright part of an image, in the plane of the first two axes.")
BODY(array, "array", "Where the values of an array are below or above one.")
BODY(turned, "rotated", "A shape, rotated.")
BODY(prism, "extruded", "A prism along the third axis.")

static const double SCENE_BODY_STILL[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};

static bool scene_body_refuse(struct draft *draft, const struct keys_value *value, const char *help)
{
    keys_error(&draft->keys, value, "%s", status_text());
    if (help) diag_help(draft->keys.diag, "%s", help);
    return false;
}

bool scene_body_surface(struct draft *draft, struct shape *shape, const struct keys_map *map)
{
    const struct keys_value *file = keys_at(map, "file"), *scale = keys_at(map, "scale"),
                            *centre = keys_at(map, "center");
    double at[3], lower[3], upper[3], offset[3] = {0.0};
    if (!file->given || !scale->given || (centre->node && !scene_domain_vector(draft, centre, at))) return false;
    if (draft->scene->domain.dim != 3) {
        keys_error(&draft->keys, file, "a surface needs three axes");
        diag_help(draft->keys.diag, "in fewer draw its cross-section: polygon, image, array");
        return false;
    }
    shape->surface = mem_new(1, sizeof *shape->surface);
    if (surface_read(scene_file(draft, file), shape->surface)) return scene_body_refuse(draft, file, NULL);
    surface_bounds(shape->surface, lower, upper);
    for (int d = 0; d < 3 && centre->node; d++) offset[d] = at[d] - scale->number * 0.5 * (lower[d] + upper[d]);
    surface_place(shape->surface, SCENE_BODY_STILL, scale->number, offset);
    return true;
}

/* The box of an array of so many axes; axes that it has not are 0. */
static bool scene_body_box(struct draft *draft, const struct keys_map *map, int dim, double ret[2][3])
{
    const struct keys_value *ends[2] = {keys_at(map, "lower"), keys_at(map, "upper")};
    for (int side = 0; side < 2; side++) {
        if (!ends[side]->given) return false;
        if (ends[side]->count != (unsigned)dim) {
            keys_error(&draft->keys, ends[side], "%d numbers are needed, not %u", dim, ends[side]->count);
            return false;
        }
        for (int d = 0; d < 3; d++) ret[side][d] = d < dim ? ends[side]->list[d].number : 0.0;
    }
    for (int d = 0; d < dim; d++) {
        if (ret[1][d] > ret[0][d]) continue;
        keys_error(&draft->keys, &ends[1]->list[d], "%g m is not above the lower end, %g m", ret[1][d], ret[0][d]);
        return false;
    }
    return true;
}

/* Pixels are square on screens: an image that is stretched was probably given the size of another one. */
static void scene_body_square(struct draft *draft, const struct keys_value *upper, const struct raster *raster,
                              const double box[2][3])
{
    double wide = (box[1][0] - box[0][0]) / (double)raster->n[0], high = (box[1][1] - box[0][1]) / (double)raster->n[1];
    if (fabs(wide - high) <= SCENE_BODY_STRETCH * wide) return;
    diag_warn(draft->keys.diag, &upper->node->mark,
              "%s: an image of %zu x %zu pixels is stretched: they are %.4g m wide and %.4g m high", upper->path,
              raster->n[0], raster->n[1], wide, high);
    diag_help(draft->keys.diag, "it has its own shape with 'upper: [%.6g m, %.6g m]'", box[1][0],
              box[0][1] + wide * (double)raster->n[1]);
}

bool scene_body_raster(struct draft *draft, struct shape *shape, const struct keys_map *map, bool image)
{
    const struct keys_value *file = keys_at(map, "file"), *threshold = keys_at(map, "threshold");
    int dim = draft->scene->domain.dim;
    double box[2][3];
    if (!file->given || !threshold->given || dim == 0 || !scene_body_box(draft, map, image ? 2 : dim, box))
        return false;
    if (image && dim < 2) {
        keys_error(&draft->keys, file, "an image needs two axes");
        return false;
    }
    struct raster *raster = shape->raster = mem_new(1, sizeof *raster);
    const char *path = scene_file(draft, file);
    if (image ? raster_read_image(path, raster) : raster_read_array(path, raster))
        return scene_body_refuse(draft, file, NULL);
    if (!image && raster->dim != dim) {
        keys_error(&draft->keys, file, "the array has %d axes, the domain %d", raster->dim, dim);
        return false;
    }
    if (image) scene_body_square(draft, keys_at(map, "upper"), raster, box);
    bool turn = keys_at(map, "inside")->integer != 0; /* dark and below are what is less */
    if (raster_place(raster, box[0], box[1], threshold->number, turn ? -1.0 : 1.0))
        return scene_body_refuse(draft, threshold, "'inside' and 'threshold' say which values are");
    return true;
}

/* The rotation about a unit vector (Rodrigues). */
static void scene_body_rotation(const double axis[3], double angle, double ret[3][3])
{
    double c = cos(angle), s = sin(angle);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int k = 3 - i - j; /* of two different axes: the third */
            double across = i == j ? 0.0 : ((j - i + 3) % 3 == 1 ? -1.0 : 1.0) * axis[k];
            ret[i][j] = (i == j ? c : 0.0) + (1.0 - c) * axis[i] * axis[j] + s * across;
        }
}

static bool scene_body_axis(struct draft *draft, const struct keys_value *value, double ret[3])
{
    ret[0] = ret[1] = 0.0;
    ret[2] = 1.0;
    if (!value->node) return true;
    if (draft->scene->domain.dim != 3) {
        keys_error(&draft->keys, value, "in the plane shapes turn about its normal alone");
        return false;
    }
    return scene_domain_direction(draft, value, ret);
}

/* A box in the plane is a polygon, and a turned polygon is one: its volume stays exact. */
static void scene_body_outline(struct shape *shape, struct shape *part)
{
    if (part->type == SHAPE_BOX) {
        part->n = 4;
        part->vertex = mem_new(4, sizeof *part->vertex);
        for (int k = 0; k < 4; k++) {
            part->vertex[k][0] = k == 0 || k == 3 ? part->a[0] : part->b[0];
            part->vertex[k][1] = k < 2 ? part->a[1] : part->b[1];
        }
    }
    for (unsigned k = 0; k < part->n; k++) {
        double x = part->vertex[k][0] - shape->a[0], y = part->vertex[k][1] - shape->a[1];
        for (int d = 0; d < 2; d++) part->vertex[k][d] = shape->a[d] + shape->turn[d][0] * x + shape->turn[d][1] * y;
    }
    shape->type = SHAPE_POLYGON;
    shape->n = part->n;
    shape->vertex = part->vertex;
    part->vertex = NULL;
    shape_free(part);
}

bool scene_body_turned(struct draft *draft, struct shape *shape, struct shape *part, const struct keys_map *map)
{
    const struct keys_value *angle = keys_at(map, "angle"), *about = keys_at(map, "about");
    double axis[3];
    bool good = angle->given && scene_body_axis(draft, keys_at(map, "axis"), axis);
    if (about->node) good = scene_domain_vector(draft, about, shape->a) && good;
    if (good && (draft->scene->domain.dim < 2 || draft->scene->domain.geometry != SCENE_CARTESIAN)) {
        keys_error(&draft->keys, angle, "shapes turn in cartesian geometry of two or three axes");
        good = false;
    }
    if (!good) {
        shape_free(part);
        return false;
    }
    scene_body_rotation(axis, angle->number, shape->turn);
    if (draft->scene->domain.dim == 2 && (part->type == SHAPE_BOX || part->type == SHAPE_POLYGON)) {
        scene_body_outline(shape, part);
        return true;
    }
    shape->n = 1;
    shape->parts = mem_new(1, sizeof *shape->parts);
    shape->parts[0] = part;
    if (part->type != SHAPE_SURFACE) return true;
    double offset[3]; /* its corners turn, so that its volume stays exact */
    for (int d = 0; d < 3; d++) {
        offset[d] = shape->a[d];
        for (int k = 0; k < 3; k++) offset[d] -= shape->turn[d][k] * shape->a[k];
    }
    surface_place(part->surface, (const double(*)[3])shape->turn, 1.0, offset);
    shape->type = SHAPE_UNION;
    return true;
}

bool scene_body_prism(struct draft *draft, struct shape *shape, struct shape *part, const struct keys_map *map)
{
    const struct keys_value *from = keys_at(map, "from"), *to = keys_at(map, "to");
    bool planar = part->type == SHAPE_POLYGON || (part->type == SHAPE_RASTER && part->raster->dim == 2);
    bool good = from->given && to->given;
    if (good && (draft->scene->domain.dim != 3 || !planar)) {
        keys_error(&draft->keys, keys_at(map, "shape"), "a polygon or an image is extruded, in three dimensions");
        good = false;
    }
    if (good && !(to->number > from->number)) {
        keys_error(&draft->keys, to, "%g m is not above the lower end, %g m", to->number, from->number);
        good = false;
    }
    shape->type = SHAPE_INTERSECTION;
    shape->n = 2;
    shape->parts = mem_new(2, sizeof *shape->parts);
    shape->parts[0] = part;
    shape->parts[1] = mem_new(1, sizeof **shape->parts);
    *shape->parts[1] = (struct shape){.type = SHAPE_BOX};
    shape->parts[1]->a[2] = from->number;
    shape->parts[1]->b[2] = to->number;
    return good;
}
