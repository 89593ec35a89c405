/* fringe.c - see fringe.h. */
#include "mesh/fringe.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/swap.h"
#include "mesh/level.h"
#include "mesh/morton.h"
#include "mesh/span.h"

#include <string.h>

enum { FRINGE_REACH = 4 }; /* places along an axis */

/* Tile coordinates of a level, both ends included. */
struct fringe_box {
    int from[3], to[3];
};

/* The box as far as it is in the domain; false where it goes round a periodic axis. */
static bool fringe_clip(const struct mesh *mesh, const struct level *level, struct fringe_box *box)
{
    bool plain = true;
    for (int d = 0; d < 3; d++) {
        int last = level->extent[d] - 1;
        bool out = box->from[d] < 0 || box->to[d] > last;
        if (out && mesh->periodic[d]) {
            plain = false;
            continue;
        }
        if (box->from[d] < 0) box->from[d] = 0;
        if (box->to[d] > last) box->to[d] = last;
    }
    return plain;
}

/* What the places of a box along an axis give to keys; returns their number. */
static int fringe_digits(const struct level *level, const struct fringe_box *box, int d,
                         uint64_t ret_digits[FRINGE_REACH])
{
    int n = box->to[d] - box->from[d] + 1, extent = level->extent[d];
    for (int i = 0; i < n; i++) ret_digits[i] = morton_spread((uint64_t)((box->from[d] + i + extent) % extent)) << d;
    return n;
}

/* Sends a tile to whoever answers for a place of the box. */
static void fringe_reach(const struct mesh *mesh, int l, int rank, struct fringe_box box,
                         const struct fringe_item *item, struct swap_list *fringe)
{
    const struct level *level = &mesh->levels[l];
    const struct span span = span_of(mesh, l);
    bool plain = fringe_clip(mesh, level, &box);
    if (plain && span_holds(&span, rank, morton_key(box.from)) && span_holds(&span, rank, morton_key(box.to))) return;
    uint64_t digits[3][FRINGE_REACH];
    int last = rank, n[3];
    for (int d = 0; d < 3; d++) n[d] = fringe_digits(level, &box, d, digits[d]);
    for (int k = 0; k < n[2]; k++)
        for (int j = 0; j < n[1]; j++)
            for (int i = 0; i < n[0]; i++) {
                uint64_t key = digits[0][i] | digits[1][j] | digits[2][k];
                if (span_holds(&span, rank, key) || (last != rank && span_holds(&span, last, key))) continue;
                last = span_owner(&span, key);
                swap_add(fringe, item, sizeof *item, last);
            }
}

/* The places within one of a tile on its level; of its children on the next finer one (finer 1), of its parent on the
 * next coarser one (-1). */
static struct fringe_box fringe_box(const struct mesh *mesh, const struct tile *tile, int finer)
{
    struct fringe_box box = {{0}, {0}};
    for (int d = 0; d < mesh->dim; d++) {
        int at = tile->at[d];
        box.from[d] = (finer > 0 ? 2 * at : finer < 0 ? at >> 1 : at) - 1;
        box.to[d] = (finer > 0 ? 2 * at + 1 : finer < 0 ? at >> 1 : at) + 1;
    }
    return box;
}

void fringe_list(const struct mesh *mesh, int l, int rank, struct swap_list *fringe)
{
    const struct level *level = &mesh->levels[l];
    for (unsigned t = level->first; t < level->first + level->n_local; t++) {
        const struct tile *tile = &level->tiles[t];
        const struct fringe_item item = {tile->key, (uint32_t)l, tile->born};
        for (int finer = -1; finer <= 1; finer++)
            if (l + finer >= 0 && l + finer < mesh->n_level)
                fringe_reach(mesh, l + finer, rank, fringe_box(mesh, tile, finer), &item, fringe);
    }
}

/* Tiles were listed level by level along the curve, each for several ranks. */
void fringe_sort(struct swap_list *fringe)
{
    struct fringe_item *items = fringe->items;
    unsigned n = fringe->n, *kept = &fringe->n;
    swap_sort(items, sizeof *items, n, fringe->to);
    *kept = 0;
    for (unsigned i = 0; i < n; i++) {
        const struct fringe_item *last = *kept ? &items[*kept - 1] : NULL;
        bool again = last && fringe->to[*kept - 1] == fringe->to[i] && last->level == items[i].level &&
                     last->key == items[i].key;
        if (again) continue;
        items[*kept] = items[i];
        fringe->to[(*kept)++] = fringe->to[i];
    }
}

static void fringe_take(struct tile **to, const struct fringe_item *item, int rank)
{
    **to = (struct tile){.key = item->key, .rank = rank, .born = item->born};
    morton_at(item->key, (*to)->at);
    ++*to;
}

static void fringe_own(const struct level *level, int rank, struct tile **to)
{
    if (level->n_local) memcpy(*to, level->tiles + level->first, level->n_local * sizeof **to);
    for (unsigned i = 0; i < level->n_local; i++) (*to)++->rank = rank;
}

/* Of lower ranks, own, of higher ranks: what ranks send follows them along the curve. */
struct tile *fringe_merge(const struct level *level, int l, int rank, const struct swap *got, unsigned *ret_n)
{
    const struct fringe_item *items = got->items;
    unsigned n = level->n_local;
    for (unsigned i = 0; i < got->n; i++) n += items[i].level == (uint32_t)l;
    struct tile *tiles = mem_new(n, sizeof *tiles), *to = tiles;
    bool own = false;
    for (unsigned p = 0; p < got->n_piece; items += got->pieces[p++].n) {
        if (!own && got->pieces[p].rank > rank) {
            fringe_own(level, rank, &to);
            own = true;
        }
        for (unsigned i = 0; i < got->pieces[p].n; i++)
            if (items[i].level == (uint32_t)l) fringe_take(&to, &items[i], got->pieces[p].rank);
    }
    if (!own) fringe_own(level, rank, &to);
    *ret_n = n;
    return tiles;
}

void fringe_learn(struct mesh *mesh, int lowest, int highest)
{
    struct swap_list fringe = {0};
    struct swap got;
    if (comm_size() == 1) return; /* nobody else has tiles */
    for (int l = lowest; l <= highest; l++) fringe_list(mesh, l, comm_rank(), &fringe);
    fringe_sort(&fringe);
    swap_items(fringe.items, sizeof(struct fringe_item), fringe.n, fringe.to, &got);
    for (int l = lowest; l <= highest; l++) {
        unsigned n;
        struct tile *tiles = fringe_merge(&mesh->levels[l], l, comm_rank(), &got, &n);
        level_adopt(&mesh->levels[l], tiles, n);
    }
    swap_done(&got);
    swap_list_free(&fringe);
}
