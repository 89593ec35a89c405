/* abort.c - see abort.h. Stands below everything that may give up, so it asks MPI itself what there is to end. */
#include "base/abort.h"

#include <mpi.h>
#include <stdlib.h>

void abort_all(int code)
{
    int begun = 0, ended = 0, size = 1;
    MPI_Initialized(&begun);
    MPI_Finalized(&ended);
    if (begun && !ended) MPI_Comm_size(MPI_COMM_WORLD, &size);
    if (size > 1) MPI_Abort(MPI_COMM_WORLD, code);
    exit(code);
}
