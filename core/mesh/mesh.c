/* mesh.c - the mesh as a whole: tile size, level 0, replacing the tiles of a level, and where a point lies. What
 * follows from a list of tiles is made in level.c, halo.c and link.c, blocks are moved in move.c.
 *
 * Main invariant: tiles are sorted by key, and every rank knows all tiles that anything of its own touches
 * (mesh/fringe.h), so that who owns these, and what must be exchanged with whom, follows on both ranks from the same
 * data without a message. Storage is three arrays per tile (u_old, u_new, w), component-major and without ghosts:
 * measured cheaper than stored ghost frames (docs/decisions). */
#include "mesh/mesh.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "mesh/doze.h"
#include "mesh/fringe.h"
#include "mesh/halo.h"
#include "mesh/level.h"
#include "mesh/link.h"
#include "mesh/morton.h"
#include "mesh/move.h"
#include "mesh/pool.h"
#include "mesh/rigid.h"
#include "mesh/rim.h"
#include "mesh/span.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>

enum { MESH_TILE_LEAST = 4 };

static int mesh_gcd(int a, int b)
{
    return b ? mesh_gcd(b, a % b) : a;
}

static int mesh_refuse(const struct scene *scene, int common)
{
    struct text counts = {0};
    for (int d = 0; d < scene->domain.dim; d++)
        text_add(&counts, "%s%d", d ? ", " : "", (scene->domain.cells[d] + 15) / 16 * 16);
    status_fail(STATUS_CASE,
                "%s: domain.cells: the counts have no common %stile side from %d to %d (greatest common divisor %d); "
                "try [%s]",
                scene->domain.cells_place, scene->mesh.levels > 0 ? "even " : "", MESH_TILE_LEAST,
                scene->domain.dim == 1 ? 64 : 16, common, counts.at);
    text_done(&counts);
    return 0;
}

/* Refined tiles lie under octants of n / 2 cells, which must hold the layers that a neighbour needs. */
static bool mesh_tile_halves(const struct scene *scene, int n)
{
    return !scene->mesh.levels || (n % 2 == 0 && n >= 2 * scene->scheme.ghosts);
}

static int mesh_tile_given(const struct scene *scene, int common)
{
    if (common % scene->mesh.tile) {
        status_fail(STATUS_CASE, "%s: mesh.tile: %d does not divide all of domain.cells (greatest common divisor %d)",
                    scene->domain.cells_place, scene->mesh.tile, common);
        return 0;
    }
    if (mesh_tile_halves(scene, scene->mesh.tile)) return scene->mesh.tile;
    status_fail(STATUS_CASE,
                "%s: mesh.tile: %d cannot be refined: with mesh.levels above 0 it must be even and at least %d",
                scene->domain.cells_place, scene->mesh.tile, 2 * scene->scheme.ghosts);
    return 0;
}

int mesh_tile_size(const struct scene *scene)
{
    int common = scene->domain.cells[0];
    for (int d = 1; d < scene->domain.dim; d++) common = mesh_gcd(common, scene->domain.cells[d]);
    int n = scene->mesh.tile ? mesh_tile_given(scene, common) : scene_mesh_tile(scene);
    if (!n && !scene->mesh.tile) return mesh_refuse(scene, common);
    for (int d = 0; n && d < scene->domain.dim; d++)
        if (scene->domain.cells[d] / n > MORTON_MOST >> scene->mesh.levels) {
            status_fail(
                STATUS_CASE,
                "%s: domain.cells: %d cells in tiles of %d with %d finer levels are more than the %d tiles along an "
                "axis that can be numbered; try fewer mesh.levels or larger tiles",
                scene->domain.cells_place, scene->domain.cells[d], n, scene->mesh.levels, MORTON_MOST);
            n = 0;
        }
    return n;
}

/* A cube of the curve, `size` tiles along each axis, from `key` on. */
struct mesh_cube {
    uint64_t key;
    int size;
};

/* Its tiles in the domain. */
static unsigned mesh_cube_tiles(const int extent[3], struct mesh_cube cube)
{
    int at[3], count = 1;
    morton_at(cube.key, at);
    for (int d = 0; d < 3; d++) {
        int rest = extent[d] - at[d];
        count *= rest < 0 ? 0 : rest < cube.size ? rest : cube.size;
    }
    return (unsigned)count;
}

/* The tiles `from` to `to` - 1 of those of the domain in a cube, along the curve: into `tiles`; returns their end. */
static struct tile *mesh_fill_cube(const int extent[3], struct mesh_cube cube, unsigned from, unsigned to,
                                   struct tile *tiles)
{
    unsigned n = mesh_cube_tiles(extent, cube);
    if (from >= n || from >= to) return tiles;
    if (cube.size == 1) {
        *tiles = (struct tile){.key = cube.key};
        morton_at(cube.key, tiles->at);
        return tiles + 1;
    }
    for (uint64_t octant = 0; octant < MESH_OCTANTS; octant++) {
        int half = cube.size / 2;
        uint64_t volume = (uint64_t)half * (uint64_t)half * (uint64_t)half;
        struct mesh_cube part = {cube.key + octant * volume, half};
        n = mesh_cube_tiles(extent, part);
        tiles = mesh_fill_cube(extent, part, from, to, tiles);
        from = from > n ? from - n : 0;
        to = to > n ? to - n : 0;
    }
    return tiles;
}

/* All tiles of the domain, cut into equal pieces of the curve. */
static struct mesh_set mesh_fill(const int extent[3])
{
    struct mesh_set set = {.n_tile = (unsigned)(extent[0] * extent[1] * extent[2])};
    struct mesh_cube all = {0, 1};
    uint64_t size = (uint64_t)comm_size(), rank = (uint64_t)comm_rank();
    while (all.size < extent[0] || all.size < extent[1] || all.size < extent[2]) all.size *= 2;
    unsigned first = (unsigned)(set.n_tile * rank / size), end = (unsigned)(set.n_tile * (rank + 1) / size);
    set.n = end - first;
    set.tiles = mem_new(set.n, sizeof *set.tiles);
    mesh_fill_cube(extent, all, first, end, set.tiles);
    set.from = mem_new(set.n, sizeof *set.from);
    for (unsigned i = 0; i < set.n; i++) set.from[i] = -1;
    set.first_keys = mem_new(size, sizeof *set.first_keys);
    for (uint64_t r = 0; r < size; r++) {
        struct tile tile;
        first = (unsigned)(set.n_tile * r / size);
        bool any = mesh_fill_cube(extent, all, first, first + 1, &tile) != &tile;
        set.first_keys[r] = any ? tile.key : UINT64_MAX;
    }
    return set;
}

static void mesh_measure(struct mesh *mesh, const struct scene *scene, int n)
{
    mesh->n_cell = 1;
    for (int d = 0; d < 3; d++) {
        bool used = d < scene->domain.dim;
        mesh->lower[d] = scene->domain.lower[d];
        mesh->upper[d] = scene->domain.upper[d];
        mesh->n[d] = used ? n : 1;
        mesh->n_cell *= (size_t)mesh->n[d];
        mesh->periodic[d] = used && scene_boundary_is(scene, 2 * d, SCENE_BOUNDARY_WRAPS);
        mesh->levels[0].extent[d] = used ? scene->domain.cells[d] / n : 1;
        mesh->levels[0].h[d] = used ? (scene->domain.upper[d] - scene->domain.lower[d]) / scene->domain.cells[d] : 1.0;
        for (int l = 1; l <= mesh->most_level; l++) {
            mesh->levels[l].extent[d] = mesh->levels[l - 1].extent[d] * (used ? 2 : 1);
            mesh->levels[l].h[d] = mesh->levels[l - 1].h[d] / (used ? 2.0 : 1.0);
        }
    }
}

int mesh_new(const struct scene *scene, unsigned n_field, unsigned n_alpha, struct mesh **ret_mesh)
{
    int n = mesh_tile_size(scene);
    if (!n) return STATUS_CASE;
    struct mesh *mesh = mem_new(1, sizeof *mesh);
    mesh->dim = scene->domain.dim;
    mesh->beta = (int)scene->domain.geometry;
    mesh->n_field = n_field;
    mesh->n_alpha = n_alpha;
    mesh->turns =
        scene_domain_swirls(&scene->domain) ? n_alpha + scene->n_material + 2 : UINT_MAX; /* model_is_turn() */
    mesh->ghosts = scene->scheme.ghosts;
    mesh->n_face_u = n_alpha > 0;
    for (unsigned l = 0; l < scene->n_material; l++)
        if (scene->material[l].constitutive.module) mesh->n_face_u = (unsigned)scene->domain.n_velocity;
    for (unsigned l = 0; l < scene->n_material; l++)
        mesh->corners = mesh->corners || scene->material[l].viscosity.module;
    mesh->corners = mesh->corners || (scene->n_tension && mesh->dim > 1);
    mesh->sleepless = scene->scheme.diffusion == SCENE_DIFFUSION_RKL2;
    mesh->most_level = scene->mesh.levels;
    mesh_measure(mesh, scene, n);
    mesh->pool = pool_new(n_field * mesh->n_cell);
    mesh->n_kept = scene->output.n_kept;
    if (mesh->n_kept) mesh->kept_pool = pool_new(mesh->n_kept * mesh->n_cell);
    mesh->rims = rim_shelf_new();
    mesh->rigid = rigid_new(scene);
    struct mesh_set set = mesh_fill(mesh->levels[0].extent);
    struct mesh_change change;
    mesh_replace(mesh, 0, 0, &set, &change);
    mesh_change_free(&change);
    *ret_mesh = mesh;
    return STATUS_OK;
}

/* Everything of a level but its blocks. */
static void mesh_drop(struct level *level)
{
    halo_free(level->halo);
    link_free(level->link);
    mem_free(level->u_old);
    mem_free(level->u_new);
    mem_free(level->w);
    mem_free(level->kept);
    level->halo = NULL;
    level->link = NULL;
    level->u_old = level->u_new = level->w = level->kept = NULL;
    level_drop(level);
}

void mesh_free(struct mesh *mesh)
{
    if (!mesh) return;
    for (int l = 0; l < mesh->n_level; l++) mesh_drop(&mesh->levels[l]);
    rim_shelf_free(mesh->rims);
    rigid_free(mesh->rigid);
    pool_free(mesh->pool);
    pool_free(mesh->kept_pool);
    mem_free(mesh);
}

static void mesh_link(struct mesh *mesh, int l)
{
    if (l < 1 || l >= mesh->n_level) return;
    link_free(mesh->levels[l].link);
    mesh->levels[l].link = link_new(mesh, l);
}

/* Gives a level its own piece of the new set; takes over what is left of it. */
static void mesh_enter(struct level *level, struct mesh_set *set)
{
    for (unsigned i = 0; i < set->n; i++) {
        set->tiles[i].rank = comm_rank();
        set->tiles[i].born = set->from[i] < 0;
    }
    mem_free(level->first_keys);
    level->n_tile = set->n_tile;
    level->n_rank = comm_size();
    level->first_keys = set->first_keys;
    level_adopt(level, set->tiles, set->n);
    mem_free(set->from);
    mem_free(set->to);
    *set = (struct mesh_set){0};
}

static bool *mesh_born(const struct level *level)
{
    bool *born = mem_new(level->n_known, sizeof *born);
    for (unsigned i = 0; i < level->n_known; i++) born[i] = level->tiles[i].born;
    return born;
}

/* All that hangs on the tiles of the levels `lowest` to `highest`; how deep tiles sleep hangs on all levels below. */
static void mesh_connect(struct mesh *mesh, int lowest, int highest)
{
    int below = lowest > 0 ? lowest - 1 : 0, above = highest + 1 < mesh->n_level ? highest + 1 : mesh->n_level - 1;
    fringe_learn(mesh, below, above);
    for (int l = below; l <= above; l++) level_cover(mesh, l);
    for (int l = below; l < mesh->n_level; l++) doze_level(mesh, l);
    for (int l = lowest; l <= highest && l < mesh->n_level; l++) {
        struct level *level = &mesh->levels[l];
        level_connect(mesh, level);
        halo_free(level->halo);
        level->halo = halo_new(mesh, level, mesh->n_field);
    }
    for (int l = lowest; l < mesh->n_level; l++) mesh_link(mesh, l);
}

void mesh_replace(struct mesh *mesh, int lowest, int highest, struct mesh_set *sets, struct mesh_change *ret_changes)
{
    mesh->revision++;
    for (int l = lowest; l <= highest + 1; l++) rim_shelf_drop(mesh->rims, l);
    for (int l = lowest; l <= highest; l++) {
        struct level *level = &mesh->levels[l];
        move_blocks(mesh, l, &sets[l], &ret_changes[l]);
        mesh_enter(level, &sets[l]);
        if (level->n_tile && l == mesh->n_level) mesh->n_level++;
    }
    while (!mesh->levels[mesh->n_level - 1].n_tile) mesh_drop(&mesh->levels[--mesh->n_level]);
    mesh_connect(mesh, lowest, highest);
    for (int l = lowest; l <= highest; l++) ret_changes[l].born = mesh_born(&mesh->levels[l]);
}

void mesh_change_free(struct mesh_change *change)
{
    mem_free(change->from);
    mem_free(change->born);
    *change = (struct mesh_change){0};
}

void mesh_corner(const struct mesh *mesh, const struct level *level, const struct tile *tile, double ret_corner[3])
{
    for (int d = 0; d < 3; d++) ret_corner[d] = mesh->lower[d] + (double)(tile->at[d] * mesh->n[d]) * level->h[d];
}

int mesh_find(const struct mesh *mesh, const struct level *level, const int at[3])
{
    int wrapped[3];
    for (int d = 0; d < 3; d++) {
        int extent = level->extent[d];
        wrapped[d] = mesh->periodic[d] ? (at[d] % extent + extent) % extent : at[d];
        if (wrapped[d] < 0 || wrapped[d] >= extent) return -1;
    }
    return level_find(level, morton_key(wrapped));
}

/* The cell of a level that holds x: the place of its tile, and which of its cells. */
static size_t mesh_cell_at(const struct mesh *mesh, const struct level *level, const double x[3], int ret_at[3])
{
    size_t cell = 0;
    for (int d = 0; d < 3; d++) ret_at[d] = 0;
    for (int d = mesh->dim - 1; d >= 0; d--) {
        int n = mesh->n[d], last = level->extent[d] * n - 1;
        double place = floor((x[d] - mesh->lower[d]) / level->h[d]);
        int i = place >= last ? last : place > 0.0 ? (int)place : 0;
        ret_at[d] = i / n;
        cell = cell * (size_t)n + (size_t)(i % n);
    }
    return cell;
}

bool mesh_locate(const struct mesh *mesh, const double x[3], int *ret_level, unsigned *ret_local, size_t *ret_cell)
{
    for (int l = mesh->n_level - 1; l >= 0; l--) {
        const struct level *level = &mesh->levels[l];
        int at[3];
        *ret_level = l;
        *ret_cell = mesh_cell_at(mesh, level, x, at);
        *ret_local = (unsigned)mesh_find(mesh, level, at) - level->first;
        if (*ret_local >= level->n_local) continue;
        unsigned covered = level->tiles[level->first + *ret_local].covered;
        return !(covered >> mesh_octant(mesh, *ret_cell) & 1u);
    }
    return false;
}

int mesh_octant(const struct mesh *mesh, size_t cell)
{
    int octant = 0;
    for (int d = 0; d < mesh->dim; d++) {
        size_t n = (size_t)mesh->n[d];
        if (cell % n >= n / 2) octant |= 1 << d;
        cell /= n;
    }
    return octant;
}

void mesh_leaves(const struct mesh *mesh, const struct tile *tile, double *ret_leaf)
{
    const int *n = mesh->n;
    for (int k = 0; k < n[2]; k++)
        for (int j = 0; j < n[1]; j++, ret_leaf += n[0]) {
            int above = (mesh->dim > 1 && j >= n[1] / 2 ? 2 : 0) + (mesh->dim > 2 && k >= n[2] / 2 ? 4 : 0);
            double lower = tile->covered >> above & 1 ? 0.0 : 1.0, upper = tile->covered >> (above + 1) & 1 ? 0.0 : 1.0;
            for (int i = 0; i < n[0]; i++) ret_leaf[i] = i < n[0] / 2 ? lower : upper;
        }
}

void mesh_swap(struct level *level)
{
    double **keep = level->u_old;
    level->u_old = level->u_new;
    level->u_new = keep;
}

double mesh_bytes(const struct mesh *mesh, double n_tile)
{
    double kept = mesh->kept_pool ? (double)pool_bytes(mesh->kept_pool) : 0.0;
    return n_tile * (3.0 * (double)pool_bytes(mesh->pool) + kept);
}
