/* criterion.h - what criteria share: an instance is a copy of a struct of numbers. Many of them are a ramp (ramp.h). */
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

#endif
