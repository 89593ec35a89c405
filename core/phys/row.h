/* row.h - the plainest loops over rows of doubles, which every room needs: sums, products, differences.
 *
 * Rows may not overlap. What is special to one equation stays in its own file. */
#ifndef ROW_H
#define ROW_H

#include <stddef.h>

void row_add(size_t n, const double *restrict a, double *restrict sum); /* sum += a */
void row_add_product(size_t n, const double *restrict a, const double *restrict b,
                     double *restrict sum); /* sum += a b */
void row_add_both(size_t n, const double *restrict a, const double *restrict b,
                  double *restrict sum);                                  /* sum += a + b */
void row_take(size_t n, const double *restrict a, double *restrict from); /* from -= a */
void row_divide(size_t n, const double *restrict by, double *restrict a); /* a /= by */
void row_step(size_t n, double dt, const double *restrict u, const double *restrict rate,
              double *restrict now); /* now = u + dt rate */
void row_mean(size_t n, const double *restrict a, const double *restrict b, double *restrict mean); /* (a + b)/2 */
double row_most(size_t n, const double *row); /* the largest value, at least 0 */

/* Asks the second level of caches for `count` rows of `length` doubles, `pitch` apart. No value changes. */
void row_ask(size_t count, size_t pitch, size_t length, const double *row);

#endif
