/* Items of all ranks on rank 0, sums over all and over those below, and answers to what others ask, on the ranks that
 * there are (program/ranks_mesh.sh starts several), compared with what follows from their numbers. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/comm.h"
#include "base/gather.h"
#include "base/mem.h"
#include "base/swap.h"

/* How many items a rank has: some have none. */
static unsigned count_of(int rank)
{
    return (unsigned)(rank * 5 + 3) % 4;
}

static void test_items(void **state)
{
    (void)state;
    uint16_t own[4];
    unsigned n, next = 0;
    for (unsigned i = 0; i < 4; i++) own[i] = (uint16_t)(10 * comm_rank() + (int)i);
    uint16_t *all = gather_items(own, sizeof *own, count_of(comm_rank()), &n);
    for (int rank = 0; comm_rank() == 0 && rank < comm_size(); rank++)
        for (unsigned i = 0; i < count_of(rank); i++) assert_int_equal(all[next++], 10 * rank + (int)i);
    assert_int_equal(n, next);
    mem_free(all);
}

/* A rank that finds something wrong goes on: others would wait for it for ever. */
static void test_sums(void **state)
{
    (void)state;
    enum { VALUES = 3 };
    int wrong = 0;
    for (int round = 0; round < 5; round++) {
        long long values[VALUES], before[VALUES], sum[VALUES] = {0}, below[VALUES] = {0};
        for (int rank = 0; rank < comm_size(); rank++)
            for (int i = 0; i < VALUES; i++) {
                long long value = (rank + 1LL) * (rank + 7LL * i) << 8 * round;
                if (rank == comm_rank()) values[i] = value;
                if (rank < comm_rank()) below[i] += value;
                sum[i] += value;
            }
        gather_sums(values, VALUES, before);
        wrong += memcmp(values, sum, sizeof sum) || memcmp(before, below, sizeof below);
    }
    assert_int_equal(wrong, 0);
}

/* Who is asked: `rank` asks another one `times` times. */
static unsigned times_of(int rank, int other)
{
    return (unsigned)(3 * rank + 2 * other) % 3;
}

static void test_answers(void **state)
{
    (void)state;
    int wrong = 0;
    for (int round = 0; round < 5; round++) {
        struct swap asked;
        unsigned n = 0, next = 0;
        int *questions = mem_new(2 * (size_t)comm_size(), sizeof *questions);
        int *to = mem_new(2 * (size_t)comm_size(), sizeof *to);
        for (int other = 0; other < comm_size(); other++)
            for (unsigned i = 0; i < times_of(comm_rank() + round, other); i++, n++) {
                questions[n] = 1000 * comm_rank() + 10 * (int)i + round;
                to[n] = other;
            }
        swap_items(questions, sizeof *questions, n, to, &asked);
        long long *answers = mem_new(asked.n, sizeof *answers);
        for (int rank = 0; rank < comm_size(); rank++)
            for (unsigned i = 0; i < times_of(rank + round, comm_rank()); i++, next++) {
                wrong += next >= asked.n || ((const int *)asked.items)[next] != 1000 * rank + 10 * (int)i + round;
                if (next < asked.n) answers[next] = 100000LL * (comm_rank() + 1) + ((const int *)asked.items)[next];
            }
        wrong += asked.n != next;
        long long *got = swap_answer(&asked, answers, sizeof *answers);
        for (unsigned i = 0; i < n; i++) wrong += got[i] != 100000LL * (to[i] + 1) + questions[i];
        mem_free(got);
        mem_free(answers);
        mem_free(questions);
        mem_free(to);
        swap_done(&asked);
    }
    assert_int_equal(wrong, 0);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_items), cmocka_unit_test(test_sums),
                                       cmocka_unit_test(test_answers)};
    comm_init(&argc, &argv);
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    comm_done();
    return failed;
}
