/* comm.c - see comm.h. Outside this file MPI is called by mesh/post.c (exchange) and the
 * writer of data sets (io/h5out.c) only. */
#include "base/comm.h"

#include "base/launcher.h"
#include "base/mem.h"
#include "base/status.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool comm_is_active;
static MPI_Comm comm_near = MPI_COMM_NULL; /* the ranks of this machine, once asked for */

void comm_init(int *argc, char ***argv)
{
    struct launcher here = launcher_here();
    if (!here.is_rank || here.is_mute) return;
    MPI_Init(argc, argv);
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

int comm_near_rank(void)
{
    int rank = 0;
    if (comm_is_active) MPI_Comm_rank(comm_near, &rank);
    return rank;
}

void comm_near_bcast(void *data, size_t bytes)
{
    if (comm_is_active) MPI_Bcast(data, (int)bytes, MPI_BYTE, 0, comm_near);
}

void comm_near_barrier(void)
{
    if (comm_is_active) MPI_Barrier(comm_near);
}

void comm_abort(int code)
{
    if (comm_is_active && comm_size() > 1) MPI_Abort(MPI_COMM_WORLD, code);
    exit(code);
}

static void comm_reduce(void *values, int count, MPI_Datatype type, MPI_Op op)
{
    if (comm_is_active) MPI_Allreduce(MPI_IN_PLACE, values, count, type, op, MPI_COMM_WORLD);
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
    if (comm_is_active) MPI_Bcast(text, (int)sizeof text, MPI_CHAR, source, MPI_COMM_WORLD);
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
    if (comm_is_active) MPI_Allgather(&count, 1, MPI_INT, counts, 1, MPI_INT, MPI_COMM_WORLD);
    else counts[0] = count;
    for (int rank = 0; rank < size; rank++) starts[rank + 1] = starts[rank] + counts[rank];
    return counts;
}

void comm_join(const double *values, int count, double *ret_all)
{
    if (!comm_is_active) {
        memcpy(ret_all, values, (size_t)count * sizeof *values);
        return;
    }
    int *counts = comm_counts(count), *starts = counts + comm_size();
    MPI_Allgatherv(values, count, MPI_DOUBLE, ret_all, counts, starts, MPI_DOUBLE, MPI_COMM_WORLD);
    mem_free(counts);
}

uint64_t *comm_join_keys(const uint64_t *keys, unsigned count, unsigned *ret_count)
{
    int *counts = comm_counts((int)count), *starts = counts + comm_size();
    *ret_count = (unsigned)starts[comm_size()];
    uint64_t *all = mem_new(*ret_count + 1u, sizeof *all);
    if (comm_is_active)
        MPI_Allgatherv(keys, (int)count, MPI_UINT64_T, all, counts, starts, MPI_UINT64_T, MPI_COMM_WORLD);
    else if (count) memcpy(all, keys, count * sizeof *keys);
    mem_free(counts);
    return all;
}

void comm_bcast(void *data, size_t bytes)
{
    if (comm_is_active) MPI_Bcast(data, (int)bytes, MPI_BYTE, 0, MPI_COMM_WORLD);
}

void comm_barrier(void)
{
    if (comm_is_active) MPI_Barrier(MPI_COMM_WORLD);
}
