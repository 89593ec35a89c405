/* hllc.c - HLLC with the signal speeds of Davis: contacts, shear of fluids and material interfaces stay
 * sharp. In solids shear is smeared by the fast waves: hlld.c. */
#define CONTACT_SPEEDS wave_davis
#define CONTACT_SHEAR 0
#define CONTACT_SLOW 0
#include "contact.h"

static void hllc_solve(const void *self, const struct bulla_faces *faces)
{
    (void)self;
    contact_solve(faces);
}

static const struct bulla_riemann hllc_table = {.size = sizeof(struct bulla_riemann), .solve = hllc_solve, .solids = 1};

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "riemann",
    .name = "hllc",
    .version = "1.0",
    .doc = "HLLC: two signals and the contact. The default; keeps material interfaces at rest exactly.",
    .cite = "Toro, Spruce & Speares, Shock Waves 4 (1994) 25-34; Toro 2009, section 10.4",
    .table = &hllc_table,
};
