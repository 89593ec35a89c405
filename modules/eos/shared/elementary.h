/* elementary.h - exp, log, pow and tanh as plain arithmetic, for rows of real-fluid laws.
 *
 * The functions of libm keep a loop scalar, and a vector libm may round differently at different
 * places of a row. These are branch-free, so that loops over them become vector loops, and give
 * the same bits wherever a point stands. Errors are below 2 units in the last place (exp, log);
 * arguments beyond the range of exp saturate at 1e-307 and 1e308, log of what is not positive is
 * NaN, and a NaN stays one. Reductions and series: Muller, Elementary Functions, 3rd ed. (2016),
 * chapters 3 and 11. */
#ifndef ELEMENTARY_H
#define ELEMENTARY_H

#include <stdint.h>
#include <string.h>

/* Functions of a point: a call left in a loop keeps it scalar, however long the function is. */
#define ELEMENTARY_INLINE static inline __attribute__((always_inline))

#define ELEMENTARY_LN2_HIGH 0x1.62e42fefa38p-1 /* 43 bits, so that k times it is exact */
#define ELEMENTARY_LN2_LOW 0x1.ef35793c76730p-45
#define ELEMENTARY_HALF_ROOT 0x3fe6a09e667f3bcdu /* bits of the root of 1/2 */

ELEMENTARY_INLINE uint64_t elementary_bits(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

ELEMENTARY_INLINE double elementary_double(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* x = k ln 2 + r with |r| <= ln 2/2; the Taylor series of exp(r) ends below 1e-17. Adding 1.5 2^52
 * leaves the rounded k in the low bits. */
ELEMENTARY_INLINE double elementary_exp(double x)
{
    double low = x < -707.0 ? -707.0 : x, y = low > 709.0 ? 709.0 : low;
    double shifted = y * 0x1.71547652b82fep+0 + 0x1.8p52, k = shifted - 0x1.8p52;
    double r = (y - k * ELEMENTARY_LN2_HIGH) - k * ELEMENTARY_LN2_LOW, r2 = r * r;
    double even = 1.0 / 479001600.0 + r * (1.0 / 6227020800.0);
    even = (1.0 / 3628800.0 + r * (1.0 / 39916800.0)) + r2 * even;
    even = (1.0 / 40320.0 + r * (1.0 / 362880.0)) + r2 * even;
    even = (1.0 / 720.0 + r * (1.0 / 5040.0)) + r2 * even;
    even = (1.0 / 24.0 + r * (1.0 / 120.0)) + r2 * even;
    even = (0.5 + r * (1.0 / 6.0)) + r2 * even;
    return (1.0 + (r + r2 * even)) * elementary_double((elementary_bits(shifted) + 1023u) << 52);
}

/* x = 2^k m with m from the root of 1/2 to that of 2; ln m = 2 atanh(s), s = (m - 1)/(m + 1), arranged so
 * that m - 1 enters exactly. */
ELEMENTARY_INLINE double elementary_log(double x)
{
    uint64_t bits = elementary_bits(x), power = (bits - ELEMENTARY_HALF_ROOT + ((uint64_t)1023 << 52)) >> 52;
    double k = elementary_double(power | 0x4330000000000000u) - (0x1p52 + 1023.0);
    double f = elementary_double(bits - (power << 52) + ((uint64_t)1023 << 52)) - 1.0;
    double s = f / (2.0 + f), z = s * s, half = 0.5 * f * f;
    double series = 2.0 / 19.0 + z * (2.0 / 21.0 + z * (2.0 / 23.0));
    series = 2.0 / 13.0 + z * (2.0 / 15.0 + z * (2.0 / 17.0 + z * series));
    series = 2.0 / 7.0 + z * (2.0 / 9.0 + z * (2.0 / 11.0 + z * series));
    series = z * (2.0 / 3.0 + z * (2.0 / 5.0 + z * series));
    double rest = half - (s * (half + series) + k * ELEMENTARY_LN2_LOW);
    double result = k * ELEMENTARY_LN2_HIGH + (f - rest);
    return x > 0.0 ? result : elementary_double(0x7ff8000000000000u);
}

/* x^y for x > 0; the relative error grows with |y ln x|. */
ELEMENTARY_INLINE double elementary_pow(double x, double y)
{
    return elementary_exp(y * elementary_log(x));
}

/* x rounded to 35 bits. Laws that find T by an iteration end it so: neighbouring pressures then share a T, what is left
 * of p goes linearly, and the iteration for the pressure of a mixture sees a straight line, no rounding of large
 * terms. */
ELEMENTARY_INLINE double elementary_coarse(double x)
{
    double much = 0x1p18 * x;
    return (x + much) - much;
}

/* tanh to an absolute error of 2e-16. */
ELEMENTARY_INLINE double elementary_tanh(double x)
{
    double t = elementary_exp(2.0 * x);
    return 1.0 - 2.0 / (t + 1.0);
}

#endif
