/* roll.h - the list of all tiles in a file, of which each rank knows its own and their places.
 *
 * Level by level, along the curve; where a rank's tiles begin is how many lower ranks have. The ranks hand their rows
 * to rank 0 in the order of the file, a bounded piece at a time, so that nobody ever holds the list. */
#ifndef ROLL_H
#define ROLL_H

#include "io/h5out.h"
#include "mesh/mesh.h"

struct roll {
    const struct mesh *mesh;
    size_t n_tile;                         /* of all levels and ranks */
    struct h5out_range tiles[MESH_LEVELS]; /* places of this rank's */
};

/* Collective. */
void roll_take(const struct mesh *mesh, struct roll *ret_roll);

/* Level and local index of an own tile by its place. */
unsigned roll_local(const struct roll *roll, size_t place, int *ret_level);

/* Writes a data set of `columns` numbers per tile, which `row` tells; as h5out_write with `central` and `hash`. */
int roll_write(struct h5 *file, const char *path, const struct roll *roll, unsigned columns,
               void (*row)(int level, const struct tile *tile, int32_t *ret_numbers), uint64_t *ret_hash);

#endif
