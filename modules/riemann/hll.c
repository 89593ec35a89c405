/* hll.c - HLL with the signal speeds of Davis; see two_wave.h for several materials. */
#define CONTACT_SPEEDS wave_davis
#include "two_wave.h"

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "riemann",
    .name = "hll",
    .version = "1.0",
    .doc = "HLL: two signals. With one material contacts and shear are smeared; with several, interfaces stay "
           "sharp and shear is smeared. Cures odd-even decoupling along grid-aligned shocks.",
    .cite = "Harten, Lax & van Leer, SIAM Rev. 25 (1983) 35-61; Toro 2009, section 10.3",
    .table = &two_wave_table,
};
