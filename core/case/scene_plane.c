/* scene_plane.c - the rectangles of maps: places at equal distances along two sides at right angles, the corners
 * included, told apart by the distances along both. */
#include "case/scene_draft.h"

#include "base/mem.h"

#include <math.h>

enum { SCENE_PLANE_FINE = 256 }; /* places along a side, if not given */

#define SCENE_PLANE_SQUARE 1e-6 /* cosine of the angle between sides that are at right angles */

static const struct key scene_plane_rows[] = {
    {.name = "corner",
     .type = KEYS_NUMBER,
     .many = KEYS_LIST,
     .unit = "m",
     .required = true,
     .doc = "Where it begins."},
    {.name = "first",
     .type = KEYS_NUMBER,
     .many = KEYS_LIST,
     .unit = "m",
     .required = true,
     .doc = "Its first side, from the corner to the next: a vector. Distances along it are the column s1."},
    {.name = "second",
     .type = KEYS_NUMBER,
     .many = KEYS_LIST,
     .unit = "m",
     .required = true,
     .doc = "Its second side, at right angles to the first: column s2."},
    {.name = "points",
     .type = KEYS_INTEGER,
     .many = KEYS_LIST,
     .min = 2,
     .max = SCENE_MAP_MOST,
     .doc = "How many places along each side, their product at most 100000; if not given, about one per cell of the "
            "finest "
            "level, at most 256."},
    {0},
};

const struct keys_section scene_plane_keys = {.name = "map-rectangle",
                                              .doc = "A rectangle, its edges included.",
                                              .keys = scene_plane_rows};

static double scene_plane_product(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Reads corner and sides; false after a recorded error. */
static bool scene_plane_sides(struct draft *draft, const struct keys_map *plane, struct scene_map *map)
{
    const struct keys_value *corner = keys_at(plane, "corner");
    static const char *const names[] = {"first", "second"};
    bool good = scene_domain_vector(draft, corner, map->corner) && scene_map_inside(draft, corner, map->corner);
    for (int k = 0; k < 2; k++) {
        const struct keys_value *side = keys_at(plane, names[k]);
        good = scene_domain_vector(draft, side, map->side[k]) && good;
        if (!good || scene_plane_product(map->side[k], map->side[k]) > 0.0) continue;
        keys_error(&draft->keys, side, "this side has no length");
        good = false;
    }
    if (!good) return false;
    double length =
        sqrt(scene_plane_product(map->side[0], map->side[0]) * scene_plane_product(map->side[1], map->side[1]));
    double cosine = scene_plane_product(map->side[0], map->side[1]) / length;
    if (fabs(cosine) <= SCENE_PLANE_SQUARE) return true;
    keys_error(&draft->keys, keys_at(plane, "second"),
               "it is %.4g deg from the first side: a rectangle has right angles", acos(cosine) * 57.29577951308232);
    return false;
}

/* Are the other corners in the domain? */
static bool scene_plane_inside(struct draft *draft, const struct keys_map *plane, const struct scene_map *map)
{
    static const char axes[] = "xyz";
    static const char *const names[] = {"first", "second", "second"};
    static const char *const ends[] = {"the end of this side", "the end of this side", "the corner across"};
    for (int k = 0; k < 3; k++) {
        double x[SCENE_AXES];
        for (int d = 0; d < SCENE_AXES; d++)
            x[d] = map->corner[d] + (k != 1 ? map->side[0][d] : 0.0) + (k != 0 ? map->side[1][d] : 0.0);
        int d = scene_curve_outside(draft->scene, x);
        if (d < 0) continue;
        const struct scene_domain *domain = &draft->scene->domain;
        keys_error(&draft->keys, keys_at(plane, names[k]), "%s is at %c = %g m, outside of the domain, %g to %g m",
                   ends[k], axes[d], x[d], domain->lower[d], domain->upper[d]);
        return false;
    }
    return true;
}

/* Places along both sides; false after a recorded error. */
static bool scene_plane_counts(struct draft *draft, const struct keys_value *points, struct scene_map *map)
{
    if (points->node && !points->given) return false;
    if (points->given && points->count != 2) {
        keys_error(&draft->keys, points, "2 numbers are needed, one per side, not %u", points->count);
        return false;
    }
    for (int k = 0; k < 2; k++) {
        double cells = 0.0;
        for (int d = 0; d < draft->scene->domain.dim; d++)
            cells = hypot(cells, map->side[k][d] / scene_domain_width(draft->scene, d));
        unsigned fine = cells + 1.0 < SCENE_PLANE_FINE ? (unsigned)lround(cells + 1.0) : SCENE_PLANE_FINE;
        map->n_side[k] = points->given ? (unsigned)points->list[k].integer : fine > 2 ? fine : 2;
    }
    if (map->n_side[1] <= SCENE_MAP_MOST / map->n_side[0]) return true;
    keys_error(&draft->keys, points, "%u x %u places are more than %d", map->n_side[0], map->n_side[1], SCENE_MAP_MOST);
    return false;
}

static void scene_plane_places(const struct scene *scene, struct scene_map *map)
{
    double length[2];
    for (int k = 0; k < 2; k++) length[k] = sqrt(scene_plane_product(map->side[k], map->side[k]));
    for (unsigned i = 0; i < map->n_point; i++) {
        double share[2] = {i / map->n_side[1] / (map->n_side[0] - 1.0), i % map->n_side[1] / (map->n_side[1] - 1.0)};
        for (int d = 0; d < SCENE_AXES; d++)
            map->at[i][d] = map->corner[d] + share[0] * map->side[0][d] + share[1] * map->side[1][d];
        scene_curve_outside(scene, map->at[i]);
        map->place[i] = share[0] * length[0];
        map->second[i] = share[1] * length[1];
    }
}

void scene_plane_read(struct draft *draft, struct scene_map *map, const struct keys_map *rows)
{
    const struct keys_value *value = keys_at(rows, "rectangle"), *points = keys_at(rows, "points");
    if (points->node) keys_error(&draft->keys, points, "a rectangle has 'points: [.., ..]' of its own, within it");
    if (points->node || draft->scene->domain.dim == 0 || !scene_curve_has_axes(draft, value)) return;
    if (!scene_plane_sides(draft, value->map, map) || !scene_plane_inside(draft, value->map, map)) return;
    if (!scene_plane_counts(draft, keys_at(value->map, "points"), map)) return;
    scene_curve_room(map, map->n_side[0] * map->n_side[1]);
    map->second = mem_new(map->n_point, sizeof *map->second);
    scene_plane_places(draft->scene, map);
}
