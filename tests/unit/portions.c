/* What a rank knows of the rows of others: a writer all of its ranks, another rank its own and who else has rows of the
 * same chunks, nothing more; rank 0 gets each writer's joined. Compared, on the ranks that there are
 * (program/ranks_mesh.sh starts several), with what follows from the list of all. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

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

/* What is not as it should be is counted until the end: a rank that left the test would let the others wait for ever.
 */
static int wrong;

static void expect(bool holds, const char *what)
{
    if (!holds && !wrong++) fprintf(stderr, "rank %d: %s\n", comm_rank(), what);
}

static bool same(const struct portion *a, const struct portion *b)
{
    return a->rank == b->rank && a->first == b->first && a->count == b->count && a->place == b->place;
}

/* Rank 0: each row of the data set once, where its writer has it. */
static void check_view(const struct portions_letter *letter, int writers)
{
    for (int writer = 0; writer < writers; writer++) {
        struct portions joined, all = all_of(writers, writer);
        unsigned i = 0;
        portions_receive(letter, all.leader, &joined);
        expect(joined.total == all.total, "rows of a writer");
        for (unsigned run = 0; run < joined.n; run++) {
            size_t at = joined.list[run].place, first = joined.list[run].first, end = at + joined.list[run].count;
            for (; i < all.n && all.list[i].place < end; i++)
                expect(all.list[i].first - first == all.list[i].place - at, "a place in the file of a writer");
            expect(!run || first > joined.list[run - 1].first + joined.list[run - 1].count,
                   "ranges that are not joined");
        }
        expect(i == all.n, "ranges of a writer");
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
    if (chunk > all.total) chunk = all.total;
    expect(own.total == all.total && own.leader == all.leader && own.chunk == chunk, "whose rows, and how many");
    for (unsigned i = 0; i < all.n; i++)
        if (concerns(&all, i, chunk)) {
            expect(n < own.n && same(&own.list[n], &all.list[i]), "a range that is known");
            n++;
        }
    expect(own.n == n, "ranges that are known");
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
    assert_int_equal(wrong, 0);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_portions)};
    comm_init(&argc, &argv);
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    comm_done();
    return failed;
}
