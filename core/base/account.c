/* account.c - see account.h. */
#include "base/account.h"

#include <math.h>
#include <stdbool.h>

enum { ACCOUNT_LEAST = 1126, ACCOUNT_BITS = 32, ACCOUNT_DUE = 1 << 28, ACCOUNT_SHOWN = 4 };

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
    int exponent;
    if (!isfinite(value) || value == 0.0) return;
    uint64_t whole = (uint64_t)ldexp(frexp(fabs(value), &exponent), 53);
    int place = exponent - 53 + ACCOUNT_LEAST, shift = place % ACCOUNT_BITS;
    long long *digit = account->digit + place / ACCOUNT_BITS, sign = value < 0.0 ? -1 : 1;
    uint64_t low = (whole % ACCOUNT_DIGIT) << shift, high = (whole / ACCOUNT_DIGIT) << shift;
    digit[0] += sign * (long long)(low % ACCOUNT_DIGIT);
    digit[1] += sign * (long long)(low / ACCOUNT_DIGIT + high % ACCOUNT_DIGIT);
    digit[2] += sign * (long long)(high / ACCOUNT_DIGIT);
    if (++account->due == ACCOUNT_DUE) account_carry(account);
}

double account_value(const struct account *account)
{
    struct account size = *account;
    double value = 0.0;
    int top = ACCOUNT_DIGITS - 1;
    account_carry(&size);
    bool below = size.digit[top] < 0;
    for (int i = 0; below && i < ACCOUNT_DIGITS; i++) size.digit[i] = -size.digit[i];
    account_carry(&size);
    while (top > 0 && !size.digit[top]) top--;
    for (int i = top < ACCOUNT_SHOWN ? 0 : top - ACCOUNT_SHOWN; i <= top; i++)
        value += ldexp((double)size.digit[i], ACCOUNT_BITS * i - ACCOUNT_LEAST);
    return below ? -value : value;
}
