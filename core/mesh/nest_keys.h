/* nest_keys.h - what tile sets are made of: lists of keys that grow, and pieces of sets (nest.h, nest_share.h). */
#ifndef NEST_KEYS_H
#define NEST_KEYS_H

#include "mesh/mesh.h"

/* A growing list of Morton keys of tiles of one level. */
struct nest_keys {
    unsigned n, room;
    uint64_t *keys;
};

/* A piece of a set, or all of it. */
struct nest_set {
    unsigned n;
    struct tile *tiles; /* sorted; rank not set; `unwanted` counted on */
};

/* Adds a key. */
void nest_keys_push(struct nest_keys *keys, uint64_t key);

/* Both are empty afterwards. */
void nest_keys_free(struct nest_keys *keys);
void nest_keys_free_set(struct nest_set *set);

#endif
