/* minmod.c - the smaller of the two differences. */
static inline double minmod(double less, double more)
{
    (void)more;
    return less;
}

#define LIMITER_SLOPE minmod
#include "pair.h"

BULLA_EXPORT const struct bulla_module bulla_module =
    PAIR_MODULE("minmod", "Minmod: the smaller difference. The most dissipative and most robust limiter.",
                "Roe, Annu. Rev. Fluid Mech. 18 (1986) 337-365");
