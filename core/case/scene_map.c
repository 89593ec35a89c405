/* scene_map.c - space-time maps: fields along a line, a curve (scene_curve.c), a face of the domain or a
 * surface, or on a rectangle (scene_plane.c), over time. */
#include "case/scene_draft.h"

#include "base/mem.h"
#include "base/text.h"

#include <math.h>
#include <string.h>

enum { SCENE_MAP_WAYS = 6, SCENE_MAP_FINE = 1024 };

static const struct key scene_map_line_rows[] = {
    {.name = "from", .type = KEYS_NUMBER, .many = KEYS_LIST, .unit = "m", .required = true, .doc = "First point."},
    {.name = "to", .type = KEYS_NUMBER, .many = KEYS_LIST, .unit = "m", .required = true, .doc = "Last point."},
    {0},
};

static const struct keys_section scene_map_line = {.name = "map-line",
                                                   .doc = "A straight line, its ends included.",
                                                   .keys = scene_map_line_rows};

static const struct key scene_map_rows[] = {
    {.name = "line", .type = KEYS_SECTION, .section = &scene_map_line, .doc = "Along a straight line."},
    {.name = "boundary",
     .type = KEYS_CHOICE,
     .choices = "x-|x+|y-|y+",
     .doc = "Along a face of a domain with two axes: values of the cells next to it."},
    {.name = "isosurface",
     .type = KEYS_TEXT,
     .doc = "On the surface of this material (volume fraction 0.5), against the coordinate `along`."},
    {.name = "circle",
     .type = KEYS_SECTION,
     .section = &scene_curve_circle_keys,
     .doc = "Along a circle or an arc of it, against the distance s along it."},
    {.name = "polyline",
     .type = KEYS_SECTION,
     .section = &scene_curve_polyline_keys,
     .doc = "Along straight pieces from point to point, against the distance s along them."},
    {.name = "rectangle",
     .type = KEYS_SECTION,
     .section = &scene_plane_keys,
     .doc = "On a rectangle, against the distances s1 and s2 along its sides."},
    {.name = "along",
     .type = KEYS_CHOICE,
     .choices = "x|y|z|r|axis",
     .doc = "Of an isosurface: the axis of the coordinate, the first if not given; in axisymmetric geometry r is x and "
            "axis is y."},
    {.name = "from",
     .type = KEYS_NUMBER,
     .unit = "m",
     .min = -KEYS_MOST,
     .max = KEYS_MOST,
     .doc = "Of a boundary or an isosurface: where the map begins, the lower end of the domain if not given."},
    {.name = "to", .type = KEYS_NUMBER, .unit = "m", .min = -KEYS_MOST, .max = KEYS_MOST, .doc = "Where it ends."},
    {.name = "points",
     .type = KEYS_INTEGER,
     .min = 2,
     .max = SCENE_MAP_MOST,
     .doc = "How many places; if not given, about one per cell of the finest level, at most 1024."},
    {.name = "where",
     .type = KEYS_SECTION,
     .section = &scene_shape_keys,
     .doc = "Of an isosurface: only in this region."},
    {.name = "fields", .type = KEYS_FIELD, .many = KEYS_LIST, .required = true, .doc = "The fields to record."},
    {0},
};

static const struct keys_section scene_map_keys = {
    .name = "map",
    .doc = "Fields along a line, a curve or a surface, or on a rectangle, over time.",
    .keys = scene_map_rows,
    .choose = SCENE_MAP_WAYS};

static const struct key scene_map_row = {.name = "NAME",
                                         .type = KEYS_SECTION,
                                         .section = &scene_map_keys,
                                         .doc = "A map; the file is maps/NAME.csv."};

static const struct key scene_map_all[] = {
    {.name = "every",
     .type = KEYS_EVERY,
     .unit = "s",
     .min = KEYS_POSITIVE,
     .max = KEYS_MOST,
     .required = true,
     .doc = "Time, or `N steps`, between two rows of maps."},
    {0},
};

const struct keys_section scene_map_list_keys = {.name = "maps",
                                                 .doc =
                                                     "Fields along lines and surfaces over time: maps/NAME.csv, .hdf.",
                                                 .keys = scene_map_all,
                                                 .others = &scene_map_row,
                                                 .rules = "{'propertyNames': {'pattern': '^[A-Za-z_][A-Za-z0-9_]"
                                                          "{0,62}$', 'patternErrorMessage': 'The name of a map "
                                                          "is an identifier (letters, digits and _).'}}"};

unsigned scene_map_count(const struct keys_value *points, double fine)
{
    if (points->given) return (unsigned)points->integer;
    return !(fine >= 2.0) ? 2 : fine > SCENE_MAP_FINE ? SCENE_MAP_FINE : (unsigned)lround(fine);
}

bool scene_map_inside(struct draft *draft, const struct keys_value *value, const double *x)
{
    const struct scene *scene = draft->scene;
    for (int axis = 0; axis < scene->domain.dim; axis++)
        if (x[axis] < scene->domain.lower[axis] || x[axis] > scene->domain.upper[axis]) {
            keys_error(&draft->keys, &value->list[axis], "%g m is outside of the domain, %g to %g m", x[axis],
                       scene->domain.lower[axis], scene->domain.upper[axis]);
            return false;
        }
    return true;
}

/* The only axis along which a line runs, or -1. */
static int scene_map_axis(const double *from, const double *to)
{
    int axis = -1, count = 0;
    for (int d = 0; d < SCENE_AXES; d++)
        if (from[d] != to[d]) {
            axis = d;
            count++;
        }
    return count == 1 ? axis : -1;
}

static void scene_map_read_line(struct draft *draft, struct scene_map *map, const struct keys_map *rows)
{
    const struct scene *scene = draft->scene;
    const struct keys_map *line = keys_at(rows, "line")->map;
    const struct keys_value *ends[] = {keys_at(line, "from"), keys_at(line, "to")};
    double x[2][SCENE_AXES], length = 0.0, cells = 0.0;
    bool good = true;
    for (int end = 0; end < 2; end++)
        good = scene_domain_vector(draft, ends[end], x[end]) && scene_map_inside(draft, ends[end], x[end]) && good;
    if (!good) return;
    for (int d = 0; d < scene->domain.dim; d++) {
        length = hypot(length, x[1][d] - x[0][d]);
        cells = hypot(cells, (x[1][d] - x[0][d]) / scene_domain_width(scene, d));
    }
    if (length == 0.0) keys_error(&draft->keys, ends[1], "the line has no length: 'to' is 'from'");
    map->axis = scene_map_axis(x[0], x[1]);
    map->n_point = scene_map_count(keys_at(rows, "points"), cells + 1.0);
    map->place = mem_new(map->n_point, sizeof *map->place);
    map->at = mem_new(map->n_point, sizeof *map->at);
    for (unsigned i = 0; i < map->n_point; i++) {
        double share = i / (map->n_point - 1.0);
        for (int d = 0; d < SCENE_AXES; d++)
            map->at[i][d] = i + 1 == map->n_point ? x[1][d] : x[0][d] + share * (x[1][d] - x[0][d]);
        map->place[i] = map->axis < 0 ? share * length : map->at[i][map->axis];
    }
}

/* Places in the middle of equal pieces of [from, to]; false after a recorded error. */
static bool scene_map_span(struct draft *draft, struct scene_map *map, const struct keys_map *rows)
{
    const struct scene *scene = draft->scene;
    const struct keys_value *from = keys_at(rows, "from"), *to = keys_at(rows, "to");
    double lower = scene->domain.lower[map->axis], upper = scene->domain.upper[map->axis];
    double a = from->given ? from->number : lower, b = to->given ? to->number : upper;
    const struct keys_value *outside = a < lower ? from : b > upper ? to : NULL;
    if (!(lower < upper)) return false; /* the domain has been refused already */
    if (outside)
        keys_error(&draft->keys, outside, "%g m is outside of the domain, %g to %g m", outside->number, lower, upper);
    else if (!(a < b)) keys_error(&draft->keys, to->given ? to : from, "'to' must lie above 'from'");
    if (outside || !(a < b)) return false;
    map->n_point = scene_map_count(keys_at(rows, "points"), (b - a) / scene_domain_width(scene, map->axis));
    map->width = (b - a) / map->n_point;
    map->place = mem_new(map->n_point, sizeof *map->place);
    for (unsigned i = 0; i < map->n_point; i++) map->place[i] = a + (i + 0.5) * map->width;
    return true;
}

static void scene_map_read_boundary(struct draft *draft, struct scene_map *map, const struct keys_map *rows)
{
    const struct scene *scene = draft->scene;
    const struct keys_value *boundary = keys_at(rows, "boundary");
    if (!boundary->given || scene->domain.dim == 0) return;
    if (scene->domain.dim != 2) {
        keys_error(&draft->keys, boundary, "only a domain with two axes has faces that are lines: use '%s'",
                   scene->domain.dim == 1 ? "output.probes" : "line");
        return;
    }
    int normal = boundary->text[0] - 'x';
    map->axis = 1 - normal;
    if (!scene_map_span(draft, map, rows)) return;
    map->at = mem_new(map->n_point, sizeof *map->at);
    for (unsigned i = 0; i < map->n_point; i++) {
        map->at[i][normal] = boundary->text[1] == '-' ? scene->domain.lower[normal] : scene->domain.upper[normal];
        map->at[i][map->axis] = map->place[i];
    }
}

static void scene_map_read_surface(struct draft *draft, struct scene_map *map, const struct keys_map *rows)
{
    const struct scene *scene = draft->scene;
    const struct keys_value *material = keys_at(rows, "isosurface"), *along = keys_at(rows, "along");
    const struct keys_value *where = keys_at(rows, "where"), *which = NULL;
    map->material = scene_matter_index(draft, material);
    if (scene->domain.dim == 1)
        keys_error(&draft->keys, material, "on one axis a surface is a point: use the history's isosurface-mean");
    if (where->given) map->where = scene_shape(draft, where->map, true, &which);
    map->axis = along->given ? scene_domain_axis(draft, along) : 0;
    if (scene->domain.dim < 2 || map->axis < 0 || map->axis >= scene->domain.dim) return;
    scene_map_span(draft, map, rows);
}

/* Keys that mean nothing for the way that is chosen. */
static void scene_map_refuse(struct draft *draft, const struct keys_map *rows, const char *way)
{
    static const char *const of_surfaces[] = {"along", "where"}, *const of_spans[] = {"from", "to"};
    bool spans = strcmp(way, "boundary") == 0 || strcmp(way, "isosurface") == 0;
    for (int i = 0; i < 2 && strcmp(way, "isosurface") != 0; i++)
        if (keys_at(rows, of_surfaces[i])->node)
            keys_error(&draft->keys, keys_at(rows, of_surfaces[i]), "only for an 'isosurface'");
    for (int i = 0; i < 2 && !spans; i++)
        if (keys_at(rows, of_spans[i])->node)
            keys_error(&draft->keys, keys_at(rows, of_spans[i]),
                       "only for a 'boundary' or an 'isosurface': the %s has its own ends", way);
}

static void scene_map_read(struct draft *draft, struct scene_map *map, const struct keys_value *value)
{
    static void (*const read[])(struct draft *, struct scene_map *,
                                const struct keys_map *) = {scene_map_read_line,       scene_map_read_boundary,
                                                            scene_map_read_surface,    scene_curve_read_circle,
                                                            scene_curve_read_polyline, scene_plane_read};
    int way = -1, ways = 0;
    map->material = map->axis = -1;
    snprintf(map->name, SCENE_NAME, "%s", value->key->name);
    if (!text_is_identifier(value->key->name) || strlen(value->key->name) >= SCENE_NAME)
        keys_error(&draft->keys, value, "the name of a map is an identifier (letters, digits and _)");
    scene_field_name_list(draft, keys_at(value->map, "fields"), &map->fields, &map->n_field);
    for (int i = 0; value->map && i < SCENE_MAP_WAYS; i++)
        if (keys_at(value->map, scene_map_rows[i].name)->node) {
            way = i;
            ways++;
        }
    if (ways != 1 && value->map) {
        keys_error(&draft->keys, value,
                   "a map runs along one of 'line', 'boundary', 'isosurface', 'circle', 'polyline' and 'rectangle'%s",
                   ways ? ": one too many is given" : "");
        return;
    }
    if (way < 0) return;
    scene_map_refuse(draft, value->map, scene_map_rows[way].name);
    read[way](draft, map, value->map);
}

void scene_map(struct draft *draft)
{
    const struct keys_map *maps = keys_at(keys_at(draft->root, "output")->map, "maps")->map;
    const struct keys_value *every = keys_at(maps, "every");
    struct scene *scene = draft->scene;
    scene->output.maps_every = (struct scene_every){every->integer ? 0.0 : every->number, every->integer};
    scene->output.maps = mem_new(maps ? maps->count + 1 : 1, sizeof *scene->output.maps);
    for (unsigned i = 0; maps && i < maps->count; i++)
        if (maps->values[i].key->section == &scene_map_keys)
            scene_map_read(draft, &scene->output.maps[scene->output.n_map++], &maps->values[i]);
}

void scene_map_done(struct scene *scene)
{
    for (unsigned i = 0; i < scene->output.n_map; i++) {
        mem_free(scene->output.maps[i].fields);
        mem_free(scene->output.maps[i].place);
        mem_free(scene->output.maps[i].second);
        mem_free(scene->output.maps[i].at);
        shape_free(scene->output.maps[i].where);
    }
    mem_free(scene->output.maps);
}
