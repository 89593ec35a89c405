/* region.c - see region.h. The fraction of a whole tile decides most tiles at once; only tiles
 * that the surface cuts keep an array. */
#include "io/region.h"

#include "base/mem.h"

struct region_piece {
    uint64_t key; /* of the tile */
    enum region_cover cover;
    double *fractions; /* [n_cell] for REGION_PART */
};

struct region_level {
    unsigned n; /* local tiles */
    struct region_piece *pieces;
};

struct region {
    const struct shape *shape;
    unsigned revision; /* of the mesh that it was taken for */
    struct region_level levels[MESH_LEVELS];
};

/* The box of `count` cells from cell `at` of a tile on. */
static double region_fraction(const struct mesh *mesh, const struct level *level, const struct shape *shape,
                              const double corner[3], const int at[3], const int count[3])
{
    double lower[3], upper[3];
    for (int axis = 0; axis < 3; axis++) {
        lower[axis] = corner[axis] + at[axis] * level->h[axis];
        upper[axis] = corner[axis] + (at[axis] + count[axis]) * level->h[axis];
    }
    return shape_fraction(shape, lower, upper, mesh->dim, mesh->beta);
}

static void region_measure(const struct mesh *mesh, const struct level *level, const struct shape *shape,
                           unsigned local, struct region_piece *piece)
{
    double corner[3];
    mesh_corner(mesh, level, &level->tiles[level->first + local], corner);
    double whole = region_fraction(mesh, level, shape, corner, (const int[]){0, 0, 0}, mesh->n);
    piece->cover = whole <= 0.0 ? REGION_NONE : whole >= 1.0 ? REGION_ALL : REGION_PART;
    if (piece->cover != REGION_PART) return;
    piece->fractions = mem_new(mesh->n_cell, sizeof *piece->fractions);
    size_t cell = 0;
    int at[3];
    for (at[2] = 0; at[2] < mesh->n[2]; at[2]++)
        for (at[1] = 0; at[1] < mesh->n[1]; at[1]++)
            for (at[0] = 0; at[0] < mesh->n[0]; at[0]++)
                piece->fractions[cell++] = region_fraction(mesh, level, shape, corner, at, (const int[]){1, 1, 1});
}

/* Moves over what is known of tiles that were here before; both lists are in the order of their keys. */
static void region_measure_level(const struct mesh *mesh, const struct shape *shape, int l, struct region_level *before,
                                 struct region_level *after)
{
    const struct level *level = &mesh->levels[l];
    unsigned old = 0;
    after->n = level->n_local;
    after->pieces = mem_new(after->n, sizeof *after->pieces);
    for (unsigned i = 0; i < after->n; i++) {
        uint64_t key = level->tiles[level->first + i].key;
        while (old < before->n && before->pieces[old].key < key) old++;
        if (old < before->n && before->pieces[old].key == key) {
            after->pieces[i] = before->pieces[old];
            before->pieces[old].fractions = NULL;
        } else {
            after->pieces[i].key = key;
            region_measure(mesh, level, shape, i, &after->pieces[i]);
        }
    }
}

static void region_done(struct region_level *level)
{
    for (unsigned i = 0; i < level->n; i++) mem_free(level->pieces[i].fractions);
    mem_free(level->pieces);
    *level = (struct region_level){0};
}

static void region_take(struct region *region, const struct mesh *mesh)
{
    for (int l = 0; l < MESH_LEVELS; l++) {
        struct region_level before = region->levels[l];
        region->levels[l] = (struct region_level){0};
        if (l < mesh->n_level) region_measure_level(mesh, region->shape, l, &before, &region->levels[l]);
        region_done(&before);
    }
    region->revision = mesh->revision;
}

struct region *region_new(const struct mesh *mesh, const struct shape *shape)
{
    struct region *region = mem_new(1, sizeof *region);
    region->shape = shape;
    region_take(region, mesh);
    return region;
}

void region_follow(struct region *region, const struct mesh *mesh)
{
    if (region && region->revision != mesh->revision) region_take(region, mesh);
}

void region_free(struct region *region)
{
    if (!region) return;
    for (int l = 0; l < MESH_LEVELS; l++) region_done(&region->levels[l]);
    mem_free(region);
}

enum region_cover region_tile(const struct region *region, int level, unsigned local, const double **ret_fractions)
{
    const struct region_piece *piece = &region->levels[level].pieces[local];
    *ret_fractions = piece->fractions;
    return piece->cover;
}
