/* van_albada.c - a b (a + b)/(a^2 + b^2), differentiable. */
static inline double van_albada(double less, double more)
{
    double r = less / more;
    return less * (1.0 + r) / (1.0 + r * r);
}

#define LIMITER_SLOPE van_albada
#include "pair.h"

BULLA_EXPORT const struct bulla_module bulla_module =
    PAIR_MODULE("van-albada", "Van Albada: a differentiable mean; a little more dissipative than van Leer.",
                "van Albada, van Leer & Roberts, Astron. Astrophys. 108 (1982) 76-84, equation 2.12");
