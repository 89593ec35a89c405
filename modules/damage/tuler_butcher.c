/* tuler_butcher.c - D is the integral of ((tension - threshold)/stress)^exponent dt/time: what a tension does takes
 * time, and a short one may be higher. */
#include "criterion.h"

enum { THRESHOLD, STRESS, EXPONENT, TIME, OF };

struct tuler_butcher {
    double threshold, stress, exponent, time;
    int principal;
};

static const struct bulla_param tuler_butcher_params[] = {
    {"threshold", "Pa", 0.0, 1e13, NAN, "tension below which nothing breaks, however long it lasts", BULLA_NUMBER,
     NULL},
    {"stress", "Pa", 1e-3, 1e13, NAN, "tension beyond the threshold that breaks it in `duration`", BULLA_NUMBER, NULL},
    {"exponent", "1", 0.1, 20.0, 2.0, "how much more a higher tension does", BULLA_NUMBER, NULL},
    {"duration", "s", 1e-15, 1e15, NAN, "how long the threshold plus `stress` is borne", BULLA_NUMBER, NULL},
    {"of", NULL, 0.0, 0.0, 0.0, "which tension: minus the pressure, or the largest principal stress", BULLA_CHOICE,
     "pressure|principal"},
    {0}};

static int tuler_butcher_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    const struct tuler_butcher par = {values[THRESHOLD].number, values[STRESS].number, values[EXPONENT].number,
                                      values[TIME].number,
                                      values[OF].text && strcmp(values[OF].text, "principal") == 0};
    return criterion_keep(host, &par, sizeof par, ret_self);
}

static void tuler_butcher_grow(const void *self, size_t n, const struct bulla_damage_state *state,
                               double *BULLA_RESTRICT aim, double *BULLA_RESTRICT rate)
{
    const struct tuler_butcher *par = self;
    const double *load = par->principal ? state->principal : state->tension;
    for (size_t i = 0; i < n; i++) {
        double over = (load[i] - par->threshold) / par->stress,
               r = over > 0.0 ? pow(over, par->exponent) / par->time : 0.0;
        aim[i] = 1.0;
        rate[i] = r < BULLA_DAMAGE_AT_ONCE ? r : BULLA_DAMAGE_AT_ONCE;
    }
}

static uint32_t tuler_butcher_needs(const void *self)
{
    return ((const struct tuler_butcher *)self)->principal ? BULLA_DAMAGE_PRINCIPAL : BULLA_DAMAGE_TENSION;
}

static const struct bulla_damage tuler_butcher_table = {.size = sizeof(struct bulla_damage),
                                                        .grow = tuler_butcher_grow,
                                                        .needs = tuler_butcher_needs};

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "damage",
    .name = "tuler-butcher",
    .version = "1.0",
    .doc = "Breaks by the integral of the tension beyond a threshold to a power. For spall by pulses of different "
           "lengths, and "
           "for stones under many of them.",
    .cite = "Tuler & Butcher, Int. J. Fract. Mech. 4 (1968) 431-437",
    .params = tuler_butcher_params,
    .open = tuler_butcher_open,
    .close = criterion_close,
    .table = &tuler_butcher_table,
};
