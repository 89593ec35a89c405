/* Blocks of tiles: where they lie, and that they are used again. */
#include "mesh/pool.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

enum { COUNT = 300 };

/* A reserved slab is taken in the order of addresses, a cache line apart, without growth. */
static void test_reserve(void **state)
{
    (void)state;
    for (size_t doubles = 1; doubles < 40; doubles += 7) {
        struct pool *pool = pool_new(doubles);
        assert_int_equal(pool_size(pool), 0);
        pool_reserve(pool, COUNT);
        assert_int_equal(pool_size(pool), COUNT);
        double *before = NULL;
        for (int i = 0; i < COUNT; i++) {
            double *block = pool_take(pool);
            assert_int_equal((uintptr_t)block % 64, 0);
            if (before) assert_int_equal((block - before) * (long)sizeof *block, pool_bytes(pool));
            assert_int_equal(pool_used(pool), i + 1);
            before = block;
            for (size_t k = 0; k < doubles; k++) block[k] = (double)k;
        }
        assert_int_equal(pool_size(pool), COUNT);
        assert_true(pool_bytes(pool) >= doubles * sizeof(double) && pool_bytes(pool) % 64 == 0);
        assert_true(pool_bytes(pool) < doubles * sizeof(double) + 128);
        pool_free(pool);
    }
}

/* Blocks given back are used before new ones are made, and reserving counts them. */
static void test_reuse(void **state)
{
    (void)state;
    struct pool *pool = pool_new(100);
    double *blocks[COUNT];
    for (int i = 0; i < COUNT; i++) blocks[i] = pool_take(pool);
    size_t size = pool_size(pool);
    assert_true(size >= COUNT && size <= COUNT + COUNT / 16 + 1);
    for (int round = 0; round < 5; round++) {
        for (int i = round; i < COUNT; i += 2) pool_give(pool, blocks[i]);
        for (int i = round; i < COUNT; i += 2) blocks[i] = pool_take(pool);
    }
    assert_int_equal(pool_size(pool), size);
    assert_int_equal(pool_used(pool), COUNT);
    pool_reserve(pool, size - COUNT);
    assert_int_equal(pool_size(pool), size);
    pool_reserve(pool, size - COUNT + 1); /* a slab of one block would be one of many */
    assert_int_equal(pool_size(pool), size + size / 16);
    pool_reserve(pool, 2 * COUNT);
    assert_int_equal(pool_size(pool), 3 * COUNT);
    for (int i = 0; i < COUNT; i++) /* no block is out twice */
        for (int k = 0; k < i; k++) assert_ptr_not_equal(blocks[i], blocks[k]);
    pool_free(pool);
    pool_free(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_reserve), cmocka_unit_test(test_reuse)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
