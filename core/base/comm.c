/* comm.c - see comm.h. Outside this file MPI is called by abort.c, swap.c, mesh/post.c (exchange) and
 * the writer of data sets (io/h5out.c) only. */
#include "base/comm.h"

#include "base/launcher.h"
#include "base/mem.h"
#include "base/status.h"

#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { COMM_LOOKS = 100 }; /* a message from a rank at work next door takes fewer */

static bool comm_is_active;
static bool comm_has_threads = true;       /* without MPI nobody minds */
static MPI_Comm comm_near = MPI_COMM_NULL; /* the ranks of this machine, once asked for */

void comm_init(int *argc, char ***argv)
{
    struct launcher here = launcher_here();
    if (!here.is_rank || here.is_mute) return;
    int given = MPI_THREAD_SINGLE;
    MPI_Init_thread(argc, argv, MPI_THREAD_FUNNELED, &given);
    comm_has_threads = given >= MPI_THREAD_FUNNELED;
    comm_is_active = true;
}

void comm_done(void)
{
    if (comm_near != MPI_COMM_NULL) MPI_Comm_free(&comm_near);
    if (comm_is_active) MPI_Finalize();
    comm_is_active = false;
}

bool comm_active(void)
{
    return comm_is_active;
}

bool comm_threads(void)
{
    return comm_has_threads;
}

int comm_rank(void)
{
    int rank = 0;
    if (comm_is_active) MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return rank;
}

int comm_size(void)
{
    int size = 1;
    if (comm_is_active) MPI_Comm_size(MPI_COMM_WORLD, &size);
    return size;
}

MPI_Comm comm_world(void)
{
    return MPI_COMM_WORLD;
}

int comm_neighbours(void)
{
    int count = 1;
    if (!comm_is_active) return count;
    if (comm_near == MPI_COMM_NULL)
        MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &comm_near);
    MPI_Comm_size(comm_near, &count);
    return count;
}

void comm_wait(int count, MPI_Request *requests, MPI_Status *ret_statuses)
{
    int done = 0;
    for (int looks = 0; !done; looks++) {
        if (looks >= COMM_LOOKS) sched_yield();
        MPI_Testall(count, requests, &done, ret_statuses);
    }
}

size_t comm_expect(int from, int tag)
{
    MPI_Status status;
    int here = 0, bytes;
    for (int looks = 0; !here; looks++) {
        if (looks >= COMM_LOOKS) sched_yield();
        MPI_Iprobe(from, tag, MPI_COMM_WORLD, &here, &status);
    }
    MPI_Get_count(&status, MPI_BYTE, &bytes);
    return (size_t)bytes;
}

static void comm_copy(void *data, size_t bytes, int source, MPI_Comm ranks)
{
    MPI_Request request;
    if (!comm_is_active) return;
    MPI_Ibcast(data, (int)bytes, MPI_BYTE, source, ranks, &request);
    comm_wait(1, &request, MPI_STATUSES_IGNORE);
}

static void comm_meet(MPI_Comm ranks)
{
    MPI_Request request;
    if (!comm_is_active) return;
    MPI_Ibarrier(ranks, &request);
    comm_wait(1, &request, MPI_STATUSES_IGNORE);
}

int comm_near_rank(void)
{
    int rank = 0;
    if (comm_is_active) MPI_Comm_rank(comm_near, &rank);
    return rank;
}

void comm_near_bcast(void *data, size_t bytes)
{
    comm_copy(data, bytes, 0, comm_near);
}

void comm_near_barrier(void)
{
    comm_meet(comm_near);
}

static void comm_reduce(void *values, int count, MPI_Datatype type, MPI_Op op)
{
    MPI_Request request;
    if (!comm_is_active) return;
    MPI_Iallreduce(MPI_IN_PLACE, values, count, type, op, MPI_COMM_WORLD, &request);
    comm_wait(1, &request, MPI_STATUSES_IGNORE);
}

void comm_min(double *values, int count)
{
    comm_reduce(values, count, MPI_DOUBLE, MPI_MIN);
}

void comm_max(double *values, int count)
{
    comm_reduce(values, count, MPI_DOUBLE, MPI_MAX);
}

int comm_first(bool here)
{
    double rank = here ? comm_rank() : comm_size();
    comm_min(&rank, 1);
    return (int)rank;
}

void comm_sum_counts(long long *values, int count)
{
    comm_reduce(values, count, MPI_LONG_LONG, MPI_SUM);
}

/* Copies the recorded message of the lowest rank with `has` to all. */
static void comm_share_message(bool has)
{
    char text[4096];
    int source = has ? comm_rank() : comm_size();
    comm_reduce(&source, 1, MPI_INT, MPI_MIN);
    snprintf(text, sizeof text, "%s", status_text());
    comm_copy(text, sizeof text, source, MPI_COMM_WORLD);
    if (source != comm_rank()) status_fail(STATUS_OK, "%s", text);
}

int comm_agree(int code)
{
    int largest = code;
    comm_reduce(&largest, 1, MPI_INT, MPI_MAX);
    if (largest) comm_share_message(code == largest);
    return largest;
}

/* How many items each rank has, and behind these counts where each rank's items start; one more for the total. */
static int *comm_counts(int count)
{
    int size = comm_size();
    int *counts = mem_new(2 * (size_t)size + 1, sizeof *counts), *starts = counts + size;
    MPI_Request request;
    counts[0] = count;
    if (comm_is_active) {
        MPI_Iallgather(&count, 1, MPI_INT, counts, 1, MPI_INT, MPI_COMM_WORLD, &request);
        comm_wait(1, &request, MPI_STATUSES_IGNORE);
    }
    for (int rank = 0; rank < size; rank++) starts[rank + 1] = starts[rank] + counts[rank];
    return counts;
}

/* The items of all ranks, in their order. */
static void comm_collect(const void *values, const int *counts, MPI_Datatype type, size_t size, void *ret_all)
{
    MPI_Request request;
    int own = counts[comm_rank()];
    if (comm_is_active) {
        MPI_Iallgatherv(values, own, type, ret_all, counts, counts + comm_size(), type, MPI_COMM_WORLD, &request);
        comm_wait(1, &request, MPI_STATUSES_IGNORE);
    } else if (own) memcpy(ret_all, values, (size_t)own * size);
}

void comm_join(const double *values, int count, double *ret_all)
{
    int *counts = comm_counts(count);
    comm_collect(values, counts, MPI_DOUBLE, sizeof *values, ret_all);
    mem_free(counts);
}

uint64_t *comm_join_keys(const uint64_t *keys, unsigned count, unsigned *ret_count)
{
    int *counts = comm_counts((int)count), *starts = counts + comm_size();
    *ret_count = (unsigned)starts[comm_size()];
    uint64_t *all = mem_new(*ret_count + 1u, sizeof *all);
    comm_collect(keys, counts, MPI_UINT64_T, sizeof *keys, all);
    mem_free(counts);
    return all;
}

void comm_join_rows(const uint64_t *keys, int count, uint64_t *ret_all)
{
    MPI_Request request;
    memcpy(ret_all, keys, (size_t)count * sizeof *keys);
    if (!comm_is_active) return;
    MPI_Iallgather(keys, count, MPI_UINT64_T, ret_all, count, MPI_UINT64_T, MPI_COMM_WORLD, &request);
    comm_wait(1, &request, MPI_STATUSES_IGNORE);
}

void comm_bcast(void *data, size_t bytes)
{
    comm_bcast_from(data, bytes, 0);
}

void comm_bcast_from(void *data, size_t bytes, int rank)
{
    comm_copy(data, bytes, rank, MPI_COMM_WORLD);
}

void comm_barrier(void)
{
    comm_meet(MPI_COMM_WORLD);
}
