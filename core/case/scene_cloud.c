/* scene_cloud.c - clouds of bubbles, drops, grains: a layer `cloud:` becomes as many layers with a sphere as it has.
 *
 * Places are drawn one after the other, the largest sphere first, until one is free: inside the region and the domain,
 * and not closer to another than the gap (random sequential addition; Widom 1966, J. Chem. Phys. 44, 3888). Numbers
 * come from splitmix64 (Steele, Lea & Flood 2014), so that a seed means the same cloud everywhere. The resolved case
 * has the spheres. */
#include "case/scene_draft.h"

#include "base/mem.h"
#include "base/text.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { SCENE_CLOUD_MOST = 10000, SCENE_CLOUD_TRIES = 20000 };

static const struct key scene_cloud_rows[] = {
    {.name = "within",
     .type = KEYS_SECTION,
     .section = &scene_shape_keys,
     .required = true,
     .doc = "The region that all spheres lie in, whole."},
    {.name = "seed",
     .type = KEYS_INTEGER,
     .min = 0,
     .max = 1e9,
     .fallback = "1",
     .doc = "Another seed, another cloud."},
    {.name = "number", .type = KEYS_INTEGER, .min = 1, .max = SCENE_CLOUD_MOST, .doc = "How many."},
    {.name = "void-fraction",
     .type = KEYS_NUMBER,
     .unit = "1",
     .min = KEYS_POSITIVE,
     .max = 0.6,
     .doc = "Instead of a number: the part of the region's volume that they take, as near as whole spheres come."},
    {.name = "radii",
     .type = KEYS_NUMBER,
     .unit = "m",
     .min = KEYS_POSITIVE,
     .max = KEYS_MOST,
     .required = true,
     .doc = "Their radii; of a distribution the median."},
    {.name = "spread",
     .type = KEYS_NUMBER,
     .unit = "1",
     .min = 0,
     .max = 2,
     .fallback = "0",
     .doc = "Of a log-normal distribution: the standard deviation of the logarithm of the radius."},
    {.name = "smallest",
     .type = KEYS_NUMBER,
     .unit = "m",
     .max = KEYS_MOST,
     .fallback = "0",
     .doc = "No radius below it."},
    {.name = "largest",
     .type = KEYS_NUMBER,
     .unit = "m",
     .min = KEYS_POSITIVE,
     .max = KEYS_MOST,
     .doc = "No radius above it; four times the median if not given."},
    {.name = "gap",
     .type = KEYS_NUMBER,
     .unit = "m",
     .max = KEYS_MOST,
     .fallback = "0",
     .doc = "Least distance between two surfaces, and between one and the end of the region."},
    {0},
};

const struct keys_section scene_cloud_keys = {
    .name = "cloud",
    .doc = "Spheres (in the plane discs) at random places that do not overlap, each with the state of the layer.",
    .keys = scene_cloud_rows,
    .rules = "{'oneOf': [{'required': ['number']}, {'required': ['void-fraction']}]}"};

struct scene_cloud_ball {
    double at[SCENE_AXES], radius;
};

struct scene_cloud {
    const struct scene_domain *domain;
    const struct keys_map *map;
    struct shape *within;
    double lower[SCENE_AXES], upper[SCENE_AXES]; /* a box around it */
    uint64_t state;                              /* of the random numbers */
    double gap;
    unsigned n, placed;
    struct scene_cloud_ball balls[SCENE_CLOUD_MOST];
};

/* A number from 0 to 1, 1 excluded. */
static double scene_cloud_random(struct scene_cloud *cloud)
{
    uint64_t z = cloud->state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

/* Box and Muller's normal deviate. */
static double scene_cloud_normal(struct scene_cloud *cloud)
{
    double radius = sqrt(-2.0 * log(1.0 - scene_cloud_random(cloud)));
    return radius * cos(2.0 * M_PI * scene_cloud_random(cloud));
}

static double scene_cloud_radius(struct scene_cloud *cloud)
{
    double median = keys_at(cloud->map, "radii")->number, spread = keys_at(cloud->map, "spread")->number;
    const struct keys_value *largest = keys_at(cloud->map, "largest");
    double least = keys_at(cloud->map, "smallest")->number, most = largest->given ? largest->number : 4.0 * median;
    double radius = median;
    for (int i = 0; spread > 0.0 && i < SCENE_CLOUD_TRIES; i++) {
        radius = median * exp(spread * scene_cloud_normal(cloud));
        if (radius >= least && radius <= most) return radius;
    }
    return radius < least ? least : radius > most ? most : radius;
}

/* Volume of a ball; the area of a disc in the plane. */
static double scene_cloud_volume(int dim, double radius)
{
    return dim == 3 ? 4.0 / 3.0 * M_PI * radius * radius * radius : M_PI * radius * radius;
}

static double scene_cloud_room(const struct scene_cloud *cloud)
{
    const struct scene_domain *domain = cloud->domain;
    double volume = shape_fraction(cloud->within, domain->lower, domain->upper, domain->dim, 0);
    for (int d = 0; d < domain->dim; d++) volume *= domain->upper[d] - domain->lower[d];
    return volume;
}

static int scene_cloud_compare(const void *a, const void *b)
{
    double x = ((const struct scene_cloud_ball *)a)->radius, y = ((const struct scene_cloud_ball *)b)->radius;
    return (x < y) - (x > y);
}

/* Draws the radii, the largest first; false after a recorded error. */
static bool scene_cloud_sizes(struct draft *draft, struct scene_cloud *cloud)
{
    const struct keys_value *number = keys_at(cloud->map, "number"), *part = keys_at(cloud->map, "void-fraction");
    double wanted = part->given ? part->number * scene_cloud_room(cloud) : 0.0, taken = 0.0;
    unsigned most = number->given ? (unsigned)number->integer : SCENE_CLOUD_MOST;
    while (cloud->n < most) {
        double radius = scene_cloud_radius(cloud), volume = scene_cloud_volume(cloud->domain->dim, radius);
        if (part->given && taken + 0.5 * volume > wanted) break;
        cloud->balls[cloud->n++].radius = radius;
        taken += volume;
    }
    if (part->given && (cloud->n == 0 || cloud->n == SCENE_CLOUD_MOST)) {
        keys_error(&draft->keys, part, cloud->n ? "this takes more than %d spheres" : "one sphere is more than that",
                   SCENE_CLOUD_MOST);
        return false;
    }
    qsort(cloud->balls, cloud->n, sizeof *cloud->balls, scene_cloud_compare);
    return true;
}

/* Is the place free? */
static bool scene_cloud_fits(const struct scene_cloud *cloud, const struct scene_cloud_ball *ball)
{
    const struct scene_domain *domain = cloud->domain;
    double reach = ball->radius + cloud->gap;
    if (shape_level(cloud->within, ball->at) > -reach) return false;
    for (int d = 0; d < domain->dim; d++)
        if (ball->at[d] - reach < domain->lower[d] || ball->at[d] + reach > domain->upper[d]) return false;
    for (unsigned i = 0; i < cloud->placed; i++) {
        const struct scene_cloud_ball *other = &cloud->balls[i];
        double square = 0.0, apart = reach + other->radius;
        for (int d = 0; d < domain->dim; d++) square += (ball->at[d] - other->at[d]) * (ball->at[d] - other->at[d]);
        if (square < apart * apart) return false;
    }
    return true;
}

static bool scene_cloud_place(struct scene_cloud *cloud, struct scene_cloud_ball *ball)
{
    for (int i = 0; i < SCENE_CLOUD_TRIES; i++) {
        for (int d = 0; d < cloud->domain->dim; d++)
            ball->at[d] = cloud->lower[d] + scene_cloud_random(cloud) * (cloud->upper[d] - cloud->lower[d]);
        if (scene_cloud_fits(cloud, ball)) return true;
    }
    return false;
}

/* Places are drawn from the domain, or from a box around a box or a ball. */
static void scene_cloud_bounds(struct scene_cloud *cloud)
{
    const struct shape *within = cloud->within;
    for (int d = 0; d < cloud->domain->dim; d++) {
        double lower = cloud->domain->lower[d], upper = cloud->domain->upper[d];
        bool ball = within->type == SHAPE_SPHERE || within->type == SHAPE_RING, box = within->type == SHAPE_BOX;
        double from = box ? within->a[d] : within->a[d] - within->radius;
        double to = box ? within->b[d] : within->a[d] + within->radius;
        cloud->lower[d] = (box || ball) && from > lower ? from : lower;
        cloud->upper[d] = (box || ball) && to < upper ? to : upper;
    }
}

/* Sizes and places; false after a recorded error. */
static bool scene_cloud_fill(struct draft *draft, struct scene_cloud *cloud, const struct keys_value *value)
{
    if (!scene_cloud_sizes(draft, cloud)) return false;
    scene_cloud_bounds(cloud);
    for (; cloud->placed < cloud->n; cloud->placed++) {
        struct scene_cloud_ball *ball = &cloud->balls[cloud->placed];
        if (scene_cloud_place(cloud, ball)) continue;
        keys_error(&draft->keys, value,
                   "only %u of %u spheres fit: for the next, of radius %.3g m, %d places were tried", cloud->placed,
                   cloud->n, ball->radius, SCENE_CLOUD_TRIES);
        diag_help(draft->keys.diag, "fewer or smaller ones, a smaller gap, or a larger region");
        return false;
    }
    return true;
}

/* The layer with a sphere in the place of the cloud. */
static struct node *scene_cloud_layer(struct draft *draft, const struct node *layer, const struct scene_cloud *cloud,
                                      const struct scene_cloud_ball *ball)
{
    struct forest *forest = draft->keys.forest;
    struct node *map = tree_copy(forest, layer), *sphere = tree_map(forest, &layer->mark);
    struct node *center = tree_list(forest, &layer->mark);
    struct text number = {0};
    for (int d = 0; d <= cloud->domain->dim; d++) {
        text_double(&number, d < cloud->domain->dim ? ball->at[d] : ball->radius);
        struct node *scalar = tree_scalar(forest, &layer->mark, TREE_PLAIN, tree_print(forest, "%s", number.at));
        if (d < cloud->domain->dim) tree_append(forest, center, scalar);
        else tree_set(forest, sphere, "radius", scalar);
        text_done(&number);
        number = (struct text){0};
    }
    tree_set(forest, sphere, "center", center);
    tree_remove(map, (unsigned)tree_find(map, "cloud"));
    tree_set(forest, map, "sphere", sphere);
    return map;
}

static bool scene_cloud_check(struct draft *draft, const struct keys_value *value)
{
    const struct scene_domain *domain = &draft->scene->domain;
    const struct keys_value *number = keys_at(value->map, "number"), *part = keys_at(value->map, "void-fraction");
    const struct keys_value *least = keys_at(value->map, "smallest"), *most = keys_at(value->map, "largest");
    if (domain->geometry != SCENE_CARTESIAN || domain->dim < 2) {
        keys_error(&draft->keys, value, "a cloud needs a cartesian domain with two or three axes");
        diag_help(draft->keys.diag, "in axisymmetric geometry a ball beside the axis would be a ring");
    } else if (!number->node == !part->node)
        keys_error(&draft->keys, number->node ? part : value, "one of 'number' and 'void-fraction' is needed");
    else if (most->given && most->number < least->number)
        keys_error(&draft->keys, most, "%g m is less than 'smallest', %g m", most->number, least->number);
    else return value->given && (number->given || part->given) && keys_at(value->map, "radii")->given;
    return false;
}

struct node *scene_cloud(struct draft *draft, const struct keys_value *value, const struct node *layer)
{
    struct node *layers = tree_list(draft->keys.forest, &layer->mark);
    const struct keys_value *which;
    if (!value->map || !scene_cloud_check(draft, value)) return layers;
    struct scene_cloud *cloud = mem_new(1, sizeof *cloud);
    cloud->domain = &draft->scene->domain;
    cloud->map = value->map;
    cloud->state = (uint64_t)keys_at(value->map, "seed")->integer;
    cloud->gap = keys_at(value->map, "gap")->number;
    cloud->within = scene_shape(draft, keys_at(value->map, "within")->map, true, &which);
    if (cloud->within && scene_cloud_fill(draft, cloud, value))
        for (unsigned i = 0; i < cloud->n; i++)
            tree_append(draft->keys.forest, layers, scene_cloud_layer(draft, layer, cloud, &cloud->balls[i]));
    shape_free(cloud->within);
    mem_free(cloud);
    return layers;
}
