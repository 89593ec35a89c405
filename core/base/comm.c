/* comm.c - see comm.h. Outside this file MPI is called by mesh/halo.c (exchange) and the
 * writers in io (file access) only. */
#include "base/comm.h"

#include "base/status.h"

#include <stdlib.h>

static bool comm_is_active;

static bool comm_launched(void)
{
    static const char *const marks[] = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK", "PMI_RANK", "SLURM_PROCID"};
    for (size_t i = 0; i < sizeof marks / sizeof *marks; i++)
        if (getenv(marks[i])) return true;
    return false;
}

void comm_init(int *argc, char ***argv)
{
    if (!comm_launched()) return;
    MPI_Init(argc, argv);
    comm_is_active = true;
}

void comm_done(void)
{
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

void comm_sum_counts(long long *values, int count)
{
    comm_reduce(values, count, MPI_LONG_LONG, MPI_SUM);
}

int comm_agree(int code)
{
    comm_reduce(&code, 1, MPI_INT, MPI_MAX);
    return code;
}

void comm_bcast(void *data, size_t bytes)
{
    if (comm_is_active) MPI_Bcast(data, (int)bytes, MPI_BYTE, 0, MPI_COMM_WORLD);
}

void comm_barrier(void)
{
    if (comm_is_active) MPI_Barrier(MPI_COMM_WORLD);
}
