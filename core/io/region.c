/* region.c - see region.h. The fraction of a whole tile decides most tiles at once; only tiles
 * that the surface cuts keep an array. */
#include "io/region.h"

#include "base/mem.h"

struct region_piece {
    enum region_cover cover;
    double *fractions; /* [n_cell] for REGION_PART */
};

struct region {
    int n_level;
    unsigned n_local[MESH_LEVELS];
    struct region_piece *pieces[MESH_LEVELS];
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

struct region *region_new(const struct mesh *mesh, const struct shape *shape)
{
    struct region *region = mem_new(1, sizeof *region);
    region->n_level = mesh->n_level;
    for (int l = 0; l < mesh->n_level; l++) {
        const struct level *level = &mesh->levels[l];
        region->n_local[l] = level->n_local;
        region->pieces[l] = mem_new(level->n_local, sizeof *region->pieces[l]);
        for (unsigned i = 0; i < level->n_local; i++) region_measure(mesh, level, shape, i, &region->pieces[l][i]);
    }
    return region;
}

void region_free(struct region *region)
{
    if (!region) return;
    for (int l = 0; l < region->n_level; l++) {
        for (unsigned i = 0; i < region->n_local[l]; i++) mem_free(region->pieces[l][i].fractions);
        mem_free(region->pieces[l]);
    }
    mem_free(region);
}

enum region_cover region_tile(const struct region *region, int level, unsigned local, const double **ret_fractions)
{
    const struct region_piece *piece = &region->pieces[level][local];
    *ret_fractions = piece->fractions;
    return piece->cover;
}
