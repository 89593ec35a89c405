/* sets.c - see sets.h. Wishes are found by descent: only boxes that meet a feature are divided further. */
#include "sets.h"

#include "../unit/replicated.h"
#include "base/mem.h"
#include "mesh/doze.h"
#include "mesh/level.h"
#include "mesh/morton.h"

#include <math.h>

static const double SIDE = 2.0; /* of the domain */

/* Edge of a tile of level l. */
static double sets_edge(const struct sets_scene *scene, int l)
{
    return SIDE / (scene->base << l);
}

/* Does the box of a tile, wider by `margin` on all sides, meet a feature? */
static bool sets_meets(const struct sets_scene *scene, const struct sets_feature *feature, int l, const int at[3],
                       double margin)
{
    double edge = sets_edge(scene, l), least = 0.0, most = 0.0;
    for (int d = 0; d < scene->dim; d++) {
        double low = at[d] * edge - margin - feature->centre[d],
               high = (at[d] + 1) * edge + margin - feature->centre[d];
        if (feature->kind == SETS_PLANE) return low <= feature->radius && feature->radius <= high;
        double near = low > 0.0 ? low : high < 0.0 ? high : 0.0, far = fabs(low) > fabs(high) ? low : high;
        least += near * near;
        most += far * far;
    }
    double square = feature->radius * feature->radius;
    return least <= square && (feature->kind == SETS_BALL || square <= most);
}

static bool sets_wants(const struct sets_scene *scene, int l, int wanted, const int at[3])
{
    double margin = SETS_BUFFER * sets_edge(scene, wanted - 1) / scene->n;
    for (int f = 0; f < scene->n_feature; f++) {
        const struct sets_feature *feature = &scene->features[f];
        if (feature->finest >= wanted && sets_meets(scene, feature, l, at, margin)) return true;
    }
    return false;
}

struct sets_descent {
    const struct sets_scene *scene;
    int wanted;
    struct nest_keys keys;
};

static void sets_descend(struct sets_descent *descent, int l, const int at[3])
{
    const struct sets_scene *scene = descent->scene;
    if (!sets_wants(scene, l, descent->wanted, at)) return;
    if (l == descent->wanted) {
        struct nest_keys *keys = &descent->keys;
        if (keys->n == keys->room) {
            keys->keys = mem_grow(keys->keys, keys->n, 2 * keys->n + 64, sizeof *keys->keys);
            keys->room = 2 * keys->n + 64;
        }
        keys->keys[keys->n++] = morton_key(at);
        return;
    }
    for (int o = 0; o < 1 << scene->dim; o++) {
        int child[3] = {2 * at[0] + (o & 1), 2 * at[1] + (o >> 1 & 1), 2 * at[2] + (o >> 2)};
        sets_descend(descent, l + 1, child);
    }
}

struct nest_keys sets_wishes(const struct sets_scene *scene, const struct mesh *mesh, int l)
{
    struct sets_descent descent = {.scene = scene, .wanted = l};
    for (unsigned i = 0; i < mesh->levels[0].n_tile; i++) sets_descend(&descent, 0, mesh->levels[0].tiles[i].at);
    nest_join(mesh, l, 1, &descent.keys);
    return descent.keys;
}

static void sets_begin(const struct sets_scene *scene, struct mesh *mesh)
{
    *mesh = (struct mesh){
        .dim = scene->dim, .n_cell = 1, .n_level = 1, .ghosts = SCENE_GHOSTS, .most_level = scene->levels};
    unsigned n_tile = 1, count = 0;
    for (int d = 0; d < 3; d++) {
        bool used = d < scene->dim;
        mesh->n[d] = used ? scene->n : 1;
        mesh->n_cell *= (size_t)mesh->n[d];
        for (int l = 0; l <= scene->levels; l++) mesh->levels[l].extent[d] = used ? scene->base << l : 1;
        n_tile *= (unsigned)mesh->levels[0].extent[d];
    }
    struct tile *tiles = mem_new(n_tile, sizeof *tiles);
    for (uint64_t key = 0; count < n_tile; key++) {
        struct tile tile = {.key = key};
        morton_at(key, tile.at);
        bool inside = true;
        for (int d = 0; d < 3; d++) inside &= tile.at[d] < mesh->levels[0].extent[d];
        if (inside) tiles[count++] = tile;
    }
    replicated_adopt(&mesh->levels[0], tiles, n_tile);
}

void sets_make(const struct sets_scene *scene, struct mesh *ret_mesh)
{
    struct nest_keys wishes[MESH_LEVELS] = {0};
    struct nest_set sets[MESH_LEVELS] = {0};
    sets_begin(scene, ret_mesh);
    for (int l = 1; l <= scene->levels; l++) wishes[l] = sets_wishes(scene, ret_mesh, l);
    nest_sets(ret_mesh, 0, wishes, 2, sets);
    for (int l = 1; l <= scene->levels; l++) {
        replicated_adopt(&ret_mesh->levels[l], sets[l].tiles, sets[l].n);
        if (sets[l].n) ret_mesh->n_level = l + 1;
        nest_keys_free(&wishes[l]);
    }
    for (int l = 0; l < ret_mesh->n_level; l++) level_cover(ret_mesh, l);
    for (int l = 0; l < ret_mesh->n_level; l++) doze_level(ret_mesh, l);
}

double *sets_costs(const struct sets_scene *scene, const struct mesh *mesh, int l)
{
    const struct level *level = &mesh->levels[l];
    double *costs = mem_new(level->n_tile, sizeof *costs);
    for (unsigned i = 0; i < level->n_tile; i++) {
        costs[i] = 1.0;
        for (int f = 0; f < scene->n_feature; f++)
            if (scene->features[f].mixed && sets_meets(scene, &scene->features[f], l, level->tiles[i].at, 0.0))
                costs[i] = 2.4;
        if (level->tiles[i].hidden) costs[i] *= 0.05;
    }
    return costs;
}
