/* writers.c - see writers.h. */
#include "io/writers.h"

#include "base/comm.h"

int writers_count(const struct scene *scene)
{
    long long n = scene->output.writers;
    if (n == 0) {
        comm_neighbours();
        n = comm_near_rank() == 0;
        comm_sum_counts(&n, 1);
    }
    return n < comm_size() ? (int)n : comm_size();
}

int writers_of(int n, int rank)
{
    return (int)((long long)rank * n / comm_size());
}

int writers_first(int n, int writer)
{
    return (int)(((long long)writer * comm_size() + n - 1) / n);
}

bool writers_here(int n)
{
    return writers_first(n, writers_of(n, comm_rank())) == comm_rank();
}
