/* gather.c - see gather.h. In round k, of two pieces of 2^k ranks beside each other the upper one goes to the lower
 * one, its length first. */
#include "base/gather.h"

#include "base/comm.h"
#include "base/mem.h"

#include <string.h>

enum { GATHER_TAG = 910 };

static void gather_send(const char *items, size_t bytes, int to)
{
    MPI_Request sends[2];
    MPI_Isend(&bytes, sizeof bytes, MPI_BYTE, to, GATHER_TAG, comm_world(), &sends[0]);
    MPI_Isend(items, (int)bytes, MPI_BYTE, to, GATHER_TAG, comm_world(), &sends[1]);
    comm_wait(2, sends, MPI_STATUSES_IGNORE);
}

/* Appends what a rank has: the new bytes. */
static size_t gather_take(char **items, size_t bytes, int from)
{
    MPI_Request request;
    size_t more = 0;
    MPI_Irecv(&more, sizeof more, MPI_BYTE, from, GATHER_TAG, comm_world(), &request);
    comm_wait(1, &request, MPI_STATUSES_IGNORE);
    *items = mem_grow(*items, bytes, bytes + more, 1);
    MPI_Irecv(*items + bytes, (int)more, MPI_BYTE, from, GATHER_TAG, comm_world(), &request);
    comm_wait(1, &request, MPI_STATUSES_IGNORE);
    return bytes + more;
}

void *gather_items(const void *items, size_t size, unsigned n, unsigned *ret_n)
{
    int rank = comm_rank(), ranks = comm_size();
    size_t bytes = n * size;
    char *all = mem_new(bytes, 1);
    if (bytes) memcpy(all, items, bytes);
    for (int step = 1; step < ranks; step *= 2) {
        if (rank & step) {
            gather_send(all, bytes, rank - step);
            mem_free(all);
            *ret_n = 0;
            return NULL;
        }
        if (rank + step < ranks) bytes = gather_take(&all, bytes, rank + step);
    }
    *ret_n = (unsigned)(bytes / size);
    return all;
}
