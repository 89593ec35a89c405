/* accrue.h - exact sums of doubles, of any number and order.
 *
 * A sum is kept as one fixed-point number that is as wide as the range of doubles, in digits of 32 bits with room for
 * carries (Kulisch). Nothing is ever rounded but the value at the end, once and to the nearest: so digits of several
 * ranks may be added like any integers, in any order, and the value has the same bits. */
#ifndef ACCRUE_H
#define ACCRUE_H

#include <stddef.h>

enum {
    ACCRUE_DIGITS = 67,                /* of 32 bits, the first counts 2^-1074: 2098 bits, and 2^31 terms */
    ACCRUE_NUMBERS = ACCRUE_DIGITS + 3 /* behind them: how many were infinite, minus infinite, no numbers */
};

/* Begins as zeros. Two sums are added number by number, at most 2^31 settled ones. */
struct accrue {
    long long numbers[ACCRUE_NUMBERS];
};

/* Adds `count` doubles, `step` apart (count < 2^30 from one accrue_settle() to the next). */
void accrue_add(struct accrue *sum, size_t count, size_t step, const double *values);

/* Carries: all digits but the last are below 2^32 and not negative then. */
void accrue_settle(struct accrue *sum);

/* The sum, rounded to the nearest double; infinite beyond those, NaN of NaN or of both infinities. Settles it. */
double accrue_value(struct accrue *sum);

#endif
