/* strain.c - breaks with the accumulated plastic strain, linearly between two values. */
#include "ramp.h"

enum { BEGINS, ENDS };

static const struct bulla_param strain_params[] = {{"begins", "1", 0.0, 1e3, NAN,
                                                    "plastic strain at which it begins to break", BULLA_NUMBER, NULL},
                                                   {"ends", "1", 0.0, 1e3, 0.0, "where it is broken; 0: at `begins`",
                                                    BULLA_NUMBER, NULL},
                                                   {0}};

static int strain_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    return ramp_open(host, &values[BEGINS], &values[ENDS], ret_self);
}

static void strain_grow(const void *self, size_t n, const struct bulla_damage_state *state, double *BULLA_RESTRICT aim,
                        double *BULLA_RESTRICT rate)
{
    ramp_grow(self, n, state->strain, aim, rate);
}

static uint32_t strain_needs(const void *self)
{
    (void)self;
    return BULLA_DAMAGE_STRAIN;
}

static const struct bulla_damage strain_table = {.size = sizeof(struct bulla_damage),
                                                 .grow = strain_grow,
                                                 .needs = strain_needs};

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "damage",
    .name = "strain",
    .version = "1.0",
    .doc = "Breaks with the plastic strain, whatever the stress is. For ductile solids; johnson-cook also asks for the "
           "stress.",
    .cite = "Johnson & Cook, Eng. Fract. Mech. 21 (1985) 31-48, with D2 to D5 = 0",
    .params = strain_params,
    .open = strain_open,
    .close = criterion_close,
    .table = &strain_table,
};
