/* criterion.h - what criteria share: an instance is a copy of a struct of numbers, and many of them are a ramp. */
#ifndef CRITERION_H
#define CRITERION_H

#include "bulla/damage.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Keeps a copy of `size` bytes as the instance. */
static inline int criterion_keep(const struct bulla_host *host, const void *par, size_t size, void **ret_self)
{
    void *self = malloc(size);
    if (!self) {
        host->fail("out of memory");
        return 1;
    }
    *ret_self = memcpy(self, par, size);
    return 0;
}

static void criterion_close(void *self)
{
    free(self);
}

/* Damage is 0 up to `begins` and 1 from `ends` on, at once; `ends` 0: there, too. */
struct criterion_ramp {
    double begins, per_range;
};

static inline int criterion_ramp_open(const struct bulla_host *host, const struct bulla_value *begins,
                                      const struct bulla_value *ends, void **ret_self)
{
    double last = ends->number == 0.0 ? begins->number : ends->number, range = last - begins->number;
    const struct criterion_ramp ramp = {begins->number, range > 0.0 ? 1.0 / range : 1e300};
    if (!(range >= 0.0)) {
        host->fail("'ends' is below 'begins'");
        return 1;
    }
    return criterion_keep(host, &ramp, sizeof ramp, ret_self);
}

BULLA_KERNEL static inline void criterion_ramp_grow(const struct criterion_ramp *self, size_t n,
                                                    const double *BULLA_RESTRICT load, double *BULLA_RESTRICT aim,
                                                    double *BULLA_RESTRICT rate)
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
