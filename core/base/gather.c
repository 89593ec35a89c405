/* gather.c - see gather.h. In round k, of two pieces of 2^k ranks beside each other the upper one goes to the lower
 * one. */
#include "base/gather.h"

#include "base/comm.h"
#include "base/mem.h"

#include <string.h>

enum { GATHER_TAG = 910, GATHER_SUMS = 911, GATHER_DOUBLINGS = 31 };

static void gather_send(const void *items, size_t bytes, int to, int tag)
{
    MPI_Request request;
    MPI_Isend(items, (int)bytes, MPI_BYTE, to, tag, comm_world(), &request);
    comm_wait(1, &request, MPI_STATUSES_IGNORE);
}

static void gather_receive(void *items, size_t bytes, int from, int tag)
{
    MPI_Request request;
    MPI_Irecv(items, (int)bytes, MPI_BYTE, from, tag, comm_world(), &request);
    comm_wait(1, &request, MPI_STATUSES_IGNORE);
}

/* Appends what a rank has: the new bytes. */
static size_t gather_take(char **items, size_t bytes, int from)
{
    size_t more = comm_expect(from, GATHER_TAG);
    *items = mem_grow(*items, bytes, bytes + more, 1);
    gather_receive(*items + bytes, more, from, GATHER_TAG);
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
            gather_send(all, bytes, rank - step, GATHER_TAG);
            mem_free(all);
            *ret_n = 0;
            return NULL;
        }
        if (rank + step < ranks) bytes = gather_take(&all, bytes, rank + step);
    }
    *ret_n = (unsigned)(bytes / size);
    return all;
}

/* To the lower of two pieces: ret_lower[k] keeps what it had before round k. Returns the step at which this rank's
 * piece is the upper one, or no rank is above it. */
static int gather_up(long long *values, int count, long long *ret_lower)
{
    int rank = comm_rank(), step = 1;
    size_t bytes = (size_t)count * sizeof *values;
    long long *part = mem_new((size_t)count, sizeof *part);
    for (; step < comm_size() && !(rank & step); step *= 2, ret_lower += count) {
        memcpy(ret_lower, values, bytes);
        if (rank + step >= comm_size()) continue;
        gather_receive(part, bytes, rank + step, GATHER_SUMS);
        for (int i = 0; i < count; i++) values[i] += part[i];
    }
    mem_free(part);
    return step;
}

void gather_sums(long long *values, int count, long long *ret_before)
{
    int rank = comm_rank();
    size_t n = (size_t)count, bytes = n * sizeof *values;
    long long *lower = mem_new(GATHER_DOUBLINGS * n, sizeof *lower);
    long long *told = mem_new(2 * n, sizeof *told), *down = mem_new(2 * n, sizeof *down); /* before a piece; of all */
    int step = gather_up(values, count, lower);
    if (rank) {
        gather_send(values, bytes, rank - step, GATHER_SUMS);
        gather_receive(told, 2 * bytes, rank - step, GATHER_SUMS);
    } else memcpy(told + n, values, bytes);
    memcpy(down + n, told + n, bytes);
    for (int half = step / 2; half; half /= 2) {
        if (rank + half >= comm_size()) continue;
        for (size_t i = 0; i < n; i++) down[i] = told[i] + lower[(size_t)__builtin_ctz((unsigned)half) * n + i];
        gather_send(down, 2 * bytes, rank + half, GATHER_SUMS);
    }
    memcpy(ret_before, told, bytes);
    memcpy(values, told + n, bytes);
    mem_free(lower);
    mem_free(told);
    mem_free(down);
}
