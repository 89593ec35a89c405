/* instance.h - a module opened with values: what a scene refers to and kernels call. */
#ifndef INSTANCE_H
#define INSTANCE_H

#include "bulla/module.h"

struct instance {
    const struct bulla_module *module;
    struct bulla_value *values; /* one per row of the module's parameter table; owned */
    void *self;                 /* what the module's `open` returned */
    struct block_use *blocks;   /* those that it has in common with others (plug/block.h); owned */
};

/* Number of rows of a module's parameter table. */
unsigned instance_param_count(const struct bulla_module *module);

/* Row of the parameter `name`, or -1. */
int instance_param_find(const struct bulla_module *module, const char *name);

/* Opens `module` with `values` (copied, texts too). On failure STATUS_CASE with the module's reason. Between
 * block_together calls all ranks open the same modules in the same order. */
int instance_open(const struct bulla_module *module, const struct bulla_value *values, struct instance *ret_instance);

/* Closes; a zeroed instance is fine. */
void instance_done(struct instance *instance);

#endif
