/* pool.c - see pool.h. The free blocks are a stack: the block given back last, still warm, is the next one taken,
 * and those of a fresh slab come in the order of their addresses. */
#include "mesh/pool.h"

#include "base/mem.h"

enum { POOL_LINE = 8 /* doubles of a cache line */, POOL_STEP = 16 /* a slab is at least 1 / POOL_STEP of the pool */ };

struct pool {
    size_t pitch; /* doubles from block to block */
    size_t size, n_free, n_slab;
    double **free; /* [size] of which n_free are there */
    double **slabs;
};

struct pool *pool_new(size_t block_doubles)
{
    struct pool *pool = mem_new(1, sizeof *pool);
    pool->pitch = (block_doubles + 2 * POOL_LINE - 1) / POOL_LINE * POOL_LINE;
    return pool;
}

void pool_free(struct pool *pool)
{
    if (!pool) return;
    for (size_t i = 0; i < pool->n_slab; i++) mem_free(pool->slabs[i]);
    mem_free(pool->slabs);
    mem_free(pool->free);
    mem_free(pool);
}

static void pool_grow(struct pool *pool, size_t count)
{
    if (count < pool->size / POOL_STEP) count = pool->size / POOL_STEP;
    double *slab = mem_new_large(count * pool->pitch, sizeof *slab);
    pool->slabs = mem_grow(pool->slabs, pool->n_slab, pool->n_slab + 1, sizeof *pool->slabs);
    pool->slabs[pool->n_slab++] = slab;
    pool->free = mem_grow(pool->free, pool->n_free, pool->size + count, sizeof *pool->free);
    pool->size += count;
    for (size_t i = count; i > 0; i--) pool->free[pool->n_free++] = slab + (i - 1) * pool->pitch;
}

void pool_reserve(struct pool *pool, size_t count)
{
    if (count > pool->n_free) pool_grow(pool, count - pool->n_free);
}

double *pool_take(struct pool *pool)
{
    pool_reserve(pool, 1);
    return pool->free[--pool->n_free];
}

void pool_give(struct pool *pool, double *block)
{
    pool->free[pool->n_free++] = block;
}

size_t pool_used(const struct pool *pool)
{
    return pool->size - pool->n_free;
}

size_t pool_size(const struct pool *pool)
{
    return pool->size;
}

size_t pool_bytes(const struct pool *pool)
{
    return pool->pitch * sizeof(double);
}
