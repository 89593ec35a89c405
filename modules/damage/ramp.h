/* ramp.h - criteria whose damage grows with a load, from a first value of it to a last one, at once. */
#ifndef RAMP_H
#define RAMP_H

#include "criterion.h"

/* Damage is 0 up to `begins` and 1 from `ends` on, at once; `ends` 0: there, too. */
struct ramp {
    double begins, per_range;
};

static inline int ramp_open(const struct bulla_host *host, const struct bulla_value *begins,
                            const struct bulla_value *ends, void **ret_self)
{
    double last = ends->number == 0.0 ? begins->number : ends->number, range = last - begins->number;
    const struct ramp ramp = {begins->number, range > 0.0 ? 1.0 / range : 1e300};
    if (!(range >= 0.0)) {
        host->fail("'ends' is below 'begins'");
        return 1;
    }
    return criterion_keep(host, &ramp, sizeof ramp, ret_self);
}

BULLA_KERNEL static void ramp_grow(const struct ramp *self, size_t n, const double *BULLA_RESTRICT load,
                                   double *BULLA_RESTRICT aim, double *BULLA_RESTRICT rate)
{
    const double begins = self->begins, per_range = self->per_range;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double part = (load[i] - begins) * per_range;
        part = part > 0.0 ? part : 0.0; /* 0 for a NaN, too */
        aim[i] = part < 1.0 ? part : 1.0;
        rate[i] = BULLA_DAMAGE_AT_ONCE;
    }
}

#endif
