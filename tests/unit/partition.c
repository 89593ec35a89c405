/* Cuts of the curve: the largest load against the best of all cuts, few tiles on many ranks, imbalance. */
#include "mesh/partition.h"

#include "base/mem.h"
#include "replicated.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 24 };

static uint64_t seed = 5;

static unsigned pick(unsigned count)
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (unsigned)(seed >> 33) % count;
}

/* Largest load of the best cut of cost[from ..] into pieces for `size` ranks, by trying all. */
static double best(const double *cost, unsigned n, unsigned from, int size)
{
    double least = INFINITY, load = 0.0;
    if (size == 1) {
        for (unsigned i = from; i < n; i++) load += cost[i];
        return load;
    }
    for (unsigned to = from; to <= n && load < least; to++) {
        double rest = best(cost, n, to, size - 1);
        double largest = load > rest ? load : rest;
        if (largest < least) least = largest;
        if (to < n) load += cost[to];
    }
    return least;
}

/* Owners and loads by a cut of tiles one by one; costs in hundredths. */
static void cut(struct tile *tiles, unsigned n, const double *cost, int size, uint64_t weight, uint64_t *load)
{
    struct partition_runs runs = {0};
    uint32_t *first = mem_new((size_t)size + 1, sizeof *first);
    for (unsigned i = 0; i < n; i++) partition_add(&runs, 1, partition_units(cost[i]));
    partition_cut(&runs, size, weight, load, first);
    assert_int_equal(first[0], 0);
    assert_int_equal(first[size], n);
    replicated_give(tiles, size, first);
    partition_free(&runs);
    mem_free(first);
}

static double largest_of(const struct tile *tiles, unsigned n, const double *cost, int size)
{
    double load[MOST] = {0}, largest = 0.0;
    for (unsigned i = 0; i < n; i++) load[tiles[i].rank] += cost[i];
    for (int rank = 0; rank < size; rank++) largest = load[rank] > largest ? load[rank] : largest;
    return largest;
}

static void check_cut(const double *cost, unsigned n, int size)
{
    struct tile tiles[MOST] = {0};
    uint64_t load[MOST] = {0}, own[MOST] = {0};
    for (int rank = 0; rank < size; rank++) load[rank] = 3;
    cut(tiles, n, cost, size, 4, load);
    int count[MOST] = {0};
    for (unsigned i = 0; i < n; i++) {
        assert_in_range(tiles[i].rank, 0, size - 1);
        assert_true(i == 0 || tiles[i].rank >= tiles[i - 1].rank);
        count[tiles[i].rank]++;
        own[tiles[i].rank] += partition_units(cost[i]);
    }
    for (int rank = 0; rank < size; rank++) {
        assert_true(count[rank] >= (n >= (unsigned)size));
        assert_true(count[rank] <= 1 || n >= (unsigned)size);
        assert_true(load[rank] == 3 + 4 * own[rank]);
    }
    double total = 0.0, largest = largest_of(tiles, n, cost, size);
    for (unsigned i = 0; i < n; i++) total += cost[i];
    assert_true(largest == best(cost, n, 0, size));
    double mean = total / (n < (unsigned)size ? (int)n : size);
    assert_true(fabs(partition_imbalance(own, n, size) - (largest / mean - 1.0)) < 1e-14);
}

static void test_best(void **state)
{
    (void)state;
    for (int round = 0; round < 4000; round++) {
        double cost[MOST];
        unsigned n = 1 + pick(12), kind = pick(4);
        int size = 1 + (int)pick(6);
        for (unsigned i = 0; i < n; i++) /* equal; any; light and heavy; cheap ones among them: sums are exact */
            cost[i] = kind == 0   ? 1.0
                      : kind == 1 ? 1 + pick(9)
                      : kind == 2 ? (pick(6) ? 1.0 : 32.0)
                                  : 0.25 * (1 + pick(3));
        check_cut(cost, n, size);
    }
}

/* Equal tiles: pieces differ by one tile at most, and no rank is left without. */
static void test_even(void **state)
{
    (void)state;
    enum { TILES = 1013, RANKS = 100 };
    static struct tile tiles[TILES];
    static double cost[TILES];
    static uint64_t load[RANKS];
    for (unsigned i = 0; i < TILES; i++) cost[i] = 1.0;
    cut(tiles, TILES, cost, RANKS, 1, load);
    for (int rank = 0; rank < RANKS; rank++) assert_true(load[rank] == 1000 || load[rank] == 1100);
}

/* Hundredths, of any size: the largest load is that of the best cut; more than 16 bits are cut off, nothing is free. */
static void test_units(void **state)
{
    (void)state;
    assert_int_equal(partition_units(2.4), 240);
    assert_int_equal(partition_units(0.05), 5);
    assert_int_equal(partition_units(0.0), 1);
    assert_int_equal(partition_units(1e9), 65535);
    for (int round = 0; round < 200; round++) {
        struct tile tiles[MOST] = {0};
        double cost[MOST];
        uint64_t load[MOST] = {0};
        unsigned n = 6 + pick(6);
        for (unsigned i = 0; i < n; i++) cost[i] = 0.01 * (1 + pick(500));
        int size = 1 + (int)pick(6);
        cut(tiles, n, cost, size, 1, load);
        assert_true(fabs(largest_of(tiles, n, cost, size) - best(cost, n, 0, size)) < 1e-13);
        assert_int_equal(tiles[n - 1].rank, size - 1);
    }
}

/* Each piece ends where the ranks so far have an equal share, to the nearest tile, the lower one of two. */
static void test_nearest(void **state)
{
    (void)state;
    enum { TILES = 1013, RANKS = 100 };
    struct partition_runs runs = {0};
    uint32_t first[RANKS + 1];
    uint64_t load[RANKS] = {0};
    partition_add(&runs, TILES, 1);
    partition_cut(&runs, RANKS, 1, load, first);
    for (uint32_t rank = 0; rank <= RANKS; rank++)
        assert_int_equal(first[rank], (2 * TILES * rank + RANKS - 1) / (2 * RANKS));
    partition_free(&runs);
}

/* Runs are the tiles they stand for, one by one. */
static void test_runs(void **state)
{
    (void)state;
    enum { TILES = 400, RANKS = 37 };
    for (int round = 0; round < 50; round++) {
        struct partition_runs runs = {0}, single = {0};
        uint32_t first[RANKS + 1], other[RANKS + 1];
        uint64_t load[RANKS] = {0}, same[RANKS] = {0};
        for (unsigned left = TILES, n; left; left -= n) {
            uint32_t c = 1 + pick(300);
            n = 1 + pick(left < 90 ? left : 90);
            partition_add(&runs, n, c);
            for (unsigned i = 0; i < n; i++) {
                single.list = mem_grow(single.list, single.n, single.n + 1, sizeof *single.list);
                single.list[single.n++] = (struct partition_run){1, c};
            }
        }
        partition_cut(&runs, RANKS, 1, load, first);
        partition_cut(&single, RANKS, 1, same, other);
        assert_memory_equal(first, other, sizeof first);
        assert_memory_equal(load, same, sizeof load);
        partition_free(&runs);
        partition_free(&single);
    }
}

/* Levels of few tiles go to the idle ranks, in ascending order. */
static void test_few(void **state)
{
    (void)state;
    struct tile tiles[3] = {0};
    const double cost[3] = {1.0, 5.0, 2.0};
    uint64_t load[6] = {400, 0, 900, 100, 50, 100};
    const uint64_t after[6] = {400, 200, 900, 1100, 450, 100};
    cut(tiles, 3, cost, 6, 2, load);
    assert_int_equal(tiles[0].rank, 1);
    assert_int_equal(tiles[1].rank, 3);
    assert_int_equal(tiles[2].rank, 4);
    assert_memory_equal(load, after, sizeof load);
    cut(tiles, 0, cost, 6, 2, load);
    assert_memory_equal(load, after, sizeof load);
}

/* Begin of a stretch of ranks, or of its share of the tiles. */
static unsigned begin(unsigned stretch, unsigned stretches, unsigned n)
{
    return stretch * n / stretches;
}

/* Of each stretch of many ranks those that come before in the order (load, rank). */
static void test_fewer(void **state)
{
    (void)state;
    enum { SIZE = 97, STRETCHES = 7 }; /* of 13 and 14 ranks */
    struct tile tiles[SIZE] = {0};
    double cost[SIZE] = {0};
    uint64_t load[SIZE];
    for (unsigned n = 1; n < SIZE; n++) {
        unsigned next = 0, stretches = n < STRETCHES ? n : STRETCHES;
        for (unsigned r = 0; r < SIZE; r++) load[r] = 10 * (r * r * (n + 3) % 11);
        uint64_t was[SIZE];
        memcpy(was, load, sizeof was);
        cut(tiles, n, cost, SIZE, 1, load);
        for (unsigned s = 0; s < stretches; s++) {
            unsigned from = begin(s, stretches, SIZE), to = begin(s + 1, stretches, SIZE);
            for (unsigned r = from; r < to; r++) {
                unsigned before = 0;
                for (unsigned q = from; q < to; q++) before += was[q] < was[r] || (was[q] == was[r] && q < r);
                if (begin(s, stretches, n) + before < begin(s + 1, stretches, n))
                    assert_int_equal(tiles[next++].rank, r);
            }
        }
        assert_int_equal(next, n);
    }
}

/* Each node of 64 ranks gets its share of few tiles, within two, though only the ranks of one are idle. */
static void test_spread(void **state)
{
    (void)state;
    enum { NODE = 64, NODES = 5, SIZE = NODES * NODE };
    static struct tile tiles[SIZE];
    static double cost[SIZE];
    for (unsigned n = 1; n < SIZE; n++)
        for (unsigned idle = 0; idle < NODES; idle++) {
            uint64_t load[SIZE];
            unsigned count[NODES] = {0};
            for (unsigned r = 0; r < SIZE; r++) load[r] = r / NODE == idle ? 0 : 100 + pick(100);
            cut(tiles, n, cost, SIZE, 1, load);
            for (unsigned i = 0; i < n; i++) count[tiles[i].rank / NODE]++;
            for (unsigned k = 0; k < NODES; k++) {
                assert_true(NODES * count[k] < n + 2 * NODES);
                assert_true(NODES * count[k] + 2 * NODES > n);
            }
        }
}

static void test_imbalance(void **state)
{
    (void)state;
    const uint64_t load[4] = {3, 0, 9, 0}, none[3] = {0};
    assert_true(partition_imbalance(load, 4, 3) == 1.25);
    assert_true(partition_imbalance(load, 4, 4) == 2.0);
    assert_true(partition_imbalance(none, 0, 3) == 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_best),    cmocka_unit_test(test_even),   cmocka_unit_test(test_units),
        cmocka_unit_test(test_nearest), cmocka_unit_test(test_runs),   cmocka_unit_test(test_few),
        cmocka_unit_test(test_fewer),   cmocka_unit_test(test_spread), cmocka_unit_test(test_imbalance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
