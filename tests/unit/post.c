/* Posts between any number of ranks (program/ranks_mesh.sh starts several): every item arrives, again and again. */
#include "mesh/post.h"

#include "base/comm.h"
#include "base/mem.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

enum { ITEMS = 5, ROUNDS = 3 };

/* Size of item i from one rank to another: some are empty. */
static size_t item_size(int from, int to, unsigned i)
{
    return (size_t)(7 * from + 3 * to + 11) * i % 13;
}

static double item_value(int from, int to, unsigned i, size_t k, int round)
{
    return from + 10.0 * to + 100.0 * i + 1000.0 * (double)k + 1e6 * round;
}

/* Items of all other ranks, not rank by rank: the first of each, then the second. */
static unsigned list_items(struct post_item *items, bool out)
{
    unsigned n = 0;
    int rank = comm_rank();
    for (unsigned i = 0; i < ITEMS; i++)
        for (int peer = comm_size() - 1; peer >= 0; peer--)
            if (peer != rank)
                items[n++] = (struct post_item){peer, out ? item_size(rank, peer, i) : item_size(peer, rank, i)};
    return n;
}

static void check_round(struct post *post, int round)
{
    int rank = comm_rank();
    for (int way = 0; way < 2; way++) {
        unsigned n = 0;
        for (unsigned i = 0; i < ITEMS; i++)
            for (int peer = comm_size() - 1; peer >= 0; peer--) {
                if (peer == rank) continue;
                double *at = way ? post_in(post, n) : post_out(post, n);
                n++;
                if (way)
                    for (size_t k = 0; k < item_size(peer, rank, i); k++)
                        assert_true(at[k] == item_value(peer, rank, i, k, round));
                else
                    for (size_t k = 0; k < item_size(rank, peer, i); k++) at[k] = item_value(rank, peer, i, k, round);
            }
        if (!way) post_start(post);
        if (!way) post_finish(post);
    }
    post_finish(post);
}

static void test_round(void **state)
{
    (void)state;
    size_t room = (size_t)(comm_size() * ITEMS), volume = 0;
    struct post_item *out = mem_new(room, sizeof *out), *in = mem_new(room, sizeof *in);
    unsigned n_out = list_items(out, true), n_in = list_items(in, false);
    struct post *post = post_new(7, n_out, out, n_in, in);
    for (unsigned i = 0; i < n_out; i++) volume += out[i].doubles;
    assert_int_equal(post_volume(post), volume);
    post_finish(post); /* without a start */
    for (int round = 0; round < ROUNDS; round++) check_round(post, round);
    post_free(post);
    mem_free(out);
    mem_free(in);
}

/* Two posts under way at once do not take each other's numbers; on one rank there is nothing to do. */
static void test_tags(void **state)
{
    (void)state;
    int rank = comm_rank(), size = comm_size(), next = (rank + 1) % size, last = (rank + size - 1) % size;
    unsigned n = size > 1;
    struct post *a = post_new(1, n, &(struct post_item){next, 1}, n, &(struct post_item){last, 1});
    struct post *b = post_new(2, n, &(struct post_item){next, 1}, n, &(struct post_item){last, 1});
    if (n) {
        *post_out(a, 0) = rank;
        *post_out(b, 0) = 100 + rank;
    }
    struct post *first = rank % 2 ? a : b, *second = rank % 2 ? b : a;
    post_start(first);
    post_start(second);
    post_finish(second);
    post_finish(first);
    if (n) {
        assert_true(*post_in(a, 0) == last);
        assert_true(*post_in(b, 0) == 100 + last);
    }
    post_free(a);
    post_free(b);
    post_free(NULL);
}

int main(int argc, char **argv)
{
    comm_init(&argc, &argv);
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_round), cmocka_unit_test(test_tags)};
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    comm_done();
    return failed;
}
