/* slots.c - a table of indices: what was put in is found, nothing else is, also where many keys have one hash. */
#include "base/slots.h"

#include "base/mem.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

enum { COUNT = 3000 };

static bool same(const void *list, unsigned index, const void *key)
{
    return ((const uint64_t *)list)[index] == *(const uint64_t *)key;
}

/* Keys i * stride, the even ones in the table; `hash` as a function of the key. */
static void check(uint64_t stride, uint64_t (*hash)(uint64_t key), size_t n)
{
    struct slots slots = {0};
    uint64_t *list = mem_new(n + 1, sizeof *list);
    slots_start(&slots, n);
    size_t size = (size_t)1 << slots.bits;
    assert_true(size > 2 * n || n == 0);
    for (unsigned i = 0; i < n; i++) {
        list[i] = 2 * i * stride;
        unsigned *slot = slots_find(&slots, hash(list[i]), same, list, &list[i]);
        assert_int_equal(*slot, 0);
        *slot = i + 1;
    }
    for (unsigned i = 0; i < n; i++) {
        uint64_t odd = (2 * (uint64_t)i + 1) * stride;
        assert_int_equal(*slots_find(&slots, hash(list[i]), same, list, &list[i]), i + 1);
        assert_int_equal(*slots_find(&slots, hash(odd), same, list, &odd), 0);
    }
    size_t taken = 0;
    for (size_t at = 0; at < size; at++) taken += slots.taken[at] != 0;
    assert_int_equal(taken, n);
    slots_done(&slots);
    assert_null(slots.taken);
    mem_free(list);
}

static uint64_t plain(uint64_t key)
{
    return key;
}

static uint64_t mixed(uint64_t key)
{
    return slots_hash(slots_hash(0, key), ~key);
}

/* All in one place, the last slot: the search goes round the end. */
static uint64_t crowded(uint64_t key)
{
    (void)key;
    return 0x0e217c1e66c88cc3u; /* times the golden number: 2^64 - 1 */
}

static void test_found(void **state)
{
    (void)state;
    const uint64_t strides[] = {1, 8, 4096, (uint64_t)1 << 40};
    for (size_t s = 0; s < sizeof strides / sizeof *strides; s++) {
        check(strides[s], plain, COUNT);
        check(strides[s], mixed, COUNT);
    }
    check(1, plain, 1);
    check(1, plain, 0);
}

static void test_crowded(void **state)
{
    (void)state;
    assert_true(crowded(0) * SLOTS_GOLDEN >> 60 == 15);
    check(1, crowded, 200);
}

/* Neighbouring keys, of one word or of several, do not crowd: searches are short. */
static void test_spread(void **state)
{
    (void)state;
    for (int words = 1; words <= 2; words++) {
        struct slots slots = {0};
        uint64_t list[COUNT];
        size_t run = 0, longest = 0;
        slots_start(&slots, COUNT);
        for (unsigned i = 0; i < COUNT; i++) {
            list[i] = i;
            uint64_t hash = words == 1 ? i : slots_hash(slots_hash(0, i % 50), i / 50);
            *slots_find(&slots, hash, same, list, &list[i]) = i + 1;
        }
        for (size_t at = 0; at < (size_t)1 << slots.bits; at++) {
            run = slots.taken[at] ? run + 1 : 0;
            longest = run > longest ? run : longest;
        }
        print_message("%d words: at most %zu slots in a row are taken\n", words, longest);
        assert_true(longest < 64);
        slots_done(&slots);
    }
}

/* Starting anew empties the table. */
static void test_again(void **state)
{
    (void)state;
    struct slots slots = {0};
    uint64_t key = 5, list[1] = {5};
    slots_start(&slots, 1);
    *slots_find(&slots, key, same, list, &key) = 1;
    slots_start(&slots, 100);
    assert_int_equal(*slots_find(&slots, key, same, list, &key), 0);
    slots_done(&slots);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_found), cmocka_unit_test(test_crowded),
                                       cmocka_unit_test(test_spread), cmocka_unit_test(test_again)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
