/* nest_family.h - sets of tiles of one level, family by family.
 *
 * A family is the tiles under one tile of the next coarser level: its key is that tile's, and a mask tells which of
 * its 2^d octants belong to the set. Families keep lists of needs short: what one asks for is a subset of 3^d tiles,
 * but of 2^d families, most of which its neighbours on the curve ask for, too. Used by nest.c alone. */
#ifndef NEST_FAMILY_H
#define NEST_FAMILY_H

#include "mesh/mesh.h"

enum { NEST_FAMILY_AROUND = 27, NEST_FAMILY_SELF = 13, NEST_FAMILY_RECENT = 512 };

struct nest_family {
    uint64_t key;
    uint32_t mask;
};

/* A growing list; sorted and without repetition after nest_family_sort. Start from {0}. */
struct nest_families {
    unsigned n, room;
    struct nest_family *list;
    unsigned recent[NEST_FAMILY_RECENT]; /* 1 + index of one that was added lately, by hash of its key */
};

/* The key of a place on a level; false if that is outside the domain. Periodic axes wrap. */
bool nest_family_place(const struct mesh *mesh, const struct level *level, const int at[3], uint64_t *ret_key);

/* Adds octants `mask` of a family. */
void nest_family_add(struct nest_families *families, uint64_t key, uint32_t mask);

/* Adds one tile. */
void nest_family_add_tile(struct nest_families *families, uint64_t key);

/* Adds what `tiles` (sorted) of level l need on level l - 1 to nest. */
void nest_family_needs(const struct mesh *mesh, int l, const struct tile *tiles, unsigned n,
                       struct nest_families *families);

/* Sorts by key and joins the masks of equal ones. */
void nest_family_sort(struct nest_families *families);

/* The keys of all tiles, in order: a new array (mem_free) of *ret_n. */
uint64_t *nest_family_keys(const struct nest_families *families, unsigned *ret_n);

void nest_family_free(struct nest_families *families);

#endif
