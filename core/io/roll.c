/* roll.c - see roll.h. */
#include "io/roll.h"

#include "base/gather.h"
#include "base/comm.h"

/* For h5out: what a row is made of. */
struct roll_rows {
    const struct roll *roll;
    unsigned columns;
    void (*row)(int, const struct tile *, int32_t *);
};

void roll_take(const struct mesh *mesh, struct roll *ret_roll)
{
    long long all[MESH_LEVELS] = {0}, before[MESH_LEVELS];
    *ret_roll = (struct roll){.mesh = mesh};
    for (int l = 0; l < mesh->n_level; l++) all[l] = mesh->levels[l].n_local;
    gather_sums(all, mesh->n_level, before);
    for (int l = 0; l < mesh->n_level; l++) {
        const struct level *level = &mesh->levels[l];
        ret_roll->tiles[l] = (struct h5out_range){ret_roll->n_tile + (size_t)before[l], level->n_local};
        ret_roll->n_tile += level->n_tile;
    }
}

unsigned roll_local(const struct roll *roll, size_t place, int *ret_level)
{
    int l = 0;
    while (place < roll->tiles[l].first || place - roll->tiles[l].first >= roll->tiles[l].count) l++;
    *ret_level = l;
    return (unsigned)(place - roll->tiles[l].first);
}

static void roll_fill(void *context, size_t first, size_t count, void *out)
{
    const struct roll_rows *rows = context;
    int32_t *to = out;
    for (size_t i = 0; i < count; i++, to += rows->columns) {
        int l;
        unsigned local = roll_local(rows->roll, first + i, &l);
        const struct level *level = &rows->roll->mesh->levels[l];
        rows->row(l, &level->tiles[level->first + local], to);
    }
}

int roll_write(struct h5 *file, const char *path, const struct roll *roll, unsigned columns,
               void (*row)(int, const struct tile *, int32_t *), uint64_t *ret_hash)
{
    struct roll_rows context = {roll, columns, row};
    const struct h5out_rows rows = {.type = H5_I32,
                                    .columns = columns,
                                    .total = roll->n_tile,
                                    .chunk = H5OUT_TABLE / (columns * sizeof(int32_t)),
                                    .central = true,
                                    .hash = ret_hash,
                                    .n_range = (unsigned)roll->mesh->n_level,
                                    .ranges = roll->tiles,
                                    .fill = roll_fill,
                                    .context = &context};
    return h5out_write(file, path, &rows);
}
