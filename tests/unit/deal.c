/* Cuts of levels whose tiles lie on several ranks (program/ranks_mesh.sh starts them) are those of the whole levels on
 * one, and come to every rank. */
#include "mesh/deal.h"

#include "base/comm.h"
#include "base/mem.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { LEVELS = 4, ROUNDS = 20, MOST = 200 };

static uint64_t seed = 7;

static unsigned pick(unsigned count)
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (unsigned)(seed >> 33) % count;
}

/* Every rank draws the same levels, and where they are cut. */
static void draw(double *costs, unsigned *begin, int l, unsigned round)
{
    unsigned n = l == 1 ? 1 + pick(3) : 1 + pick(MOST), size = (unsigned)comm_size();
    for (unsigned i = 0; i < n; i++) costs[i] = pick(3) ? 1.0 : 0.05 * (1 + pick(60));
    for (unsigned r = 0; r <= size; r++)
        begin[r] = round % 2 ? n * r / size : r > round % size ? n : 0; /* shared, or all on one rank */
}

/* What one rank would cut. */
static void add_whole(struct deal *whole, int l, const double *costs, const unsigned *begin, uint64_t *load)
{
    for (int r = 0; r < comm_size(); r++) {
        deal_add(whole, l, costs + begin[r], begin[r + 1] - begin[r]);
        for (unsigned i = begin[r]; l <= whole->base && i < begin[r + 1]; i++)
            load[r] += (whole->subcycle ? 1u << l : 1u) * partition_units(costs[i]);
    }
}

static void check_round(unsigned round)
{
    int size = comm_size(), rank = comm_rank();
    struct deal deal = {.base = (int)pick(LEVELS - 1), .subcycle = pick(2)}, whole = deal;
    uint64_t *load = mem_new((size_t)size, sizeof *load);
    unsigned *begin = mem_new((size_t)size + 1, sizeof *begin);
    for (int l = 0; l < LEVELS; l++) {
        double costs[MOST];
        draw(costs, begin, l, round);
        deal_add(&deal, l, costs + begin[rank], begin[rank + 1] - begin[rank]);
        add_whole(&whole, l, costs, begin, load);
    }
    assert_true(deal.load == load[rank]);
    deal_cut(&deal);
    deal_share(&whole, whole.runs, whole.n, size, load);
    assert_int_equal(deal.root, whole.root);
    for (int l = 0; l < LEVELS; l++)
        if (l > deal.base || deal.root)
            assert_memory_equal(deal_first(&deal, l), deal_first(&whole, l), ((size_t)size + 1) * sizeof(uint32_t));
    deal_free(&deal);
    deal_free(&whole);
    mem_free(load);
    mem_free(begin);
}

static void test_cut(void **state)
{
    (void)state;
    for (unsigned round = 0; round < ROUNDS; round++) check_round(round);
}

/* Level 0 is cut anew where one rank has nearly all of it, not where it is shared well. */
static void test_root(void **state)
{
    (void)state;
    for (int badly = 0; badly < 2; badly++) {
        double costs[64];
        struct deal deal = {.subcycle = true};
        for (int i = 0; i < 64; i++) costs[i] = badly && comm_rank() ? 0.05 : 1.0;
        deal_add(&deal, 0, costs, 64);
        deal_cut(&deal);
        assert_int_equal(deal.root, badly && comm_size() > 1);
        assert_int_equal(deal_first(&deal, 0)[comm_size()], 64 * comm_size());
        deal_free(&deal);
    }
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_cut), cmocka_unit_test(test_root)};
    comm_init(&argc, &argv);
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    comm_done();
    return failed;
}
