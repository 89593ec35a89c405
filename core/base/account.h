/* account.h - sums of numbers that come in any order and in any pieces: the same bits, whoever adds what, and when.
 *
 * What is added goes, without rounding, into a fixed-point number that is wide enough for every double (Kulisch,
 * Advanced arithmetic for the digital computer, Springer 2002): whole numbers know no order. Only the value is rounded,
 * once and to the nearest. Ranks keep accounts of their own and add them up where the sum is looked at; a run that is
 * ended and goes on has the same sum, too. */
#ifndef ACCOUNT_H
#define ACCOUNT_H

#include <stdint.h>

/* Digits of 32 bits: from 2^-1126 to above the sum of 2^30 of the largest doubles. */
enum { ACCOUNT_DIGITS = 70 };

/* Start from {0}. */
struct account {
    long long digit[ACCOUNT_DIGITS]; /* the least first; carries may be due */
    long long odd[3];                /* how many were infinite, minus infinite, no numbers */
    long long due;                   /* numbers added since the last carry */
};

/* All of an account, from its first digit on. */
enum { ACCOUNT_NUMBERS = sizeof(struct account) / sizeof(long long) };

void account_add(struct account *account, double value);

/* Carries: then 0 <= digit < 2^32, but for the last one, which has the sign. Accounts are added number by number. */
void account_carry(struct account *account);

/* The sum, rounded; infinite beyond doubles, NaN of NaN or of both infinities. */
double account_value(const struct account *account);

#endif
