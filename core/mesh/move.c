/* move.c - see move.h. The set says where each tile of this rank comes from, and where each that was here goes; the
 * items of a message are in the order of the keys. */
#include "mesh/move.h"

#include "base/comm.h"
#include "base/mem.h"
#include "mesh/pool.h"
#include "mesh/post.h"

#include <math.h>
#include <string.h>

struct move {
    struct pool *pool, *kept_pool;
    struct level *level; /* as it was */
    unsigned n_local;
    size_t doubles, kept; /* of a block, and of what outputs keep */
    unsigned n_out, n_in;
    unsigned *out, *in; /* local tiles: of the old list that leave, of the new one that arrive */
    struct post_item *out_items, *in_items;
};

static struct post_item move_item(const struct move *move, int rank)
{
    return (struct post_item){.rank = rank, .doubles = 2 * move->doubles + move->kept};
}

static void move_plan(struct move *move, const struct mesh_set *set, struct mesh_change *change)
{
    const struct level *level = move->level;
    const struct tile *was = level->tiles + level->first;
    int rank = comm_rank();
    for (unsigned i = 0, old = 0; i < set->n; i++) {
        change->from[i] = -1;
        if (set->from[i] == rank) {
            while (was[old].key != set->tiles[i].key) old++;
            change->from[i] = (int)old;
        } else if (set->from[i] >= 0) {
            move->in[move->n_in] = i;
            move->in_items[move->n_in++] = move_item(move, set->from[i]);
        }
    }
    for (unsigned t = 0; set->to && t < level->n_local; t++) {
        if (set->to[t] < 0 || set->to[t] == rank) continue;
        move->out[move->n_out] = t;
        move->out_items[move->n_out++] = move_item(move, set->to[t]);
    }
}

/* A new array with the blocks of tiles that stay; the others go back to the pool. */
static double **move_keep(const struct move *move, struct pool *pool, double **old, const int *from)
{
    double **blocks = mem_new(move->n_local, sizeof *blocks);
    for (unsigned i = 0; i < move->n_local; i++)
        if (from[i] >= 0) {
            blocks[i] = old[from[i]];
            old[from[i]] = NULL;
        }
    for (unsigned t = move->level->n_local; t > 0; t--)
        if (old[t - 1]) pool_give(pool, old[t - 1]);
    mem_free(old);
    return blocks;
}

/* Missing blocks are taken array by array: those of a new level lie in three runs, each in the order of the curve. */
static void move_arrays(const struct move *move, const int *from)
{
    struct level *level = move->level;
    double ***const arrays[] = {&level->u_old, &level->u_new, &level->w};
    size_t missing = 0;
    for (unsigned i = 0; i < move->n_local; i++) missing += from[i] < 0;
    for (int a = 0; a < 3; a++) *arrays[a] = move_keep(move, move->pool, *arrays[a], from);
    pool_reserve(move->pool, 3 * missing);
    for (int a = 0; a < 3; a++)
        for (unsigned i = 0; i < move->n_local; i++)
            if (from[i] < 0) (*arrays[a])[i] = pool_take(move->pool);
}

static void move_kept(const struct move *move, const int *from)
{
    struct level *level = move->level;
    if (!move->kept) return;
    level->kept = move_keep(move, move->kept_pool, level->kept, from);
    for (unsigned i = 0; i < move->n_local; i++) {
        if (from[i] >= 0) continue;
        level->kept[i] = pool_take(move->kept_pool);
        for (size_t k = 0; k < move->kept; k++) level->kept[i][k] = NAN;
    }
}

/* What leaves is packed before its blocks are given back; what arrives is unpacked into new ones. */
static void move_data(struct move *move, int tag, const int *from)
{
    struct level *level = move->level;
    size_t bytes = move->doubles * sizeof(double), kept = move->kept * sizeof(double);
    struct post *post = post_new(tag, move->n_out, move->out_items, move->n_in, move->in_items);
    for (unsigned i = 0; i < move->n_out; i++) {
        memcpy(post_out(post, i), level->u_old[move->out[i]], bytes);
        memcpy(post_out(post, i) + move->doubles, level->w[move->out[i]], bytes);
        if (kept) memcpy(post_out(post, i) + 2 * move->doubles, level->kept[move->out[i]], kept);
    }
    post_start(post);
    move_arrays(move, from);
    move_kept(move, from);
    post_finish(post);
    for (unsigned i = 0; i < move->n_in; i++) {
        memcpy(level->u_old[move->in[i]], post_in(post, i), bytes);
        memcpy(level->w[move->in[i]], post_in(post, i) + move->doubles, bytes);
        if (kept) memcpy(level->kept[move->in[i]], post_in(post, i) + 2 * move->doubles, kept);
    }
    post_free(post);
}

void move_blocks(struct mesh *mesh, int l, const struct mesh_set *set, struct mesh_change *ret_change)
{
    struct level *level = &mesh->levels[l];
    struct move move = {.pool = mesh->pool,
                        .kept_pool = mesh->kept_pool,
                        .level = level,
                        .n_local = set->n,
                        .doubles = mesh->n_field * mesh->n_cell,
                        .kept = mesh->n_kept * mesh->n_cell};
    move.out = mem_new(level->n_local, sizeof *move.out);
    move.out_items = mem_new(level->n_local, sizeof *move.out_items);
    move.in = mem_new(move.n_local, sizeof *move.in);
    move.in_items = mem_new(move.n_local, sizeof *move.in_items);
    *ret_change =
        (struct mesh_change){.from = mem_new(move.n_local, sizeof *ret_change->from), .n_before = level->n_local};
    move_plan(&move, set, ret_change);
    move_data(&move, POST_MOVE + l, ret_change->from);
    mem_free(move.in_items);
    mem_free(move.in);
    mem_free(move.out_items);
    mem_free(move.out);
}
