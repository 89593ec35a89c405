/* pool.h - blocks of one size for tiles that come and go.
 *
 * A regrid frees and needs blocks all the time; they are kept in slabs (large pages where the system has
 * them) with a free list. Blocks are 64-byte aligned and a cache line apart. A block that was used before
 * holds old numbers: whoever takes one fills it. */
#ifndef POOL_H
#define POOL_H

#include <stddef.h>

struct pool;

struct pool *pool_new(size_t block_doubles);
void pool_free(struct pool *pool);

/* Makes room for `count` more blocks at once: a slab of what is missing, or a sixteenth of the pool if that is more, so
 * that slabs stay few. */
void pool_reserve(struct pool *pool, size_t count);

/* One block; grows the pool by a slab when it is empty. */
double *pool_take(struct pool *pool);
void pool_give(struct pool *pool, double *block);

/* Blocks in use, and blocks that exist. */
size_t pool_used(const struct pool *pool);
size_t pool_size(const struct pool *pool);

/* Bytes that one block takes. */
size_t pool_bytes(const struct pool *pool);

#endif
