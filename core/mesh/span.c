/* span.c - see span.h. Keys have 63 bits, so that no tile lies behind the end. */
#include "mesh/span.h"

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
