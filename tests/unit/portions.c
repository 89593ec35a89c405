/* What a rank knows of the rows of others: a writer all of its ranks, another rank its own and who else has rows of the
 * same chunks, nothing more; rank 0 gets each writer's joined. Compared, on the ranks that there are
 * (program/ranks_mesh.sh starts several), with what follows from the list of all. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/comm.h"
#include "base/mem.h"
#include "io/portions.h"
#include "io/writers.h"

enum { LEVELS = 3 };

/* Rows of a rank on a level: some have none. */
static size_t rows_of(int rank, int l)
{
    return (size_t)((rank * 7 + l * 5) % 4) * (size_t)(l + 1);
}

/* Level by level, rank by rank. */
static struct h5out_range range_of(int rank, int l)
{
    struct h5out_range range = {0, rows_of(rank, l)};
    for (int k = 0; k <= l; k++)
        for (int r = 0; r < (k < l ? comm_size() : rank); r++) range.first += rows_of(r, k);
    return range;
}

/* All portions of a writer. */
static struct portions all_of(int writers, int writer)
{
    struct portions all = {.leader = writers_first(writers, writer)};
    int end = writers_first(writers, writer + 1);
    all.list = mem_new((size_t)(end - all.leader) * LEVELS + 1, sizeof *all.list);
    for (int l = 0; l < LEVELS; l++)
        for (int rank = all.leader; rank < end; rank++) {
            struct h5out_range range = range_of(rank, l);
            if (!range.count) continue;
            all.list[all.n++] = (struct portion){rank, range.first, range.count, all.total};
            all.total += range.count;
        }
    return all;
}

/* Do portions a and b have rows of one chunk? */
static bool meet(const struct portion *a, const struct portion *b, size_t chunk)
{
    return a->place / chunk <= (b->place + b->count - 1) / chunk &&
           b->place / chunk <= (a->place + a->count - 1) / chunk;
}

static bool concerns(const struct portions *all, unsigned i, size_t chunk)
{
    if (comm_rank() == all->leader) return true;
    for (unsigned j = 0; j < all->n; j++)
        if (all->list[j].rank == comm_rank() && meet(&all->list[i], &all->list[j], chunk)) return true;
    return false;
}

static void expect(const struct portion *is, const struct portion *should)
{
    assert_int_equal(is->rank, should->rank);
    assert_int_equal(is->first, should->first);
    assert_int_equal(is->count, should->count);
    assert_int_equal(is->place, should->place);
}

/* Rank 0: each row of the data set once, where its writer has it. */
static void check_view(const struct portions_letter *letter, int writers)
{
    for (int writer = 0; writer < writers; writer++) {
        struct portions joined, all = all_of(writers, writer);
        unsigned i = 0;
        portions_receive(letter, all.leader, &joined);
        assert_int_equal(joined.total, all.total);
        for (unsigned run = 0; run < joined.n; run++) {
            size_t at = joined.list[run].place, first = joined.list[run].first, end = at + joined.list[run].count;
            for (; i < all.n && all.list[i].place < end; i++)
                assert_int_equal(all.list[i].first - first, all.list[i].place - at);
            assert_true(!run || first > joined.list[run - 1].first + joined.list[run - 1].count);
        }
        assert_int_equal(i, all.n);
        portions_free(&joined);
        portions_free(&all);
    }
}

static void check(int writers, size_t chunk)
{
    struct h5out_range ranges[LEVELS];
    struct portions own, all = all_of(writers, writers_of(writers, comm_rank()));
    struct portions_letter letter;
    unsigned n = 0;
    for (int l = 0; l < LEVELS; l++) ranges[l] = range_of(comm_rank(), l);
    portions_take(writers, chunk, LEVELS, ranges, &own);
    assert_int_equal(own.total, all.total);
    assert_int_equal(own.leader, all.leader);
    if (all.total) assert_int_equal(own.chunk, chunk < all.total ? chunk : all.total);
    for (unsigned i = 0; i < all.n; i++)
        if (concerns(&all, i, own.chunk)) expect(&own.list[n++], &all.list[i]);
    assert_int_equal(own.n, n);
    portions_send(&own, &letter);
    if (comm_rank() == 0) check_view(&letter, writers);
    portions_sent(&letter);
    portions_free(&own);
    portions_free(&all);
}

static void test_portions(void **state)
{
    (void)state;
    for (int writers = 1; writers <= comm_size(); writers++)
        for (size_t chunk = 1; chunk < 40; chunk += 1 + chunk / 2) check(writers, chunk);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_portions)};
    comm_init(&argc, &argv);
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    comm_done();
    return failed;
}
