/* doze.c - see doze.h. */
#include "mesh/doze.h"

#include "base/mem.h"
#include "mesh/level.h"
#include "mesh/post.h"

/* Curvatures look this far, those of tiles beside one that is advanced too: smaller tiles would let them see one that
 * sleeps. */
enum { DOZE_CURVES = 6 };

/* Flags under way: one number for each tile and rank that is told of it. */
struct doze {
    const struct level *level; /* whose tiles they are of */
    unsigned char (*flag)(const struct tile *tile);
    unsigned n_out, n_in, room_out, room_in;
    struct post_item *out, *in;
    unsigned *from, *to; /* indices in the list of the level */
};

static bool doze_is_own(const struct level *level, unsigned tile)
{
    return tile - level->first < level->n_local;
}

static void doze_add(unsigned *n, unsigned *room, struct post_item **items, unsigned **tiles, int rank, unsigned tile)
{
    if (*n == *room) {
        *items = mem_grow(*items, *room, 2 * *room + 64, sizeof **items);
        *tiles = mem_grow(*tiles, *room, 2 * *room + 64, sizeof **tiles);
        *room = 2 * *room + 64;
    }
    (*items)[*n] = (struct post_item){.rank = rank, .doubles = 1};
    (*tiles)[(*n)++] = tile;
}

/* Tells a rank of an own tile, once. `mark`: where what is said of this tile begins. */
static void doze_tell(struct doze *doze, unsigned mark, int rank, unsigned tile)
{
    for (unsigned i = mark; i < doze->n_out; i++)
        if (doze->out[i].rank == rank) return;
    doze_add(&doze->n_out, &doze->room_out, &doze->out, &doze->from, rank, tile);
}

static void doze_hear(struct doze *doze, unsigned tile)
{
    doze_add(&doze->n_in, &doze->room_in, &doze->in, &doze->to, doze->level->tiles[tile].rank, tile);
}

/* Sends the flags; those that came stay in the post. */
static struct post *doze_exchange(struct doze *doze, int tag)
{
    struct post *post = post_new(POST_DOZE + tag, doze->n_out, doze->out, doze->n_in, doze->in);
    for (unsigned i = 0; i < doze->n_out; i++) *post_out(post, i) = doze->flag(&doze->level->tiles[doze->from[i]]);
    post_start(post);
    post_finish(post);
    return post;
}

static void doze_done(struct doze *doze, struct post *post)
{
    post_free(post);
    mem_free(doze->out);
    mem_free(doze->in);
    mem_free(doze->from);
    mem_free(doze->to);
}

static unsigned char doze_hidden(const struct tile *tile)
{
    return tile->hidden;
}

static unsigned char doze_depth(const struct tile *tile)
{
    return tile->sleeps;
}

/* Own tiles that are wholly covered, and such tiles of others around them. */
static void doze_list_around(const struct mesh *mesh, struct doze *doze)
{
    const struct level *level = doze->level;
    unsigned char whole = level_whole(mesh);
    bool *beside = mem_new(level->n_known, sizeof *beside), all;
    for (unsigned t = level->first; t < level->first + level->n_local; t++) {
        unsigned around[26], mark = doze->n_out;
        if (level->tiles[t].covered != whole) continue;
        for (int i = 0, n = level_around(mesh, level, &level->tiles[t], around, &all); i < n; i++) {
            const struct tile *other = &level->tiles[around[i]];
            if (doze_is_own(level, around[i]) || other->covered != whole) continue;
            beside[around[i]] = true;
            doze_tell(doze, mark, other->rank, t);
        }
    }
    for (unsigned t = 0; t < level->n_known; t++)
        if (beside[t]) doze_hear(doze, t);
    mem_free(beside);
}

/* `hidden` of wholly covered tiles around own ones. */
static void doze_learn_hidden(struct mesh *mesh, int l)
{
    struct level *level = &mesh->levels[l];
    struct doze doze = {.level = level, .flag = doze_hidden};
    for (unsigned t = 0; t < level->n_known; t++)
        if (!doze_is_own(level, t)) level->tiles[t].hidden = false;
    doze_list_around(mesh, &doze);
    struct post *post = doze_exchange(&doze, l);
    for (unsigned i = 0; i < doze.n_in; i++) level->tiles[doze.to[i]].hidden = *post_in(post, i) > 0.0;
    doze_done(&doze, post);
}

/* Are all tiles there that can lie over the one that holds this key? Who has one of them knows. */
static bool doze_covers(const struct mesh *mesh, const struct level *fine, uint64_t key)
{
    for (unsigned o = 0; o < 1u << mesh->dim; o++)
        if (level_find(fine, key >> 3 << 3 | o) < 0) return false;
    return true;
}

/* Own coarse tiles that are wholly covered, to the owners of what covers them; and the other way round. */
static void doze_list_below(const struct mesh *mesh, const struct level *fine, struct doze *doze)
{
    const struct level *coarse = doze->level;
    int last = -1;
    for (unsigned t = coarse->first; t < coarse->first + coarse->n_local; t++) {
        unsigned mark = doze->n_out;
        if (coarse->tiles[t].covered != level_whole(mesh)) continue;
        for (unsigned o = 0; o < 1u << mesh->dim; o++) {
            int child = level_find(fine, coarse->tiles[t].key << 3 | o);
            if (!doze_is_own(fine, (unsigned)child)) doze_tell(doze, mark, fine->tiles[child].rank, t);
        }
    }
    for (unsigned t = fine->first; t < fine->first + fine->n_local; t++) {
        uint64_t key = fine->tiles[t].key;
        int parent = level_find(coarse, key >> 3);
        if (parent < 0 || parent == last || doze_is_own(coarse, (unsigned)parent)) continue;
        if (doze_covers(mesh, fine, key)) doze_hear(doze, (unsigned)parent);
        last = parent;
    }
}

/* `sleeps` of the tiles that own ones of level l lie over. */
static void doze_learn_depth(struct mesh *mesh, int l)
{
    struct level *coarse = &mesh->levels[l - 1];
    struct doze doze = {.level = coarse, .flag = doze_depth};
    for (unsigned t = 0; t < coarse->n_known; t++)
        if (!doze_is_own(coarse, t)) coarse->tiles[t].sleeps = 0;
    doze_list_below(mesh, &mesh->levels[l], &doze);
    struct post *post = doze_exchange(&doze, l);
    for (unsigned i = 0; i < doze.n_in; i++) coarse->tiles[doze.to[i]].sleeps = (unsigned char)*post_in(post, i);
    doze_done(&doze, post);
}

/* Are all tiles around an own one hidden, as it is? */
static bool doze_is_deep(const struct mesh *mesh, const struct level *level, const struct tile *tile)
{
    unsigned around[26];
    bool all;
    if (!tile->hidden) return false;
    int n = level_around(mesh, level, tile, around, &all);
    for (int i = 0; all && i < n; i++) all = level->tiles[around[i]].hidden;
    return all;
}

void doze_level(struct mesh *mesh, int l)
{
    struct level *level = &mesh->levels[l];
    bool never = mesh->sleepless || (mesh->corners && mesh->n[0] < DOZE_CURVES);
    if (l > 0) doze_learn_depth(mesh, l);
    doze_learn_hidden(mesh, l);
    for (unsigned t = level->first; t < level->first + level->n_local; t++) {
        struct tile *tile = &level->tiles[t];
        int below = l > 0 ? level_find(level - 1, tile->key >> 3) : -1;
        unsigned depth = below < 0 ? 1 : level[-1].tiles[below].sleeps + 1u;
        tile->sleeps = !never && doze_is_deep(mesh, level, tile) ? (unsigned char)depth : 0;
    }
}
