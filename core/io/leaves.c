/* leaves.c - see leaves.h. */
#include "io/leaves.h"

#include "base/comm.h"
#include "base/mem.h"

static void leaves_add(struct leaves *leaves, struct leaves_run *run, struct leaves_block block)
{
    block.first = leaves->n_cell;
    if (leaves->mesh->levels[block.level].tiles[block.tile].rank == comm_rank()) {
        if (!run->local) run->local_first = block.first;
        run->local += run->cells;
    }
    leaves->blocks[leaves->n_block++] = block;
    leaves->n_cell += run->cells;
    run->n++;
}

static void leaves_add_level(struct leaves *leaves, int l)
{
    const struct mesh *mesh = leaves->mesh;
    const struct level *level = &mesh->levels[l];
    for (int kind = 0; kind < LEAVES_KINDS; kind++) {
        struct leaves_run *run = &leaves->runs[l][kind];
        *run = (struct leaves_run){.from = leaves->n_block, .first = leaves->n_cell};
        run->cells = kind ? mesh->n_cell >> mesh->dim : mesh->n_cell;
        run->local_first = leaves->n_cell;
        for (unsigned t = 0; t < level->n_tile; t++) {
            unsigned covered = level->tiles[t].covered;
            if ((covered != 0) != kind) continue;
            if (!kind) leaves_add(leaves, run, (struct leaves_block){.level = l, .tile = t, .octant = LEAVES_WHOLE});
            for (int o = 0; kind && o < 1 << mesh->dim; o++)
                if (!(covered >> o & 1))
                    leaves_add(leaves, run, (struct leaves_block){.level = l, .tile = t, .octant = o});
        }
    }
}

struct leaves *leaves_new(const struct mesh *mesh)
{
    struct leaves *leaves = mem_new(1, sizeof *leaves);
    size_t most = 0;
    for (int l = 0; l < mesh->n_level; l++) most += mesh->levels[l].n_tile;
    leaves->mesh = mesh;
    leaves->blocks = mem_new(most << mesh->dim, sizeof *leaves->blocks);
    for (int l = 0; l < mesh->n_level; l++) leaves_add_level(leaves, l);
    return leaves;
}

void leaves_free(struct leaves *leaves)
{
    if (leaves) mem_free(leaves->blocks);
    mem_free(leaves);
}

unsigned leaves_find(const struct leaves *leaves, size_t cell)
{
    unsigned low = 0, high = leaves->n_block;
    while (high - low > 1) {
        unsigned middle = low + (high - low) / 2;
        if (leaves->blocks[middle].first <= cell) low = middle;
        else high = middle;
    }
    return low;
}

size_t leaves_cells(const struct leaves *leaves, unsigned block)
{
    const struct leaves_block *at = &leaves->blocks[block];
    return leaves->runs[at->level][at->octant != LEAVES_WHOLE].cells;
}

void leaves_box(const struct leaves *leaves, unsigned block, int ret_from[3], int ret_count[3])
{
    const struct mesh *mesh = leaves->mesh;
    int octant = leaves->blocks[block].octant;
    for (int axis = 0; axis < 3; axis++) {
        bool cut = octant != LEAVES_WHOLE && axis < mesh->dim;
        ret_count[axis] = cut ? mesh->n[axis] / 2 : mesh->n[axis];
        ret_from[axis] = cut && octant >> axis & 1 ? mesh->n[axis] / 2 : 0;
    }
}
