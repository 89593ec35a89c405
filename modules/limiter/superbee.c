/* superbee.c - the larger difference, at most twice the smaller one. */
#include <math.h>

static inline double superbee(double less, double more)
{
    double twice = 2.0 * less;
    return twice < more ? twice : more;
}

#define LIMITER_SLOPE superbee
#include "pair.h"

BULLA_EXPORT const struct bulla_module bulla_module =
    PAIR_MODULE("superbee",
                "Superbee: the steepest slope that stays monotone. Sharpens contacts, squares off smooth waves.",
                "Roe, Annu. Rev. Fluid Mech. 18 (1986) 337-365");
