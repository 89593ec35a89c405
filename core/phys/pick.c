/* pick.c - see pick.h. */
#include "phys/pick.h"

#include "bulla/module.h"

#include <stdint.h>
#include <string.h>

enum { PICK_ROW = 512, PICK_GROUP = 8 }; /* cells that are marked together, and passed over together */

static BULLA_KERNEL void pick_mark(size_t n, const double *restrict row, unsigned char *restrict mark)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) mark[i] |= row[i] != 0.0 ? 1 : 0;
}

static BULLA_KERNEL void pick_mark_both(size_t n, const double *restrict one, const double *restrict other,
                                        unsigned char *restrict mark)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) mark[i] |= ((one[i] != 0.0) | (other[i] != 0.0)) ? 1 : 0;
}

/* Where a surface is, cells with and without a mark follow each other as they like: no branch within a group. */
size_t pick_marked(size_t n, unsigned from, const unsigned char *mark, unsigned *at)
{
    size_t count = 0;
    for (size_t i = 0; i < n; i += PICK_GROUP) {
        size_t some = n - i < PICK_GROUP ? n - i : PICK_GROUP;
        uint64_t group = 0;
        if (some == PICK_GROUP) memcpy(&group, mark + i, PICK_GROUP);
        if (some == PICK_GROUP && !group) continue;
        for (size_t k = i; k < i + some; k++) {
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
        const double *row = first + from;
        size_t some = n - from < PICK_ROW ? n - from : PICK_ROW;
        for (unsigned k = 0; k + 1 < rows; k += 2) pick_mark_both(some, row + k * pitch, row + (k + 1) * pitch, mark);
        if (rows % 2) pick_mark(some, row + (rows - 1) * pitch, mark);
        count += pick_marked(some, (unsigned)from, mark, at + count);
    }
    return count;
}

void pick_take(size_t n, const unsigned *at, const double *restrict row, double *restrict packed)
{
    for (size_t i = 0; i < n; i++) packed[i] = row[at[i]];
}

void pick_take_rows(size_t n, const unsigned *at, unsigned rows, size_t pitch, const double *restrict first,
                    size_t packed_pitch, double *restrict packed)
{
    for (size_t k = 0; k < rows; k++) pick_take(n, at, first + k * pitch, packed + k * packed_pitch);
}

void pick_put(size_t n, const unsigned *at, const double *restrict packed, double *restrict row)
{
    for (size_t i = 0; i < n; i++) row[at[i]] = packed[i];
}
