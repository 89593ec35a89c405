/* pick.h - the few cells of a row that something concerns, side by side: their numbers, and their values packed.
 *
 * A surface crosses some cells of a tile. What only they need is worked out in packed rows, as long as there are such
 * cells, by the same kernels and so with the same bits as in place. */
#ifndef PICK_H
#define PICK_H

#include <stddef.h>

/* Numbers of the cells i < n, ascending, in which one of `rows` rows is not 0: row k at first + k * pitch. Returns how
 * many there are. */
size_t pick_nonzero(size_t n, unsigned rows, size_t pitch, const double *first, unsigned *at);

/* The same of n cells with a mark each, 1 or 0, whose numbers begin with `from`. */
size_t pick_marked(size_t n, unsigned from, const unsigned char *mark, unsigned *at);

/* packed = row at n cells. */
void pick_take(size_t n, const unsigned *at, const double *restrict row, double *restrict packed);

/* The same of `rows` rows: row k at first + k * pitch, packed at packed + k * packed_pitch. */
void pick_take_rows(size_t n, const unsigned *at, unsigned rows, size_t pitch, const double *restrict first,
                    size_t packed_pitch, double *restrict packed);

/* row = packed there. The other cells keep what they have. */
void pick_put(size_t n, const unsigned *at, const double *restrict packed, double *restrict row);

#endif
