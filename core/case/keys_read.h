/* keys_read.h - from a tree to values, by the tables of keys.h. */
#ifndef KEYS_READ_H
#define KEYS_READ_H

#include "case/keys.h"

/* Reads a map by its table. Mistakes are recorded; what is wrong is simply not `given`. */
struct keys_map *keys_read(struct keys *keys, struct node *node, const struct keys_section *section, const char *path);

/* Reads a list again, whose node has been given other items. */
void keys_read_again(struct keys *keys, const struct keys_map *map, const char *name);

#endif
