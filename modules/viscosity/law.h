/* law.h - what all viscosity laws share: the instance is a copy of numbers. */
#ifndef LAW_H
#define LAW_H

#include "bulla/viscosity.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Row of the parameter table for a bulk viscosity in its own right. */
#define LAW_ZETA                                                                                                   \
    {                                                                                                              \
        "zeta", "Pa s", 0.0, 1e9, 0.0, "bulk viscosity: what resists a change of volume alone", BULLA_NUMBER, NULL \
    }

/* And for one that follows mu. */
#define LAW_ZETA_RATIO                                                                                                \
    {                                                                                                                 \
        "zeta-ratio", "1", 0.0, 1e6, 0.0, "bulk viscosity over shear viscosity, which it follows", BULLA_NUMBER, NULL \
    }

/* Keeps a copy of `size` bytes as the instance. */
static inline int law_keep(const struct bulla_host *host, const void *par, size_t size, void **ret_self)
{
    void *self = malloc(size);
    if (!self) {
        host->fail("out of memory");
        return 1;
    }
    *ret_self = memcpy(self, par, size);
    return 0;
}

/* n times the same number. */
static inline void law_fill(size_t n, double number, double *BULLA_RESTRICT value)
{
    for (size_t i = 0; i < n; i++) value[i] = number;
}

#endif
