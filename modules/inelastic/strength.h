/* strength.h - what all strengths share: an instance is a copy of a struct of numbers. */
#ifndef STRENGTH_H
#define STRENGTH_H

#include "bulla/inelastic.h"

#include <stdlib.h>
#include <string.h>

/* Keeps a copy of `size` bytes as the instance. */
static inline int strength_keep(const struct bulla_host *host, const void *par, size_t size, void **ret_self)
{
    void *self = malloc(size);
    if (!self) {
        host->fail("out of memory");
        return 1;
    }
    *ret_self = memcpy(self, par, size);
    return 0;
}

static void strength_close(void *self)
{
    free(self);
}

#endif
