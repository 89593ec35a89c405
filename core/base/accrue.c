/* accrue.c - see accrue.h. */
#include "base/accrue.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

enum { ACCRUE_BITS = 32, ACCRUE_ODD = 0x7ff, ACCRUE_LEAST = DBL_MIN_EXP - DBL_MANT_DIG }; /* exponent of the last bit */
static const uint64_t accrue_mask = UINT32_MAX;

static void accrue_odd(struct accrue *sum, double value)
{
    long long *odd = sum->numbers + ACCRUE_DIGITS;
    odd[isnan(value) ? 2 : value < 0.0]++;
}

static void accrue_one(struct accrue *sum, double value)
{
    const uint64_t hidden = UINT64_C(1) << (DBL_MANT_DIG - 1);
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    unsigned exponent = (unsigned)(bits >> (DBL_MANT_DIG - 1)) & ACCRUE_ODD;
    if (exponent == ACCRUE_ODD) {
        accrue_odd(sum, value);
        return;
    }
    uint64_t whole = (bits & (hidden - 1)) | (exponent ? hidden : 0);
    unsigned place = exponent ? exponent - 1 : 0, shift = place % ACCRUE_BITS;
    uint64_t low = (whole & accrue_mask) << shift, high = ((whole >> ACCRUE_BITS) << shift) + (low >> ACCRUE_BITS);
    long long sign = bits >> 63 ? -1 : 1, *digit = sum->numbers + place / ACCRUE_BITS;
    digit[0] += sign * (long long)(low & accrue_mask);
    digit[1] += sign * (long long)(high & accrue_mask);
    digit[2] += sign * (long long)(high >> ACCRUE_BITS);
}

void accrue_add(struct accrue *sum, size_t count, size_t step, const double *values)
{
    for (size_t i = 0; i < count; i++) accrue_one(sum, values[i * step]);
}

void accrue_settle(struct accrue *sum)
{
    const long long base = (long long)accrue_mask + 1;
    long long *digits = sum->numbers, carry = 0;
    for (int i = 0; i + 1 < ACCRUE_DIGITS; i++) {
        long long all = digits[i] + carry, rest = all % base;
        if (rest < 0) rest += base;
        carry = (all - rest) / base;
        digits[i] = rest;
    }
    digits[ACCRUE_DIGITS - 1] += carry;
}

/* The sign of a settled sum, which becomes its magnitude. */
static double accrue_sign(struct accrue *sum)
{
    if (sum->numbers[ACCRUE_DIGITS - 1] >= 0) return 1.0;
    for (int i = 0; i < ACCRUE_DIGITS; i++) sum->numbers[i] = -sum->numbers[i];
    accrue_settle(sum);
    return -1.0;
}

/* The digit, 0 below the first. */
static uint64_t accrue_digit(const struct accrue *sum, int i)
{
    return i < 0 ? 0 : (uint64_t)sum->numbers[i];
}

/* A magnitude: its first 64 bits, the last of which stands for all that follow, too, are rounded once. */
static double accrue_round(const struct accrue *sum)
{
    int top = ACCRUE_DIGITS - 1, shift = 0;
    while (top > 0 && !sum->numbers[top]) top--;
    uint64_t first = accrue_digit(sum, top) << ACCRUE_BITS | accrue_digit(sum, top - 1);
    if (!first) return 0.0;
    while (!(first << shift >> 63)) shift++;
    uint64_t next = accrue_digit(sum, top - 2) << shift, more = next & accrue_mask;
    for (int i = top - 3; i >= 0 && !more; i--) more = accrue_digit(sum, i);
    first = first << shift | next >> ACCRUE_BITS | (more > 0);
    return ldexp((double)first, ACCRUE_BITS * (top - 1) - shift + ACCRUE_LEAST);
}

double accrue_value(struct accrue *sum)
{
    const long long *odd = sum->numbers + ACCRUE_DIGITS;
    accrue_settle(sum);
    double sign = accrue_sign(sum), value = sign * accrue_round(sum);
    if (odd[2] || (odd[0] && odd[1])) return NAN;
    if (odd[0] || odd[1]) return odd[0] ? INFINITY : -INFINITY;
    return value;
}
