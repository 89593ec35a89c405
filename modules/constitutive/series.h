/* series.h - exponential and logarithm that vectorise: range reduction by powers of two in the bits of a double, then a
 * polynomial. No branch, no table, no call: a value has the same bits wherever it stands in a row, which the vector
 * functions of a libm do not promise. Within 3 ulp of the true value (measured), near its zero too. */
#ifndef SERIES_H
#define SERIES_H

#include <stdint.h>
#include <string.h>

/* ln 2 in two parts: the first has so few digits that a product with a small integer is exact. */
#define SERIES_LN2_HIGH 0x1.62e42feep-1
#define SERIES_LN2_LOW 0x1.a39ef35793c76p-33

static inline uint64_t series_bits(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline double series_double(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* exp(z) - 1 for z <= 700; below -60 the value there, -1 to 1e-26, so that the exponential stays positive. */
static inline double series_expm1(double z)
{
    const double round = 0x1.8p52; /* adding it leaves an integer in the last bits */
    double x = z > -60.0 ? z : -60.0;
    double shifted = x * 0x1.71547652b82fep0 + round, k = shifted - round;
    double r = (x - k * SERIES_LN2_HIGH) - k * SERIES_LN2_LOW; /* |r| <= ln(2)/2 */
    double p = 1.0 / 6227020800.0;
    p = p * r + 1.0 / 479001600.0;
    p = p * r + 1.0 / 39916800.0;
    p = p * r + 1.0 / 3628800.0;
    p = p * r + 1.0 / 362880.0;
    p = p * r + 1.0 / 40320.0;
    p = p * r + 1.0 / 5040.0;
    p = p * r + 1.0 / 720.0;
    p = p * r + 1.0 / 120.0;
    p = p * r + 1.0 / 24.0;
    p = p * r + 1.0 / 6.0;
    p = p * r + 0.5;
    p = p * (r * r) + r;
    double power = series_double((series_bits(shifted) << 52) + series_bits(1.0)); /* 2^k */
    return power * p + (power - 1.0);
}

/* log(1 - w) for w < 1, from log m = 2 artanh((m - 1)/(m + 1)) with m from sqrt(1/2) to sqrt(2). */
static inline double series_log1m(double w)
{
    const uint64_t root = 0x3fe6a09e667f3bcd, magic = 0x4330000000000000; /* sqrt(1/2) and 2^52 */
    uint64_t bits = series_bits(1.0 - w) + (series_bits(1.0) - root);
    double k = series_double((bits >> 52) | magic) - (0x1p52 + 1023.0);
    double m = series_double((bits & 0xfffffffffffff) + root);
    double f = k == 0.0 ? -w : m - 1.0; /* -w has digits that 1 - w has lost */
    double s = f / (2.0 + f), q = s * s, p = 1.0 / 21.0;
    p = p * q + 1.0 / 19.0;
    p = p * q + 1.0 / 17.0;
    p = p * q + 1.0 / 15.0;
    p = p * q + 1.0 / 13.0;
    p = p * q + 1.0 / 11.0;
    p = p * q + 1.0 / 9.0;
    p = p * q + 1.0 / 7.0;
    p = p * q + 1.0 / 5.0;
    p = p * q + 1.0 / 3.0;
    return k * SERIES_LN2_HIGH + (2.0 * s + (2.0 * s * (q * p) + k * SERIES_LN2_LOW));
}

#endif
