/* slots.h - a hash table of indices: who holds a list finds the items of it by a key that he makes and compares
 * himself.
 *
 * Open addressing, never more than half full if `n` was right, nothing is ever taken out. Fibonacci hashing: the
 * highest bits of a product with 2^64 / golden ratio (Knuth, The Art of Computer Programming 3, 6.4). The search is
 * inline, so that the comparison is, too: levels look up some ten tiles for each they have. */
#ifndef SLOTS_H
#define SLOTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define SLOTS_GOLDEN 0x9e3779b97f4a7c15u

/* Start from {0}. */
struct slots {
    int bits;        /* 2^bits slots */
    unsigned *taken; /* 1 + index; 0: free */
};

/* Is the item at this index of `list` the one with `key`? */
typedef bool slots_same(const void *list, unsigned index, const void *key);

/* An empty table for n items, n < 2^31; the old one is freed. */
void slots_start(struct slots *slots, size_t n);
void slots_done(struct slots *slots);

/* A hash of one more word of a key; begin with 0. Keys of one word are hashes themselves. */
static inline uint64_t slots_hash(uint64_t hash, uint64_t word)
{
    hash = (hash ^ word) * SLOTS_GOLDEN;
    return hash ^ hash >> 32;
}

/* The slot of the item with a key: 1 + its index, or 0, to be written, if it is not there. The table must have been
 * started. */
static inline unsigned *slots_find(const struct slots *slots, uint64_t hash, slots_same *same, const void *list,
                                   const void *key)
{
    size_t last = ((size_t)1 << slots->bits) - 1, at = (size_t)(hash * SLOTS_GOLDEN >> (64 - slots->bits));
    while (slots->taken[at] && !same(list, slots->taken[at] - 1, key)) at = (at + 1) & last;
    return &slots->taken[at];
}

#endif
