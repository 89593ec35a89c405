/* hlld.c - HLLC with the shear waves of solids (shear.h), signal speeds of Davis. Faces of fluids are those of
 * hllc.c. */
#define CONTACT_SPEEDS wave_davis
#define CONTACT_SHEAR 0
#define CONTACT_SLOW 1
#include "contact.h"

static void hlld_solve(const void *self, const struct bulla_faces *faces)
{
    (void)self;
    contact_solve(faces);
}

static const struct bulla_riemann hlld_table = {.size = sizeof(struct bulla_riemann), .solve = hlld_solve, .solids = 1};

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "riemann",
    .name = "hlld",
    .version = "1.0",
    .doc = "HLLD: two fast signals, two shear waves and the contact, for solids; fluids slip on solids. Where both "
           "sides are fluids it is hllc, bitwise.",
    .cite = "Barton, J. Comput. Phys. 390 (2019) 25-50; Miyoshi & Kusano, J. Comput. Phys. 208 (2005) 315-344",
    .table = &hlld_table,
};
