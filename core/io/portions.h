/* portions.h - which rank has which rows of a writer's file, of one data set: all of it only its writer knows.
 *
 * A rank tells its writer what it has and hears where that lies in the writer's file, and what others have of the
 * chunks that it has rows of itself: so memory and messages of a rank do not follow the number of ranks, but for those
 * of a writer: 16 bytes per range that is told, 32 for one that has rows. */
#ifndef PORTIONS_H
#define PORTIONS_H

#include "io/h5out.h"

#include <mpi.h>

/* Rows that one rank has. */
struct portion {
    int rank;
    size_t first, count, place; /* number in the whole data set and in the file of the writer */
};

struct portions {
    int leader;          /* the rank that writes */
    size_t total, chunk; /* rows of this writer, and of a chunk, of which there are no more */
    unsigned n;
    struct portion *list; /* by place, all with rows: a writer's all, others' as above */
};

/* Rows of this rank are `n_range` ranges, the same number on all, ascending; chunks have `chunk` rows. Collective.
 * Release with portions_free. */
void portions_take(int writers, size_t chunk, unsigned n_range, const struct h5out_range *ranges, struct portions *ret);
void portions_free(struct portions *portions);

/* Those of a writer, where one follows the other in the data set and in the file joined to one, on their way to rank 0,
 * which asks for them writer by writer, whose first rank `from` is (rank 0: its own); until portions_sent. */
struct portions_letter {
    struct portions joined;
    size_t head[2];
    MPI_Request requests[2];
};
void portions_send(const struct portions *own, struct portions_letter *ret_letter);
void portions_sent(struct portions_letter *letter);
void portions_receive(const struct portions_letter *own, int from, struct portions *ret);

#endif
