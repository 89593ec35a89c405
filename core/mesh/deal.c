/* deal.c - see deal.h. */
#include "mesh/deal.h"

#include "base/comm.h"
#include "base/gather.h"
#include "base/mem.h"

#include <string.h>

static void deal_run(struct deal *deal, int l, uint32_t cost)
{
    struct deal_run *last = deal->n ? &deal->runs[deal->n - 1] : NULL;
    if (last && last->level == l && last->cost == cost) {
        last->n++;
        return;
    }
    if (deal->n == deal->room) {
        unsigned room = 2 * deal->room + 64;
        deal->runs = mem_grow(deal->runs, deal->room, room, sizeof *deal->runs);
        deal->room = room;
    }
    deal->runs[deal->n++] = (struct deal_run){1, (uint16_t)l, (uint16_t)cost};
}

static uint64_t deal_weight(const struct deal *deal, int l)
{
    return deal->subcycle ? (uint64_t)1 << l : 1;
}

void deal_add(struct deal *deal, int l, const double *cost, unsigned n)
{
    deal->n_level = l + 1;
    for (unsigned i = 0; i < n; i++) {
        uint32_t units = partition_units(cost[i]);
        if (l <= deal->base) deal->load += deal_weight(deal, l) * units;
        if (l > deal->base || deal->base == 0) deal_run(deal, l, units);
    }
}

static size_t deal_room(const struct deal *deal, int size)
{
    return (size_t)deal->n_level * ((size_t)size + 1) + 1; /* the last one says whether level 0 is cut, too */
}

static uint32_t *deal_table(const struct deal *deal, int l, int size)
{
    return deal->first + (size_t)l * ((size_t)size + 1);
}

/* Level 0 gets other owners if those it has leave some ranks idle, which others would not: `load` becomes theirs. */
static void deal_recut(struct deal *deal, const struct partition_runs *runs, int size, uint64_t *load)
{
    uint64_t *other = mem_new((size_t)size, sizeof *other);
    uint32_t *first = deal_table(deal, 0, size);
    partition_cut(runs, size, 1, other, first);
    double now = partition_imbalance(load, first[size], size), then = partition_imbalance(other, first[size], size);
    deal->root = now > PARTITION_SLACK && then < now - 0.5 * PARTITION_SLACK;
    if (deal->root) memcpy(load, other, (size_t)size * sizeof *load);
    mem_free(other);
}

void deal_share(struct deal *deal, const struct deal_run *runs, unsigned n, int size, uint64_t *load)
{
    struct partition_runs levels[MESH_LEVELS + 1] = {0};
    deal->first = mem_new(deal_room(deal, size), sizeof *deal->first);
    for (unsigned i = 0; i < n; i++) partition_add(&levels[runs[i].level], runs[i].n, runs[i].cost);
    if (deal->base == 0) deal_recut(deal, &levels[0], size, load);
    for (int l = deal->base + 1; l < deal->n_level; l++)
        partition_cut(&levels[l], size, deal_weight(deal, l), load, deal_table(deal, l, size));
    for (int l = 0; l < deal->n_level; l++) partition_free(&levels[l]);
}

/* Before its runs a rank tells their number and what it has to do already. */
struct deal_head {
    uint64_t load, n;
};

enum { DEAL_HEAD = sizeof(struct deal_head) / sizeof(struct deal_run) };

/* Heads and runs of all ranks, on rank 0. */
static struct deal_run *deal_gather(const struct deal *deal, unsigned *ret_n)
{
    struct deal_head head = {deal->load, deal->n};
    struct deal_run *own = mem_new(deal->n + DEAL_HEAD, sizeof *own);
    memcpy(own, &head, sizeof head);
    if (deal->n) memcpy(own + DEAL_HEAD, deal->runs, deal->n * sizeof *own);
    struct deal_run *all = gather_items(own, sizeof *own, deal->n + DEAL_HEAD, ret_n);
    mem_free(own);
    return all;
}

/* Leaves the runs, their new number, and takes the loads out. */
static unsigned deal_behead(struct deal_run *all, unsigned n, uint64_t *ret_load)
{
    unsigned count = 0;
    for (unsigned i = 0; i < n;) {
        struct deal_head head;
        memcpy(&head, all + i, sizeof head);
        *ret_load++ = head.load;
        memmove(all + count, all + i + DEAL_HEAD, head.n * sizeof *all);
        i += (unsigned)head.n + DEAL_HEAD;
        count += (unsigned)head.n;
    }
    return count;
}

static void deal_decide(struct deal *deal, struct deal_run *all, unsigned n, int size)
{
    uint64_t *load = mem_new((size_t)size, sizeof *load);
    n = deal_behead(all, n, load);
    deal_share(deal, all, n, size, load);
    mem_free(load);
}

void deal_cut(struct deal *deal)
{
    int size = comm_size();
    size_t room = deal_room(deal, size);
    unsigned n;
    struct deal_run *all = deal_gather(deal, &n);
    if (comm_rank() == 0) deal_decide(deal, all, n, size);
    else deal->first = mem_new(room, sizeof *deal->first);
    deal->first[room - 1] = deal->root;
    comm_bcast(deal->first, room * sizeof *deal->first);
    deal->root = deal->first[room - 1];
    mem_free(all);
}

const uint32_t *deal_first(const struct deal *deal, int l)
{
    return deal_table(deal, l, comm_size());
}

void deal_free(struct deal *deal)
{
    mem_free(deal->runs);
    mem_free(deal->first);
    deal->runs = NULL;
    deal->first = NULL;
}
