/* partition.c - see partition.h.
 *
 * A level waits for its most loaded rank, so the cut first makes that load least, exactly: bisection on the load
 * with a greedy probe, where a probe that fails names the next load worth trying (Pinar & Aykanat 2004, J. Parallel
 * Distrib. Comput. 64, 974). Among the cuts that reach it, the one nearest to equal prefixes is taken: greedy
 * pieces would leave the last ranks empty.
 * One rank does it for all (mesh/deal.h): its time follows the runs of equal cost and the ranks, not the tiles. */
#include "mesh/partition.h"

#include "base/mem.h"

#include <assert.h>
#include <math.h>

struct partition_curve {
    const struct partition_runs *runs;
    int size;
    uint32_t *count; /* [n + 1] tiles before run i, */
    uint64_t *sum;   /* and their cost */
};

/* Between two tiles, or at an end of the curve. */
struct partition_place {
    unsigned run; /* that begins here or before */
    uint32_t tile;
    uint64_t sum;
};

uint32_t partition_units(double cost)
{
    double units = floor(100.0 * cost + 0.5);
    return units < 1.0 ? 1 : units > 65535.0 ? 65535 : (uint32_t)units;
}

void partition_add(struct partition_runs *runs, uint32_t n, uint32_t cost)
{
    if (runs->n && runs->list[runs->n - 1].cost == cost) {
        runs->list[runs->n - 1].n += n;
        return;
    }
    if (runs->n == runs->room) {
        unsigned room = 2 * runs->room + 64;
        runs->list = mem_grow(runs->list, runs->room, room, sizeof *runs->list);
        runs->room = room;
    }
    runs->list[runs->n++] = (struct partition_run){n, cost};
}

void partition_free(struct partition_runs *runs)
{
    mem_free(runs->list);
    *runs = (struct partition_runs){0};
}

static struct partition_curve partition_start(const struct partition_runs *runs, int size)
{
    struct partition_curve curve = {runs, size, mem_new(runs->n + 1, sizeof *curve.count),
                                    mem_new(runs->n + 1, sizeof *curve.sum)};
    for (unsigned r = 0; r < runs->n; r++) {
        curve.count[r + 1] = curve.count[r] + runs->list[r].n;
        curve.sum[r + 1] = curve.sum[r] + (uint64_t)runs->list[r].n * runs->list[r].cost;
    }
    return curve;
}

static void partition_stop(struct partition_curve *curve)
{
    mem_free(curve->count);
    mem_free(curve->sum);
}

static uint64_t partition_total(const struct partition_curve *curve)
{
    return curve->sum[curve->runs->n];
}

/* Most quotients are of small numbers, which many processors divide several times as fast. */
static inline uint64_t partition_divide(uint64_t a, uint64_t b)
{
    return (a | b) >> 32 ? a / b : (uint32_t)a / (uint32_t)b;
}

/* The last run from `run` on that begins at a sum of at most `most`: by steps that double, then halve. */
static inline unsigned partition_ahead(const struct partition_curve *curve, unsigned run, uint64_t most)
{
    unsigned step = 1, n = curve->runs->n;
    if (run == n || curve->sum[run + 1] > most) return run;
    while (run + step <= n && curve->sum[run + step] <= most) {
        run += step;
        step *= 2;
    }
    for (; step; step /= 2)
        if (run + step <= n && curve->sum[run + step] <= most) run += step;
    return run;
}

static inline struct partition_place partition_inside(const struct partition_curve *curve, unsigned run, uint64_t tiles)
{
    uint64_t cost = run < curve->runs->n ? curve->runs->list[run].cost : 0;
    return (struct partition_place){run, curve->count[run] + (uint32_t)tiles, curve->sum[run] + tiles * cost};
}

/* The largest end of a piece from `from` on that costs at most `most`. */
static inline struct partition_place partition_reach(const struct partition_curve *curve, struct partition_place from,
                                                     uint64_t most)
{
    unsigned run = partition_ahead(curve, from.run, from.sum + most);
    uint64_t rest = from.sum + most - curve->sum[run];
    return partition_inside(curve, run, run < curve->runs->n ? partition_divide(rest, curve->runs->list[run].cost) : 0);
}

/* The least begin of a piece up to `to` that costs at most `most`. */
static struct partition_place partition_reach_back(const struct partition_curve *curve, struct partition_place to,
                                                   uint64_t most)
{
    unsigned run = to.run;
    if (to.sum <= most) return (struct partition_place){0};
    for (unsigned step = 1; curve->sum[run] > to.sum - most; step *= 2) run = run > step ? run - step : 0;
    run = partition_ahead(curve, run, to.sum - most);
    uint64_t rest = to.sum - most - curve->sum[run], cost = curve->runs->list[run].cost;
    return partition_inside(curve, run, partition_divide(rest + cost - 1, cost));
}

/* The place before a tile. */
static struct partition_place partition_before(const struct partition_curve *curve, uint32_t tile)
{
    unsigned low = 0, high = curve->runs->n;
    while (high - low > 1) {
        unsigned middle = low + (high - low) / 2;
        if (curve->count[middle] <= tile) low = middle;
        else high = middle;
    }
    return partition_inside(curve, low, tile - curve->count[low]);
}

/* How many pieces follow one from `from` to `to` that are like it, all in the same run and not at its end. */
static int partition_alike(const struct partition_curve *curve, struct partition_place from, struct partition_place to)
{
    uint32_t tiles = to.tile - from.tile;
    if (to.run != from.run || curve->count[to.run + 1] - to.tile <= tiles) return 0;
    return (int)((curve->count[to.run + 1] - to.tile - 1) / tiles);
}

/* What the most loaded of `ranks` ranks has at least. */
static uint64_t partition_share(uint64_t sum, uint64_t ranks)
{
    return ranks ? (sum + ranks - 1) / ranks : UINT64_MAX;
}

/* Do pieces of at most `most` suffice? Then *ret_load is the largest of them; else a load above `most` that the largest
 * cannot be less than: with less the pieces so far would be the same, and the ranks that are left could not take the
 * rest. */
static bool partition_probe(const struct partition_curve *curve, uint64_t most, uint64_t *ret_load)
{
    uint64_t largest = 0, total = partition_total(curve), next = total;
    struct partition_place from = {0};
    for (int ranks = curve->size; from.sum < total;) {
        if (total - from.sum > most * (uint64_t)ranks) {
            uint64_t share = partition_share(total - from.sum, (uint64_t)ranks);
            *ret_load = share < next ? share : next;
            return false;
        }
        struct partition_place to = partition_reach(curve, from, most);
        uint64_t load = to.sum - from.sum;
        if (load > largest) largest = load;
        if (to.sum < total && load + curve->runs->list[to.run].cost < next)
            next = load + curve->runs->list[to.run].cost;
        int alike = partition_alike(curve, from, to);
        if (alike >= ranks) alike = ranks - 1;
        from = (struct partition_place){to.run, to.tile + (uint32_t)alike * (to.tile - from.tile),
                                        to.sum + (uint64_t)alike * load};
        ranks -= 1 + alike;
    }
    *ret_load = largest;
    return true;
}

/* The least load of the most loaded rank. */
static uint64_t partition_bottleneck(const struct partition_curve *curve)
{
    uint64_t most = 0, load, size = (uint64_t)curve->size, total = partition_total(curve);
    uint64_t mean = partition_share(total, size);
    for (unsigned r = 0; r < curve->runs->n; r++)
        if (curve->runs->list[r].cost > most) most = curve->runs->list[r].cost;
    uint64_t low = mean > most ? mean : most, high = partition_probe(curve, mean + most, &load) ? load : total;
    for (uint64_t middle = low; low < high; middle = low + (high - low) / 2) {
        if (partition_probe(curve, middle, &load)) high = load;
        else low = load;
    }
    return high;
}

/* earliest[r]: the least first tile of rank r with which it and the ranks above can take the rest, none more than
 * `most`. */
static uint32_t *partition_earliest(const struct partition_curve *curve, uint64_t most)
{
    uint32_t *earliest = mem_new((size_t)curve->size + 1, sizeof *earliest);
    struct partition_place to = partition_inside(curve, curve->runs->n, 0);
    earliest[curve->size] = to.tile;
    for (int rank = curve->size - 1; rank > 0; rank--) {
        to = partition_reach_back(curve, to, most);
        earliest[rank] = to.tile;
    }
    return earliest;
}

/* Where the first ranks have an equal share of the cost: `sum` and `rest` of a division by their number. A step from
 * rank to rank adds `share` and `more`: it needs no division. */
struct partition_goal {
    uint64_t sum, rest, share, more;
};

static struct partition_goal partition_goal(const struct partition_curve *curve)
{
    uint64_t size = (uint64_t)curve->size, total = partition_total(curve);
    return (struct partition_goal){.share = total / size, .more = total % size};
}

static void partition_goal_step(const struct partition_curve *curve, struct partition_goal *goal)
{
    uint64_t size = (uint64_t)curve->size;
    goal->sum += goal->share;
    goal->rest += goal->more;
    if (goal->rest < size) return;
    goal->rest -= size;
    goal->sum++;
}

/* The end of a piece from `from` on nearest to a goal. */
static inline struct partition_place partition_nearest(const struct partition_curve *curve, struct partition_place from,
                                                       const struct partition_goal *goal)
{
    if (goal->sum <= from.sum) return from;
    struct partition_place to = partition_reach(curve, from, goal->sum - from.sum);
    if (to.run == curve->runs->n) return to;
    uint64_t cost = curve->runs->list[to.run].cost, size = (uint64_t)curve->size;
    if ((2 * to.sum + cost) * size < 2 * (goal->sum * size + goal->rest)) to = partition_reach(curve, to, cost);
    return to;
}

/* Cuts as near to equal prefixes as `most` allows; every rank gets a tile. */
static void partition_place_all(const struct partition_curve *curve, uint64_t most, uint64_t weight, uint64_t *load,
                                uint32_t *ret_first)
{
    uint32_t *earliest = partition_earliest(curve, most), last = curve->count[curve->runs->n] - (uint32_t)curve->size;
    struct partition_goal goal = partition_goal(curve);
    struct partition_place from = {0};
    for (int rank = 0; rank < curve->size; rank++) {
        partition_goal_step(curve, &goal);
        struct partition_place to = partition_nearest(curve, from, &goal);
        uint32_t least = from.tile + 1 > earliest[rank + 1] ? from.tile + 1 : earliest[rank + 1];
        last++;
        if (to.tile >= least && to.sum - from.sum > most) to = partition_reach(curve, from, most);
        if (to.tile < least) to = partition_before(curve, least);
        else if (to.tile > last) to = partition_before(curve, last);
        load[rank] += weight * (to.sum - from.sum);
        ret_first[rank + 1] = to.tile;
        from = to;
    }
    mem_free(earliest);
}

struct partition_rank {
    uint64_t load;
    int rank;
};

static bool partition_is_less(struct partition_rank a, struct partition_rank b)
{
    return a.load != b.load ? a.load < b.load : a.rank < b.rank;
}

/* Brings the n least of `size` ranks to the front (Hoare 1961, Commun. ACM 4, 321): sorting all of them would take most
 * of the time of a cut on many ranks. */
static void partition_select(struct partition_rank *ranks, int size, int n)
{
    for (int low = 0, high = size - 1; low < high;) {
        struct partition_rank pivot = ranks[low + (high - low) / 2];
        int i = low, j = high;
        while (i <= j) {
            while (partition_is_less(ranks[i], pivot)) i++;
            while (partition_is_less(pivot, ranks[j])) j--;
            if (i > j) break;
            struct partition_rank other = ranks[i];
            ranks[i++] = ranks[j];
            ranks[j--] = other;
        }
        if (n - 1 >= i) low = i;
        else if (n - 1 <= j) high = j;
        else break;
    }
}

/* Marks the n ranks with least load among those from `from` to `to` - 1, the lower ones where loads are equal. */
static void partition_choose(const uint64_t *load, int from, int to, uint64_t n, struct partition_rank *room,
                             bool *ret_chosen)
{
    for (int rank = from; rank < to; rank++) room[rank - from] = (struct partition_rank){load[rank], rank};
    partition_select(room, to - from, (int)n);
    for (uint64_t i = 0; i < n; i++) ret_chosen[room[i].rank] = true;
}

/* Which ranks get one of n tiles, fewer than ranks: the ranks in equal stretches, as many tiles for each. The least
 * loaded of all ranks would often be neighbours, and the link of their node would carry all of a level. */
static bool *partition_spread(const uint64_t *load, int n_rank, uint64_t n)
{
    uint64_t size = (uint64_t)n_rank, even = (size + PARTITION_STRETCH - 1) / PARTITION_STRETCH;
    uint64_t stretches = n < even ? n : even;
    struct partition_rank *room = mem_new((size_t)size, sizeof *room);
    bool *chosen = mem_new((size_t)size, sizeof *chosen);
    for (uint64_t s = 0; s < stretches; s++) {
        int from = (int)(s * size / stretches), to = (int)((s + 1) * size / stretches);
        partition_choose(load, from, to, (s + 1) * n / stretches - s * n / stretches, room, chosen);
    }
    mem_free(room);
    return chosen;
}

static void partition_few(const struct partition_curve *curve, uint64_t weight, uint64_t *load, uint32_t *ret_first)
{
    bool *chosen = partition_spread(load, curve->size, curve->count[curve->runs->n]);
    uint32_t next = 0;
    for (int rank = 0; rank < curve->size; rank++) {
        if (chosen[rank]) {
            struct partition_place from = partition_before(curve, next++);
            load[rank] += weight * curve->runs->list[from.run].cost;
        }
        ret_first[rank + 1] = next;
    }
    mem_free(chosen);
}

void partition_cut(const struct partition_runs *runs, int size, uint64_t weight, uint64_t *load, uint32_t *ret_first)
{
    assert(size > 0);
    struct partition_curve curve = partition_start(runs, size);
    ret_first[0] = 0;
    if (curve.count[runs->n] < (uint32_t)size) partition_few(&curve, weight, load, ret_first);
    else partition_place_all(&curve, partition_bottleneck(&curve), weight, load, ret_first);
    partition_stop(&curve);
}

void partition_equal(uint32_t n, int size, uint32_t *ret_first)
{
    uint64_t *load = mem_new((size_t)size, sizeof *load);
    struct partition_runs runs = {0};
    if (n) partition_add(&runs, n, 1);
    partition_cut(&runs, size, 1, load, ret_first);
    partition_free(&runs);
    mem_free(load);
}

double partition_imbalance(const uint64_t *load, uint32_t n, int size)
{
    uint64_t largest = 0, total = 0;
    for (int rank = 0; rank < size; rank++) {
        if (load[rank] > largest) largest = load[rank];
        total += load[rank];
    }
    double ranks = n < (uint32_t)size ? (double)n : (double)size;
    return total ? (double)largest * ranks / (double)total - 1.0 : 0.0;
}
