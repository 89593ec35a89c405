/* partition.c - see partition.h.
 *
 * A level waits for its most loaded rank, so the cut first makes that load least, exactly: bisection on the load
 * with a greedy probe, where a probe that fails names the next load worth trying (Pinar & Aykanat 2004, J. Parallel
 * Distrib. Comput. 64, 974). Among the cuts that reach it, the one nearest to equal prefixes is taken: greedy
 * pieces would leave the last ranks empty.
 * The load of a piece is always the difference of two prefix sums, so that all comparisons agree. */
#include "mesh/partition.h"

#include "base/mem.h"

#include <assert.h>

struct partition_curve {
    unsigned n;
    int size;
    double *sum; /* [n + 1] cost of the tiles before i */
};

static double partition_piece(const struct partition_curve *curve, unsigned from, unsigned to)
{
    return curve->sum[to] - curve->sum[from];
}

/* The largest end of a piece from `from` on that costs at most `most`: by steps that double, then halve. */
static unsigned partition_reach(const struct partition_curve *curve, unsigned from, double most)
{
    unsigned to = from, step = 1;
    while (to + step <= curve->n && partition_piece(curve, from, to + step) <= most) {
        to += step;
        step *= 2;
    }
    for (; step; step /= 2)
        if (to + step <= curve->n && partition_piece(curve, from, to + step) <= most) to += step;
    return to;
}

/* The least begin of a piece up to `to` that costs at most `most`. */
static unsigned partition_reach_back(const struct partition_curve *curve, unsigned to, double most)
{
    unsigned from = to, step = 1;
    while (from >= step && partition_piece(curve, from - step, to) <= most) {
        from -= step;
        step *= 2;
    }
    for (; step; step /= 2)
        if (from >= step && partition_piece(curve, from - step, to) <= most) from -= step;
    return from;
}

/* Do pieces of at most `most` suffice? Then *ret_load is the largest of them; else the least load, above `most`, with
 * which any piece would be longer. */
static bool partition_probe(const struct partition_curve *curve, double most, double *ret_load)
{
    double largest = 0.0, next = curve->sum[curve->n];
    unsigned from = 0;
    for (int rank = 0; rank < curve->size && from < curve->n; rank++) {
        unsigned to = partition_reach(curve, from, most);
        double load = partition_piece(curve, from, to);
        if (load > largest) largest = load;
        if (to < curve->n && partition_piece(curve, from, to + 1) < next) next = partition_piece(curve, from, to + 1);
        from = to;
    }
    *ret_load = from == curve->n ? largest : next;
    return from == curve->n;
}

/* The least load of the most loaded rank. */
static double partition_bottleneck(const struct partition_curve *curve)
{
    double most = 0.0, load, total = curve->sum[curve->n], mean = total / curve->size;
    for (unsigned i = 0; i < curve->n; i++) {
        double cost = partition_piece(curve, i, i + 1);
        if (cost > most) most = cost;
    }
    double low = mean > most ? mean : most;
    double high = partition_probe(curve, mean + most, &load) ? load : total;
    for (double middle = low; low < high;) {
        if (partition_probe(curve, middle, &load)) high = load;
        else low = load;
        middle = low + 0.5 * (high - low);
        if (middle >= high) middle = low; /* neighbours among doubles: the mean may round up */
    }
    return high;
}

/* earliest[r]: the least first tile of rank r with which it and the ranks above can take the rest, none more than
 * `most`. */
static unsigned *partition_earliest(const struct partition_curve *curve, double most)
{
    unsigned *earliest = mem_new((size_t)curve->size + 1, sizeof *earliest), to = curve->n;
    earliest[curve->size] = to;
    for (int rank = curve->size - 1; rank > 0; rank--) earliest[rank] = to = partition_reach_back(curve, to, most);
    return earliest;
}

/* Cuts as near to equal prefixes as `most` allows; every rank gets a tile. */
static void partition_place(const struct partition_curve *curve, double most, struct tile *tiles)
{
    unsigned *earliest = partition_earliest(curve, most), from = 0, size = (unsigned)curve->size;
    double share = curve->sum[curve->n] / curve->size;
    for (unsigned rank = 0; rank < size; rank++) {
        double target = share * (rank + 1) - curve->sum[from];
        unsigned to = partition_reach(curve, from, target);
        if (to < curve->n && partition_piece(curve, from, to + 1) - target < target - partition_piece(curve, from, to))
            to++;
        unsigned least = from + 1 > earliest[rank + 1] ? from + 1 : earliest[rank + 1];
        unsigned limit = partition_reach(curve, from, most), rest = curve->n - (size - rank - 1);
        if (limit > rest) limit = rest;
        to = to < least ? least : to > limit ? limit : to;
        for (; from < to; from++) tiles[from].rank = (int)rank;
    }
    mem_free(earliest);
}

static void partition_contiguous(struct tile *tiles, unsigned n, const double *cost, int size)
{
    struct partition_curve curve = {.n = n, .size = size, .sum = mem_new((size_t)n + 1, sizeof *curve.sum)};
    for (unsigned i = 0; i < n; i++) curve.sum[i + 1] = curve.sum[i] + cost[i];
    partition_place(&curve, partition_bottleneck(&curve), tiles);
    mem_free(curve.sum);
}

struct partition_rank {
    double load;
    int rank;
};

static bool partition_is_less(struct partition_rank a, struct partition_rank b)
{
    return a.load != b.load ? a.load < b.load : a.rank < b.rank;
}

/* Brings the n least of `size` ranks to the front (Hoare 1961, Commun. ACM 4, 321): sorting all of them would take most of
 * the time of a cut on many ranks. */
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

/* One tile each to the n ranks with least load, the lower ranks where loads are equal. */
static void partition_few(struct tile *tiles, unsigned n, int size, const double *load)
{
    struct partition_rank *ranks = mem_new((size_t)size, sizeof *ranks);
    bool *chosen = mem_new((size_t)size, sizeof *chosen);
    for (int rank = 0; rank < size; rank++) ranks[rank] = (struct partition_rank){load[rank], rank};
    partition_select(ranks, size, (int)n);
    for (unsigned i = 0; i < n; i++) chosen[ranks[i].rank] = true;
    for (int rank = 0; rank < size; rank++)
        if (chosen[rank]) (tiles++)->rank = rank;
    mem_free(chosen);
    mem_free(ranks);
}

void partition_cut(struct tile *tiles, unsigned n, const double *cost, int size, double weight, double *load)
{
    assert(size > 0);
    if (!n) return;
    if (n < (unsigned)size) partition_few(tiles, n, size, load);
    else partition_contiguous(tiles, n, cost, size);
    for (unsigned i = 0; i < n;) {
        int rank = tiles[i].rank;
        double sum = load[rank];
        for (; i < n && tiles[i].rank == rank; i++) sum += weight * cost[i];
        load[rank] = sum;
    }
}

double partition_imbalance(const struct tile *tiles, unsigned n, const double *cost, int size)
{
    double largest = 0.0, total = 0.0, load = 0.0;
    for (unsigned i = 0; i < n; i++) {
        load = i && tiles[i - 1].rank == tiles[i].rank ? load + cost[i] : cost[i];
        if (load > largest) largest = load;
        total += cost[i];
    }
    double ranks = n < (unsigned)size ? (double)n : (double)size;
    return total > 0.0 ? largest * ranks / total - 1.0 : 0.0;
}
