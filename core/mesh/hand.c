/* hand.c - see hand.h. */
#include "mesh/hand.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/swap.h"
#include "mesh/morton.h"

/* A tile on its way. */
struct hand_item {
    uint64_t key;
    uint16_t level, was; /* was: it is on the rank that sends it */
    uint32_t unwanted;
};

/* The pieces that this rank has made, and who gets their tiles. */
struct hand {
    const struct mesh *mesh;
    int lowest, highest;
    const struct nest_set *made;
    int *to[MESH_LEVELS + 1];   /* [made[l].n], ascending */
    bool *was[MESH_LEVELS + 1]; /* [made[l].n] */
};

/* The rank that gets tile `index`: the last whose piece begins there or before. */
static int hand_rank(const uint32_t *first, int size, uint32_t index)
{
    int low = 0, high = size;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (first[middle] <= index) low = middle;
        else high = middle;
    }
    return low;
}

/* Owners of a piece that begins with tile `start` of its level. first: NULL if the level goes, or on one rank. */
static void hand_owners(struct hand *hand, int l, uint32_t start, const uint32_t *first)
{
    unsigned n = hand->made[l].n;
    int size = comm_size(), rank = first ? hand_rank(first, size, start) : 0;
    hand->to[l] = mem_new(n, sizeof *hand->to[l]);
    for (unsigned i = 0; i < n && first; i++) {
        while (rank + 1 < size && first[rank + 1] <= start + i) rank++;
        hand->to[l][i] = rank;
    }
}

/* Which tiles of a piece are there, and where those that are go: returns that of all that are here. */
static int *hand_leave(struct hand *hand, int l)
{
    const struct nest_set *made = &hand->made[l];
    const struct level *level = &hand->mesh->levels[l];
    const struct tile *old = level->tiles ? level->tiles + level->first : NULL;
    unsigned n = l < hand->mesh->n_level ? level->n_local : 0;
    int *to = mem_new(n, sizeof *to);
    hand->was[l] = mem_new(made->n, sizeof *hand->was[l]);
    for (unsigned t = 0, i = 0; t < n; t++) {
        while (i < made->n && made->tiles[i].key < old[t].key) i++;
        bool stays = i < made->n && made->tiles[i].key == old[t].key;
        to[t] = stays ? hand->to[l][i] : -1;
        if (stays) hand->was[l][i] = true;
    }
    return to;
}

/* The tiles of all levels by the ranks that get them. */
static struct hand_item *hand_pack(const struct hand *hand, unsigned n, int *ret_to)
{
    struct hand_item *items = mem_new(n, sizeof *items);
    unsigned count = 0;
    for (int l = hand->lowest; l <= hand->highest; l++)
        for (unsigned i = 0; i < hand->made[l].n; i++) {
            const struct tile *tile = &hand->made[l].tiles[i];
            ret_to[count] = hand->to[l][i];
            items[count++] = (struct hand_item){tile->key, (uint16_t)l, hand->was[l][i], tile->unwanted};
        }
    swap_sort(items, sizeof *items, n, ret_to);
    return items;
}

/* What comes of a level: from lower ranks first, which made what lies before. */
static void hand_unpack(const struct swap *got, int l, struct mesh_set *set)
{
    const struct hand_item *item = got->items;
    for (unsigned i = 0; i < got->n; i++) set->n += item[i].level == l;
    set->tiles = mem_new(set->n, sizeof *set->tiles);
    set->from = mem_new(set->n, sizeof *set->from);
    unsigned count = 0;
    for (unsigned p = 0; p < got->n_piece; p++)
        for (unsigned i = 0; i < got->pieces[p].n; i++, item++) {
            if (item->level != l) continue;
            set->from[count] = item->was ? got->pieces[p].rank : -1;
            set->tiles[count] = (struct tile){.key = item->key, .unwanted = (unsigned char)item->unwanted};
            morton_at(item->key, set->tiles[count++].at);
        }
}

void hand_fill(uint64_t *first_keys, int size)
{
    for (int rank = size - 2; rank >= 0; rank--)
        if (first_keys[rank] == UINT64_MAX) first_keys[rank] = first_keys[rank + 1];
}

/* All ranks tell where their new pieces begin. */
static void hand_firsts(int lowest, int highest, struct mesh_set *sets)
{
    unsigned levels = (unsigned)(highest - lowest + 1), size = (unsigned)comm_size();
    uint64_t own[MESH_LEVELS + 1], *all = mem_new((size_t)size * levels, sizeof *all);
    for (unsigned l = 0; l < levels; l++) {
        const struct mesh_set *set = &sets[lowest + (int)l];
        own[l] = set->n ? set->tiles[0].key : UINT64_MAX;
    }
    comm_join_rows(own, (int)levels, all);
    for (unsigned l = 0; l < levels; l++) {
        uint64_t *first = mem_new(size, sizeof *first);
        for (unsigned rank = 0; rank < size; rank++) first[rank] = all[rank * levels + l];
        hand_fill(first, (int)size);
        sets[lowest + (int)l].first_keys = first;
    }
    mem_free(all);
}

void hand_sets(const struct mesh *mesh, int lowest, int highest, const struct nest_set *made, const long long *n_tile,
               const long long *before, const struct deal *deal, struct mesh_set *ret_sets)
{
    struct hand hand = {.mesh = mesh, .lowest = lowest, .highest = highest, .made = made};
    struct swap got;
    unsigned n = 0;
    for (int l = lowest; l <= highest; l++) {
        const uint32_t *first = comm_size() > 1 && n_tile[l] ? deal_first(deal, l) : NULL;
        hand_owners(&hand, l, (uint32_t)before[l], first);
        ret_sets[l] = (struct mesh_set){.n_tile = (unsigned)n_tile[l], .to = hand_leave(&hand, l)};
        n += made[l].n;
    }
    int *to = mem_new(n, sizeof *to);
    struct hand_item *items = hand_pack(&hand, n, to);
    swap_items(items, sizeof *items, n, to, &got);
    for (int l = lowest; l <= highest; l++) {
        hand_unpack(&got, l, &ret_sets[l]);
        mem_free(hand.to[l]);
        mem_free(hand.was[l]);
    }
    hand_firsts(lowest, highest, ret_sets);
    swap_done(&got);
    mem_free(items);
    mem_free(to);
}
