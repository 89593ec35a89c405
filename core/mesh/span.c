/* span.c - see span.h. Keys have 63 bits, so that no tile lies behind the end. */
#include "mesh/span.h"

#include "base/mem.h"

struct span span_of(const struct mesh *mesh, int l)
{
    int m = l < mesh->n_level ? l : mesh->n_level - 1;
    return (struct span){mesh->levels[m].n_rank, 3 * (l - m), mesh->levels[m].first_keys};
}

int span_owner(const struct span *span, uint64_t key)
{
    int low = 0, high = span->size;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (span->first[middle] <= key >> span->shift) low = middle;
        else high = middle;
    }
    return low;
}

uint64_t *span_first(const struct tile *tiles, unsigned n_tile, int size)
{
    uint64_t *first = mem_new((size_t)size, sizeof *first);
    unsigned i = n_tile;
    for (int rank = size - 1; rank >= 0; rank--) {
        unsigned low = 0, high = i; /* the first tile of this rank or a higher one */
        while (low < high) {
            unsigned middle = low + (high - low) / 2;
            if (tiles[middle].rank < rank) low = middle + 1;
            else high = middle;
        }
        i = low;
        first[rank] = i < n_tile ? tiles[i].key : UINT64_MAX;
    }
    return first;
}
