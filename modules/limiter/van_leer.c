/* van_leer.c - the harmonic mean 2 a b/(a + b). */
static inline double van_leer(double less, double more)
{
    return 2.0 * less / (1.0 + less / more);
}

#define LIMITER_SLOPE van_leer
#include "pair.h"

BULLA_EXPORT const struct bulla_module bulla_module =
    PAIR_MODULE("van-leer", "Van Leer: harmonic mean of the differences. Smooth, a good middle way.",
                "van Leer, J. Comput. Phys. 14 (1974) 361-370, equation 61");
