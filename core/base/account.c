/* account.c - see account.h. */
#include "base/account.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

enum {
    ACCOUNT_LEAST = 1126,
    ACCOUNT_BITS = 32,
    ACCOUNT_DUE = 1 << 28,
    ACCOUNT_ODD = 0x7ff,                                       /* exponent of what is no finite number */
    ACCOUNT_PLACE = ACCOUNT_LEAST + DBL_MIN_EXP - DBL_MANT_DIG /* of the last bit of the least doubles */
};

#define ACCOUNT_DIGIT 0x100000000LL

void account_carry(struct account *account)
{
    long long *digit = account->digit;
    for (int i = 0; i + 1 < ACCOUNT_DIGITS; i++) {
        long long carry = digit[i] / ACCOUNT_DIGIT;
        if (digit[i] - carry * ACCOUNT_DIGIT < 0) carry--;
        digit[i] -= carry * ACCOUNT_DIGIT;
        digit[i + 1] += carry;
    }
    account->due = 0;
}

void account_add(struct account *account, double value)
{
    const uint64_t hidden = UINT64_C(1) << (DBL_MANT_DIG - 1);
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    unsigned exponent = (unsigned)(bits >> (DBL_MANT_DIG - 1)) & ACCOUNT_ODD;
    if (exponent == ACCOUNT_ODD) {
        account->odd[isnan(value) ? 2 : value < 0.0]++;
        return;
    }
    uint64_t whole = (bits & (hidden - 1)) | (exponent ? hidden : 0);
    unsigned place = ACCOUNT_PLACE + (exponent ? exponent - 1 : 0), shift = place % ACCOUNT_BITS;
    uint64_t low = (whole % ACCOUNT_DIGIT) << shift, high = (whole / ACCOUNT_DIGIT) << shift;
    long long *digit = account->digit + place / ACCOUNT_BITS, sign = bits >> 63 ? -1 : 1;
    digit[0] += sign * (long long)(low % ACCOUNT_DIGIT);
    digit[1] += sign * (long long)(low / ACCOUNT_DIGIT + high % ACCOUNT_DIGIT);
    digit[2] += sign * (long long)(high / ACCOUNT_DIGIT);
    if (++account->due == ACCOUNT_DUE) account_carry(account);
}

/* Carried, and its magnitude in place of what is below 0. */
static bool account_turn(struct account *account)
{
    account_carry(account);
    if (account->digit[ACCOUNT_DIGITS - 1] >= 0) return false;
    for (int i = 0; i < ACCOUNT_DIGITS; i++) account->digit[i] = -account->digit[i];
    account_carry(account);
    return true;
}

/* The digit, 0 below the first. */
static uint64_t account_digit(const struct account *account, int i)
{
    return i < 0 ? 0 : (uint64_t)account->digit[i];
}

/* A magnitude: its first 64 bits, the last of which stands for all that follow, too, are rounded once. */
static double account_round(const struct account *size)
{
    int top = ACCOUNT_DIGITS - 1, shift = 0;
    while (top > 0 && !size->digit[top]) top--;
    uint64_t first = account_digit(size, top) << ACCOUNT_BITS | account_digit(size, top - 1);
    if (!first) return 0.0;
    while (!(first << shift >> 63)) shift++;
    uint64_t next = account_digit(size, top - 2) << shift, more = next % ACCOUNT_DIGIT;
    for (int i = top - 3; i >= 0 && !more; i--) more = account_digit(size, i);
    first = first << shift | next / ACCOUNT_DIGIT | (more > 0);
    return ldexp((double)first, ACCOUNT_BITS * (top - 1) - shift - ACCOUNT_LEAST);
}

double account_value(const struct account *account)
{
    const long long *odd = account->odd;
    struct account size = *account;
    bool below = account_turn(&size);
    double value = account_round(&size);
    if (odd[2] || (odd[0] && odd[1])) return NAN;
    if (odd[0] || odd[1]) return odd[0] ? INFINITY : -INFINITY;
    return below ? -value : value;
}
