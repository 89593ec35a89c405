/* scene_curve.c - the curves of space-time maps: arcs of circles and chains of straight pieces. Their places stand at
 * equal distances along them, both ends included, and are told apart by the distance from the first. */
#include "case/scene_draft.h"

#include "base/mem.h"

#include <math.h>

#define SCENE_CURVE_TURN 6.283185307179586
#define SCENE_CURVE_SLACK 1e-9 /* so much of the domain a place may lie outside by round-off: it is put on the face */

static const struct key scene_curve_circle[] = {
    {.name = "center", .type = KEYS_NUMBER, .many = KEYS_LIST, .unit = "m", .required = true, .doc = "Its center."},
    {.name = "radius",
     .type = KEYS_NUMBER,
     .unit = "m",
     .min = KEYS_POSITIVE,
     .max = KEYS_MOST,
     .required = true,
     .doc = "Its radius."},
    {.name = "from",
     .type = KEYS_NUMBER,
     .unit = "rad",
     .fallback = "0",
     .doc = "Where it begins: the angle from the first axis of its plane towards the second, `-90 deg`."},
    {.name = "to",
     .type = KEYS_NUMBER,
     .unit = "rad",
     .doc = "Where it ends, at most a turn away; a turn after `from` if not given."},
    {.name = "axis",
     .type = KEYS_CHOICE,
     .choices = "x|y|z",
     .doc = "In 3D, the axis around which it runs, z if not given; angles count from y to z, z to x, x to y."},
    {0},
};

const struct keys_section scene_curve_circle_keys = {.name = "map-circle",
                                                     .doc = "A circle or an arc of it, its ends included.",
                                                     .keys = scene_curve_circle};

static const struct key scene_curve_polyline[] = {
    {.name = "vertices", .type = KEYS_TREE, .required = true, .doc = "List of points, [x, y] or [x, y, z], in order."},
    {0},
};

const struct keys_section scene_curve_polyline_keys = {
    .name = "map-polyline",
    .doc = "Straight pieces from point to point, its ends included.",
    .keys = scene_curve_polyline,
    .rules = "{'properties': {'vertices': {'type': 'array', 'minItems': 2, 'items': {'type': 'array', 'minItems': 2, "
             "'maxItems': 3}}}}"};

void scene_curve_room(struct scene_map *map, unsigned n_point)
{
    map->axis = -1;
    map->n_point = n_point;
    map->place = mem_new(n_point, sizeof *map->place);
    map->at = mem_new(n_point, sizeof *map->at);
}

int scene_curve_outside(const struct scene *scene, double x[SCENE_AXES])
{
    for (int d = 0; d < scene->domain.dim; d++) {
        double lower = scene->domain.lower[d], upper = scene->domain.upper[d];
        double slack = SCENE_CURVE_SLACK * (upper - lower);
        if (!(x[d] >= lower - slack && x[d] <= upper + slack)) return d;
        x[d] = x[d] < lower ? lower : x[d] > upper ? upper : x[d];
    }
    return -1;
}

bool scene_curve_has_axes(struct draft *draft, const struct keys_value *value)
{
    if (draft->scene->domain.dim == 1)
        keys_error(&draft->keys, value,
                   "curves and rectangles need two axes: with one there is 'line: {from: [..], to: [..]}'");
    return draft->scene->domain.dim > 1;
}

/* The angles of both ends; false after a recorded error. */
static bool scene_curve_angles(struct draft *draft, const struct keys_map *circle, double ret[2])
{
    const struct keys_value *from = keys_at(circle, "from"), *to = keys_at(circle, "to");
    if (!from->given || (to->node && !to->given)) return false;
    ret[0] = from->number;
    ret[1] = to->given ? to->number : from->number + SCENE_CURVE_TURN;
    double turns = fabs(ret[1] - ret[0]) / SCENE_CURVE_TURN;
    if (turns == 0.0) keys_error(&draft->keys, to, "the arc has no length: 'to' is 'from'");
    else if (!(turns < 1.0 + 1e-9))
        keys_error(&draft->keys, to, "%g turns from 'from' to 'to': at most one is possible", turns);
    return turns > 0.0 && turns < 1.0 + 1e-9;
}

/* The axis around which the circle runs, 0..2, or -1 after a recorded error. */
static int scene_curve_axis(struct draft *draft, const struct keys_map *circle)
{
    const struct keys_value *axis = keys_at(circle, "axis");
    if (!axis->node) return 2;
    if (draft->scene->domain.dim == 3) return axis->given ? (int)axis->integer : -1;
    keys_error(&draft->keys, axis, "only in three dimensions: with two axes a circle lies in their plane");
    return -1;
}

/* The places of an arc; one that is outside is an error. A whole turn ends exactly where it began. */
static void scene_curve_arc(struct draft *draft, struct scene_map *map, const struct keys_value *radius,
                            const double center[SCENE_AXES], int axis, const double angles[2])
{
    static const char names[] = "xyz";
    const struct scene *scene = draft->scene;
    double turn = angles[1] - angles[0];
    bool whole = fabs(turn) > SCENE_CURVE_TURN * (1.0 - 1e-9);
    for (unsigned i = 0; i < map->n_point; i++) {
        double *x = map->at[i], share = i / (map->n_point - 1.0);
        double angle = whole && i + 1 == map->n_point ? angles[0] : angles[0] + share * turn;
        for (int d = 0; d < SCENE_AXES; d++) x[d] = center[d];
        x[(axis + 1) % SCENE_AXES] += radius->number * cos(angle);
        x[(axis + 2) % SCENE_AXES] += radius->number * sin(angle);
        map->place[i] = share * fabs(turn) * radius->number;
        int d = scene_curve_outside(scene, x);
        if (d < 0) continue;
        keys_error(&draft->keys, radius, "at %.4g deg the circle is at %c = %g m, outside of the domain, %g to %g m",
                   angle * 360.0 / SCENE_CURVE_TURN, names[d], x[d], scene->domain.lower[d], scene->domain.upper[d]);
        diag_help(draft->keys.diag, "an arc may lie inside: {from: -90 deg, to: 90 deg}");
        return;
    }
}

void scene_curve_read_circle(struct draft *draft, struct scene_map *map, const struct keys_map *rows)
{
    const struct keys_value *value = keys_at(rows, "circle"), *radius = keys_at(value->map, "radius");
    double center[SCENE_AXES], angles[2];
    if (!scene_domain_vector(draft, keys_at(value->map, "center"), center)) return;
    int axis = scene_curve_has_axes(draft, value) ? scene_curve_axis(draft, value->map) : -1;
    if (!scene_curve_angles(draft, value->map, angles) || axis < 0 || !radius->given) return;
    double first = scene_domain_width(draft->scene, (axis + 1) % SCENE_AXES);
    double second = scene_domain_width(draft->scene, (axis + 2) % SCENE_AXES);
    double cells = fabs(angles[1] - angles[0]) * radius->number / (first < second ? first : second);
    scene_curve_room(map, scene_map_count(keys_at(rows, "points"), cells + 1.0));
    scene_curve_arc(draft, map, radius, center, axis, angles);
}

/* Reads the points, with the distance of each along the curve, and the cells that it crosses; false after a recorded
 * error. */
static bool scene_curve_vertices(struct draft *draft, const struct keys_value *vertices, double (*x)[SCENE_AXES],
                                 double *along, double *ret_cells)
{
    bool good = true;
    *ret_cells = 0.0;
    for (unsigned i = 0; i < vertices->node->count; i++) {
        const char *path = tree_print(draft->keys.forest, "%s[%u]", vertices->path, i);
        const struct keys_value *vertex = scene_shape_vertex(draft, vertices->node->items[i], path);
        good = scene_domain_vector(draft, vertex, x[i]) && scene_map_inside(draft, vertex, x[i]) && good;
        double length = 0.0, cells = 0.0;
        for (int d = 0; good && i > 0 && d < draft->scene->domain.dim; d++) {
            length = hypot(length, x[i][d] - x[i - 1][d]);
            cells = hypot(cells, (x[i][d] - x[i - 1][d]) / scene_domain_width(draft->scene, d));
        }
        along[i] = i > 0 ? along[i - 1] + length : 0.0;
        *ret_cells += cells;
        if (!good || i == 0 || length > 0.0) continue;
        keys_error(&draft->keys, vertex, "this point is the one before it");
        good = false;
    }
    return good;
}

static void scene_curve_chain(const struct scene *scene, struct scene_map *map, unsigned n, double (*x)[SCENE_AXES],
                              const double *along)
{
    unsigned k = 0; /* the piece from point k */
    for (unsigned i = 0; i < map->n_point; i++) {
        double s = i + 1 == map->n_point ? along[n - 1] : i / (map->n_point - 1.0) * along[n - 1];
        while (k + 2 < n && s >= along[k + 1]) k++;
        double share = (s - along[k]) / (along[k + 1] - along[k]);
        for (int d = 0; d < SCENE_AXES; d++) map->at[i][d] = x[k][d] + share * (x[k + 1][d] - x[k][d]);
        scene_curve_outside(scene, map->at[i]);
        map->place[i] = s;
    }
}

void scene_curve_read_polyline(struct draft *draft, struct scene_map *map, const struct keys_map *rows)
{
    const struct keys_value *value = keys_at(rows, "polyline"), *vertices = keys_at(value->map, "vertices");
    if (!vertices->given || draft->scene->domain.dim == 0 || !scene_curve_has_axes(draft, value)) return;
    if (vertices->node->kind != TREE_LIST || vertices->node->count < 2) {
        keys_error(&draft->keys, vertices, "a list of at least two points, %s, is needed",
                   draft->scene->domain.dim == 2 ? "[x, y]" : "[x, y, z]");
        return;
    }
    unsigned n = vertices->node->count;
    double(*x)[SCENE_AXES] = mem_new(n, sizeof *x), *along = mem_new(n, sizeof *along), cells;
    if (scene_curve_vertices(draft, vertices, x, along, &cells)) {
        scene_curve_room(map, scene_map_count(keys_at(rows, "points"), cells + 1.0));
        scene_curve_chain(draft->scene, map, n, x, along);
    }
    mem_free(x);
    mem_free(along);
}
