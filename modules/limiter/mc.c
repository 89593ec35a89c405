/* mc.c - the mean of the two differences, at most twice the smaller one. */

static inline double mc(double less, double more)
{
    double mean = 0.5 * (less + more), twice = 2.0 * less;
    return mean < twice ? mean : twice;
}

#define LIMITER_SLOPE mc
#include "pair.h"

BULLA_EXPORT const struct bulla_module bulla_module =
    PAIR_MODULE("mc", "Monotonized central: the mean, at most twice the smaller difference. Sharp; the usual choice.",
                "van Leer, J. Comput. Phys. 23 (1977) 276-299, equation 66");
