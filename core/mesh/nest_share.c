/* nest_share.c - see nest_share.h. What is sent is sorted along the curve, so its owners ascend. */
#include "mesh/nest_share.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/swap.h"
#include "mesh/level.h"
#include "mesh/morton.h"

/* Owners of sorted keys. */
static int *nest_share_owners(const struct span *span, const struct nest_keys *keys)
{
    int *to = mem_new(keys->n, sizeof *to), owner = 0;
    for (unsigned i = 0; i < keys->n; i++) {
        if (!span_holds(span, owner, keys->keys[i])) owner = span_owner(span, keys->keys[i]);
        to[i] = owner;
    }
    return to;
}

/* A key of some level on its way. */
struct nest_share_item {
    uint64_t key, level;
};

bool nest_share_keys(const struct mesh *mesh, int lowest, int count, struct nest_keys *keys)
{
    unsigned n = 0, next = 0;
    struct swap got;
    if (span_of(mesh, lowest).size == 1) return false;
    for (int k = 0; k < count; k++) n += keys[k].n;
    struct nest_share_item *items = mem_new(n, sizeof *items);
    int *to = mem_new(n, sizeof *to);
    for (int k = 0; k < count; k++) {
        struct span span = span_of(mesh, lowest + k);
        int *owners = nest_share_owners(&span, &keys[k]);
        for (unsigned i = 0; i < keys[k].n; i++, next++) {
            items[next] = (struct nest_share_item){.key = keys[k].keys[i], .level = (uint64_t)k};
            to[next] = owners[i];
        }
        mem_free(owners);
        keys[k].n = 0;
    }
    swap_sort(items, sizeof *items, n, to);
    swap_items(items, sizeof *items, n, to, &got);
    const struct nest_share_item *item = got.items;
    for (unsigned i = 0; i < got.n; i++) nest_keys_push(&keys[item[i].level], item[i].key);
    swap_done(&got);
    mem_free(items);
    mem_free(to);
    return true;
}

/* The next owner of a tile that is needed of a family, after `owner` (-1: the first); -1: there is none. Between two of
 * them may lie any number of ranks without tiles. */
static int nest_share_next(const struct span *span, const struct nest_family *family, int owner)
{
    for (uint32_t mask = family->mask; mask; mask &= mask - 1) {
        uint64_t key = family->key << 3 | (unsigned)__builtin_ctz(mask);
        if (owner >= 0 && (span_holds(span, owner, key) || key >> span->shift < span->first[owner])) continue;
        return span_owner(span, key);
    }
    return -1;
}

struct nest_families nest_share_deal(const struct span *span, const struct nest_families *needs, int **ret_to)
{
    struct nest_families dealt = {.room = needs->n + 64};
    int near = 0, *to = mem_new(dealt.room, sizeof *to);
    dealt.list = mem_new(dealt.room, sizeof *dealt.list);
    for (unsigned i = 0; i < needs->n; i++) {
        uint64_t first = needs->list[i].key << 3;
        bool whole = span_holds(span, near, first) && span_holds(span, near, first | 7u);
        for (int owner = whole ? near : nest_share_next(span, &needs->list[i], -1); owner >= 0;
             owner = whole ? -1 : nest_share_next(span, &needs->list[i], owner)) {
            if (dealt.n == dealt.room) {
                to = mem_grow(to, dealt.room, 2 * dealt.room, sizeof *to);
                dealt.list = mem_grow(dealt.list, dealt.room, 2 * dealt.room, sizeof *dealt.list);
                dealt.room *= 2;
            }
            to[dealt.n] = near = owner;
            dealt.list[dealt.n++] = needs->list[i];
        }
    }
    *ret_to = to;
    return dealt;
}

void nest_share_take(const struct span *span, int rank, const struct nest_family *list, unsigned n,
                     struct nest_families *families)
{
    for (unsigned i = 0; i < n; i++) {
        uint64_t first = list[i].key << 3;
        uint32_t mask = list[i].mask;
        if (!span_holds(span, rank, first) || !span_holds(span, rank, first | 7u))
            for (unsigned o = 0; o < MESH_OCTANTS; o++)
                if (!span_holds(span, rank, first | o)) mask &= ~(1u << o);
        if (mask) nest_family_add(families, list[i].key, mask);
    }
}

void nest_share_needs(const struct mesh *mesh, int l, const struct nest_set *set, struct nest_families *families)
{
    struct span span = span_of(mesh, l - 1);
    struct nest_families needs = {0};
    struct swap got;
    int *to;
    if (span.size == 1) {
        nest_family_needs(mesh, l, set->tiles, set->n, families);
        return;
    }
    nest_family_needs(mesh, l, set->tiles, set->n, &needs);
    nest_family_sort(&needs);
    struct nest_families dealt = nest_share_deal(&span, &needs, &to);
    swap_items(dealt.list, sizeof *dealt.list, dealt.n, to, &got);
    nest_share_take(&span, comm_rank(), got.items, got.n, families);
    swap_done(&got);
    mem_free(to);
    nest_family_free(&dealt);
    nest_family_free(&needs);
}

static uint32_t nest_share_look(const struct mesh *mesh, const struct level *level, uint64_t key)
{
    uint32_t there = 0;
    int at[3];
    if (level_find(level, key) < 0) return 0;
    morton_at(key, at);
    for (int a = 0; a < NEST_FAMILY_AROUND; a++) {
        int place[3] = {at[0] + a % 3 - 1, at[1] + a / 3 % 3 - 1, at[2] + a / 9 - 1};
        uint64_t around;
        bool inside = nest_family_place(mesh, level, place, &around);
        if (!inside || level_find(level, around) >= 0) there |= 1u << a;
    }
    return there;
}

uint32_t *nest_share_around(const struct mesh *mesh, int l, const struct nest_keys *places)
{
    struct span span = span_of(mesh, l);
    struct swap asked;
    int *to = nest_share_owners(&span, places);
    swap_items(places->keys, sizeof *places->keys, places->n, to, &asked);
    const uint64_t *keys = asked.items;
    uint32_t *there = mem_new(asked.n, sizeof *there);
    for (unsigned i = 0; i < asked.n; i++) there[i] = nest_share_look(mesh, &mesh->levels[l], keys[i]);
    uint32_t *answers = swap_answer(&asked, there, sizeof *there);
    mem_free(there);
    swap_done(&asked);
    mem_free(to);
    return answers;
}
