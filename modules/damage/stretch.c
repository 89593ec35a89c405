/* stretch.c - breaks with the largest principal elastic stretch, linearly between two values. */
#include "ramp.h"

enum { BEGINS, ENDS };

static const struct bulla_param stretch_params[] = {
    {"begins", "1", 1.0, 1e3, NAN, "largest principal stretch at which it begins to break", BULLA_NUMBER, NULL},
    {"ends", "1", 0.0, 1e3, 0.0, "where it is broken; 0: at `begins`", BULLA_NUMBER, NULL},
    {0}};

/* exp of the true strain at rupture; slow tests, up to 1 1/s. */
static const struct bulla_preset stretch_presets[] = {{"liver", "liver, 0.38", (const double[]){1.46, 0.0}},
                                                      {"gall-bladder", "gall bladder, 0.43",
                                                       (const double[]){1.54, 0.0}},
                                                      {"hepatic-artery", "hepatic artery, 0.63",
                                                       (const double[]){1.88, 0.0}},
                                                      {"stomach", "stomach, 0.66", (const double[]){1.93, 0.0}},
                                                      {0}};

static int stretch_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    return ramp_open(host, &values[BEGINS], &values[ENDS], ret_self);
}

static void stretch_grow(const void *self, size_t n, const struct bulla_damage_state *state, double *BULLA_RESTRICT aim,
                         double *BULLA_RESTRICT rate)
{
    ramp_grow(self, n, state->stretch, aim, rate);
}

static uint32_t stretch_needs(const void *self)
{
    (void)self;
    return BULLA_DAMAGE_STRETCH;
}

static const struct bulla_damage stretch_table = {.size = sizeof(struct bulla_damage),
                                                  .grow = stretch_grow,
                                                  .needs = stretch_needs};

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "damage",
    .name = "stretch",
    .version = "1.0",
    .doc = "Breaks with the largest principal stretch. For tissue and gels, whose rupture is measured as one.",
    .cite = "Mancia, Vlaisavljevich, Yousefi, Rodriguez, Ziemlewicz, Lee, Henann, Franck, Xu & Johnsen, Phys. Med. "
            "Biol. 64 (2019) 225001, table 1",
    .params = stretch_params,
    .presets = stretch_presets,
    .open = stretch_open,
    .close = criterion_close,
    .table = &stretch_table,
};
