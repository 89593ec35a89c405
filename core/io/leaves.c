/* leaves.c - see leaves.h. */
#include "io/leaves.h"

#include "base/gather.h"
#include "base/comm.h"
#include "base/mem.h"

static bool leaves_is_open(int kind, unsigned covered, int octant)
{
    if (!kind) return covered == 0 && octant == 0;
    return covered != 0 && !(covered >> octant & 1);
}

/* Appends this rank's blocks of a kind of a level. */
static void leaves_add(struct leaves *leaves, int l, int kind)
{
    const struct level *level = &leaves->mesh->levels[l];
    struct leaves_run *run = &leaves->runs[l][kind];
    *run =
        (struct leaves_run){.from = leaves->n_block, .cells = leaves->mesh->n_cell >> (kind ? leaves->mesh->dim : 0)};
    for (unsigned t = level->first; t < level->first + level->n_local; t++)
        for (int o = 0; o < 1 << leaves->mesh->dim; o++)
            if (leaves_is_open(kind, level->tiles[t].covered, o))
                leaves->blocks[leaves->n_block++] =
                    (struct leaves_block){.level = l, .tile = t, .octant = kind ? o : LEAVES_WHOLE};
    run->n = leaves->n_block - run->from;
}

/* Numbers the cells: what lies before a rank's blocks is what others have. */
static void leaves_number(struct leaves *leaves)
{
    struct leaves_run *runs = leaves->runs[0];
    int n_run = leaves->mesh->n_level * LEAVES_KINDS;
    long long all[MESH_LEVELS * LEAVES_KINDS], before[MESH_LEVELS * LEAVES_KINDS];
    for (int i = 0; i < n_run; i++) all[i] = runs[i].n;
    gather_sums(all, n_run, before);
    for (int i = 0; i < n_run; i++) {
        struct leaves_run *run = &runs[i];
        run->all = (size_t)all[i];
        run->before = (size_t)before[i];
        run->first = leaves->n_cell;
        run->local_first = run->first + run->before * run->cells;
        run->local = run->n * run->cells;
        leaves->n_cell += run->all * run->cells;
        for (unsigned b = 0; b < run->n; b++) leaves->blocks[run->from + b].first = run->local_first + b * run->cells;
    }
}

struct leaves *leaves_new(const struct mesh *mesh)
{
    struct leaves *leaves = mem_new(1, sizeof *leaves);
    size_t most = 0;
    for (int l = 0; l < mesh->n_level; l++) most += mesh->levels[l].n_local;
    leaves->mesh = mesh;
    leaves->blocks = mem_new(most << mesh->dim, sizeof *leaves->blocks);
    for (int l = 0; l < mesh->n_level; l++)
        for (int kind = 0; kind < LEAVES_KINDS; kind++) leaves_add(leaves, l, kind);
    leaves_number(leaves);
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
