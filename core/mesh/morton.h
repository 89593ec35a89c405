/* morton.h - the space-filling curve that orders tiles: bits of three coordinates interleaved.
 *
 * 21 bits per axis: 2 million tiles along an axis. Children of a tile follow each other on
 * the next level's curve, which is what keeps a partition of one level near that of another. */
#ifndef MORTON_H
#define MORTON_H

#include <stdint.h>

enum { MORTON_MOST = 1 << 21 }; /* tiles along an axis */

/* Spreads the lowest 21 bits so that two zero bits follow each. */
static inline uint64_t morton_spread(uint64_t x)
{
    x &= 0x1fffffu;
    x = (x | x << 32) & 0x1f00000000ffffu;
    x = (x | x << 16) & 0x1f0000ff0000ffu;
    x = (x | x << 8) & 0x100f00f00f00f00fu;
    x = (x | x << 4) & 0x10c30c30c30c30c3u;
    x = (x | x << 2) & 0x1249249249249249u;
    return x;
}

static inline uint64_t morton_key(const int at[3])
{
    return morton_spread((uint64_t)at[0]) | morton_spread((uint64_t)at[1]) << 1 | morton_spread((uint64_t)at[2]) << 2;
}

/* Takes every third bit out, the inverse of morton_spread. */
static inline int morton_gather(uint64_t x)
{
    x &= 0x1249249249249249u;
    x = (x | x >> 2) & 0x10c30c30c30c30c3u;
    x = (x | x >> 4) & 0x100f00f00f00f00fu;
    x = (x | x >> 8) & 0x1f0000ff0000ffu;
    x = (x | x >> 16) & 0x1f00000000ffffu;
    x = (x | x >> 32) & 0x1fffffu;
    return (int)x;
}

/* Tile coordinates of a key. */
static inline void morton_at(uint64_t key, int ret_at[3])
{
    for (int d = 0; d < 3; d++) ret_at[d] = morton_gather(key >> d);
}

#endif
