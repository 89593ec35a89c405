/* rusanov.c - one signal speed in both directions; see two_wave.h for several materials. */
#define CONTACT_SPEEDS wave_rusanov
#include "two_wave.h"

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "riemann",
    .name = "rusanov",
    .version = "1.0",
    .doc = "Rusanov (local Lax-Friedrichs): the most dissipative and most forgiving solver; with several "
           "materials interfaces stay sharp.",
    .cite = "Rusanov, USSR Comput. Math. Math. Phys. 1 (1961) 304-320; Toro 2009, equation 10.55",
    .table = &two_wave_table,
};
