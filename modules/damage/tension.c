/* tension.c - breaks where the tension reaches the strength: that of the mean stress, minus the pressure, or of the
 * largest principal stress. What spalls under plane waves is measured by it. */
#include "criterion.h"

enum { STRESS, OF };

struct tension {
    double stress;
    int principal;
};

static const struct bulla_param tension_params[] = {
    {"stress", "Pa", 1e-3, 1e13, NAN, "tension at which it breaks", BULLA_NUMBER, NULL},
    {"of", NULL, 0.0, 0.0, 0.0, "which tension: minus the pressure, or the largest principal stress", BULLA_CHOICE,
     "pressure|principal"},
    {0}};

static int tension_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    const struct tension par = {values[STRESS].number, values[OF].text && strcmp(values[OF].text, "principal") == 0};
    return criterion_keep(host, &par, sizeof par, ret_self);
}

BULLA_KERNEL static void tension_pull(double stress, size_t n, const double *BULLA_RESTRICT load,
                                      double *BULLA_RESTRICT aim, double *BULLA_RESTRICT rate)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        aim[i] = load[i] >= stress ? 1.0 : 0.0;
        rate[i] = BULLA_DAMAGE_AT_ONCE;
    }
}

static void tension_grow(const void *self, size_t n, const struct bulla_damage_state *state, double *BULLA_RESTRICT aim,
                         double *BULLA_RESTRICT rate)
{
    const struct tension *par = self;
    tension_pull(par->stress, n, par->principal ? state->principal : state->tension, aim, rate);
}

static uint32_t tension_needs(const void *self)
{
    return ((const struct tension *)self)->principal ? BULLA_DAMAGE_PRINCIPAL : BULLA_DAMAGE_TENSION;
}

static const struct bulla_damage tension_table = {.size = sizeof(struct bulla_damage),
                                                  .grow = tension_grow,
                                                  .needs = tension_needs};

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "damage",
    .name = "tension",
    .version = "1.0",
    .doc = "Breaks where the tension reaches a stress. For metals and stones under plane waves: the strength of spall "
           "depends "
           "on the rate, so take one of that rate.",
    .cite = "Rinehart, J. Appl. Phys. 22 (1951) 555-560; Antoun et al., Spall Fracture, Springer (2003)",
    .params = tension_params,
    .open = tension_open,
    .close = criterion_close,
    .table = &tension_table,
};
