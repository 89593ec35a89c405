/* whole.c - see whole.h. Two words per tile travel: its key; its rank, and what its owner alone knows. */
#include "io/whole.h"

#include "base/comm.h"
#include "base/mem.h"
#include "mesh/morton.h"

#include <string.h>

struct whole {
    struct tile *tiles[MESH_LEVELS]; /* what the lists were */
    unsigned n_known[MESH_LEVELS], first[MESH_LEVELS];
};

enum { WHOLE_WORDS = 2 };

static uint64_t *whole_pack(const struct level *level)
{
    uint64_t *words = mem_new(WHOLE_WORDS * (size_t)level->n_local, sizeof *words);
    for (unsigned i = 0; i < level->n_local; i++) {
        const struct tile *tile = &level->tiles[level->first + i];
        words[WHOLE_WORDS * i] = tile->key;
        words[WHOLE_WORDS * i + 1] = (uint64_t)tile->rank << 16 | (uint64_t)tile->unwanted << 8 | tile->covered;
    }
    return words;
}

static struct tile *whole_unpack(const uint64_t *words, unsigned n)
{
    struct tile *tiles = mem_new(n, sizeof *tiles);
    for (unsigned i = 0; i < n; i++, words += WHOLE_WORDS) {
        tiles[i] = (struct tile){.key = words[0],
                                 .rank = (int)(words[1] >> 16),
                                 .unwanted = words[1] >> 8 & 0xffu,
                                 .covered = words[1] & 0xffu};
        morton_at(words[0], tiles[i].at);
    }
    return tiles;
}

static void whole_join(struct whole *whole, struct level *level, int l)
{
    unsigned n, first = 0;
    uint64_t *own = whole_pack(level), *all = comm_join_keys(own, WHOLE_WORDS * level->n_local, &n);
    struct tile *tiles = whole_unpack(all, n / WHOLE_WORDS);
    while (level->n_local && tiles[first].rank < comm_rank()) first++;
    if (level->n_local) memcpy(tiles + first, level->tiles + level->first, level->n_local * sizeof *tiles);
    whole->tiles[l] = level->tiles;
    whole->n_known[l] = level->n_known;
    whole->first[l] = level->first;
    level->tiles = tiles;
    level->n_known = n / WHOLE_WORDS;
    level->first = first;
    mem_free(own);
    mem_free(all);
}

struct whole *whole_begin(struct mesh *mesh)
{
    if (comm_size() == 1) return NULL;
    struct whole *whole = mem_new(1, sizeof *whole);
    for (int l = 0; l < mesh->n_level; l++) whole_join(whole, &mesh->levels[l], l);
    return whole;
}

void whole_end(struct whole *whole, struct mesh *mesh)
{
    for (int l = 0; whole && l < mesh->n_level; l++) {
        struct level *level = &mesh->levels[l];
        mem_free(level->tiles);
        level->tiles = whole->tiles[l];
        level->n_known = whole->n_known[l];
        level->first = whole->first[l];
    }
    mem_free(whole);
}
