/* pick.c - see pick.h. */
#include "phys/pick.h"

#include "bulla/module.h"

#include <string.h>

enum { PICK_ROW = 512, PICK_BLOCK = 64 }; /* cells that are marked together, and passed over together */

static BULLA_KERNEL void pick_mark(size_t n, const double *restrict row, unsigned char *restrict mark)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) mark[i] |= row[i] != 0.0 ? 1 : 0;
}

/* Where a surface is, cells with and without a mark follow each other as they like: no branch in there. */
size_t pick_marked(size_t n, unsigned from, const unsigned char *mark, unsigned *at)
{
    static const unsigned char none[PICK_BLOCK];
    size_t count = 0;
    for (size_t i = 0; i < n; i += PICK_BLOCK) {
        size_t end = n - i < PICK_BLOCK ? n : i + PICK_BLOCK;
        if (!memcmp(mark + i, none, end - i)) continue;
        for (size_t k = i; k < end; k++) {
            at[count] = from + (unsigned)k;
            count += mark[k];
        }
    }
    return count;
}

size_t pick_nonzero(size_t n, unsigned rows, size_t pitch, const double *first, unsigned *at)
{
    size_t count = 0;
    for (size_t from = 0; from < n; from += PICK_ROW) {
        unsigned char mark[PICK_ROW] = {0};
        size_t some = n - from < PICK_ROW ? n - from : PICK_ROW;
        for (unsigned k = 0; k < rows; k++) pick_mark(some, first + k * pitch + from, mark);
        count += pick_marked(some, (unsigned)from, mark, at + count);
    }
    return count;
}

void pick_take(size_t n, const unsigned *at, const double *restrict row, double *restrict packed)
{
    for (size_t i = 0; i < n; i++) packed[i] = row[at[i]];
}

void pick_put(size_t n, const unsigned *at, const double *restrict packed, double *restrict row)
{
    for (size_t i = 0; i < n; i++) row[at[i]] = packed[i];
}
