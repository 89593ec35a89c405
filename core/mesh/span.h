/* span.h - the pieces into which the ranks cut the curve of a level: who answers for a key.
 *
 * A table of the first key of every rank (struct level) is all that is known of others: the owner of a tile, or of a
 * place where there is none, follows from it by bisection. A level that is not there yet is cut like the finest one
 * that is, at the first descendants of its tiles. Pure functions. */
#ifndef SPAN_H
#define SPAN_H

#include "mesh/mesh.h"

struct span {
    int size, shift;       /* ranks; digits below those of the table's keys, in bits */
    const uint64_t *first; /* [size] ascending; a rank without tiles has the key of the next that has some */
};

/* The cut of level l. */
struct span span_of(const struct mesh *mesh, int l);

/* The rank that answers for a key. */
int span_owner(const struct span *span, uint64_t key);

/* Is it this rank? */
static inline bool span_holds(const struct span *span, int rank, uint64_t key)
{
    key >>= span->shift;
    return (rank == 0 || span->first[rank] <= key) && (rank + 1 == span->size || key < span->first[rank + 1]);
}

#endif
