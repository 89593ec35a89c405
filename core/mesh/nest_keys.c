/* nest_keys.c - see nest_keys.h. */
#include "mesh/nest_keys.h"

#include "base/mem.h"

void nest_keys_push(struct nest_keys *keys, uint64_t key)
{
    if (keys->n == keys->room) {
        unsigned room = keys->room ? 2 * keys->room : 256;
        keys->keys = mem_grow(keys->keys, keys->room, room, sizeof *keys->keys);
        keys->room = room;
    }
    keys->keys[keys->n++] = key;
}

void nest_keys_free(struct nest_keys *keys)
{
    mem_free(keys->keys);
    *keys = (struct nest_keys){0};
}

void nest_keys_free_set(struct nest_set *set)
{
    mem_free(set->tiles);
    *set = (struct nest_set){0};
}
