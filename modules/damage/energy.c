/* energy.c - breaks with the elastic energy per volume, linearly between two values. */
#include "ramp.h"

enum { BEGINS, ENDS };

static const struct bulla_param energy_params[] = {
    {"begins", "J/m3", 0.0, 1e15, NAN, "elastic energy per volume at which it begins to break", BULLA_NUMBER, NULL},
    {"ends", "J/m3", 0.0, 1e15, 0.0, "where it is broken; 0: at `begins`", BULLA_NUMBER, NULL},
    {0}};

static int energy_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    return ramp_open(host, &values[BEGINS], &values[ENDS], ret_self);
}

static void energy_grow(const void *self, size_t n, const struct bulla_damage_state *state, double *BULLA_RESTRICT aim,
                        double *BULLA_RESTRICT rate)
{
    ramp_grow(self, n, state->energy, aim, rate);
}

static uint32_t energy_needs(const void *self)
{
    (void)self;
    return BULLA_DAMAGE_ENERGY;
}

static const struct bulla_damage energy_table = {.size = sizeof(struct bulla_damage),
                                                 .grow = energy_grow,
                                                 .needs = energy_needs};

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "damage",
    .name = "energy",
    .version = "1.0",
    .doc = "Breaks with the elastic energy per volume, tension or not. A fracture energy per area, as Griffith asks "
           "for, needs a length: what breaks then depends on the mesh.",
    .cite = "Griffith, Phil. Trans. R. Soc. A 221 (1921) 163-198; Volokh, J. Mech. Phys. Solids 55 (2007) 2237-2264",
    .params = energy_params,
    .open = energy_open,
    .close = criterion_close,
    .table = &energy_table,
};
