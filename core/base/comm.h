/* comm.h - the ranks of a run: MPI, or none.
 *
 * A process that was not started by an MPI launcher never initialises MPI (that alone costs
 * more than many 1D cases); it is then rank 0 of 1 and every call here is a no-op or a copy.
 * A rank that waits lets others have the processor (comm_wait), whatever the MPI and whoever started it.
 * Reductions are minima, maxima and integer sums only, or collect per-item values: sums of
 * doubles in an order that depends on the ranks would break the bitwise contract. */
#ifndef COMM_H
#define COMM_H

#include <mpi.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Initialises MPI if a launcher has started this process as a rank (launcher.h). Ends with comm_done. */
void comm_init(int *argc, char ***argv);
void comm_done(void);

/* True when MPI is initialised. */
bool comm_active(void);

/* May there be threads beside the main one, which alone calls what is declared here (MPI_THREAD_FUNNELED)? */
bool comm_threads(void);
int comm_rank(void);
int comm_size(void);
MPI_Comm comm_world(void);

/* Ranks on this machine, with this one. Collective. */
int comm_neighbours(void);

/* Among these: which one this is, from 0; a copy from number 0 to all of them; a meeting. Collective on the machine,
 * after comm_neighbours. */
int comm_near_rank(void);
void comm_near_bcast(void *data, size_t bytes);
void comm_near_barrier(void);

/* Until these requests are done (persistent ones are ready for the next start); statuses as for MPI_Waitall. Between
 * looks the processor is for whoever wants it: MPICH, and Open MPI under srun, would keep it, and where ranks or their
 * neighbours are more than the processors, each wait would last until the system takes it away. */
void comm_wait(int count, MPI_Request *requests, MPI_Status *ret_statuses);

/* Waits alike until a message from a rank is there to be received: its bytes. */
size_t comm_expect(int from, int tag);

/* In place, over all ranks. */
void comm_min(double *values, int count);
void comm_max(double *values, int count);
void comm_sum_counts(long long *values, int count);

/* The first rank on which `here` is true; comm_size() where there is none. */
int comm_first(bool here);

/* The largest code of all ranks: a failure on one is a failure on all. The recorded message
 * (status.h) of the first rank that has this code becomes everybody's. */
int comm_agree(int code);

/* Joins the `count` values of each rank, in rank order, into `ret_all` on every rank. */
void comm_join(const double *values, int count, double *ret_all);

/* The same for 64-bit keys, whose number only their own rank knows: a new array (free with mem_free) of
 * *ret_count keys, in rank order. */
uint64_t *comm_join_keys(const uint64_t *keys, unsigned count, unsigned *ret_count);

/* The same number of keys of each rank: ret_all[ranks * count]. */
void comm_join_rows(const uint64_t *keys, int count, uint64_t *ret_all);

/* From rank 0, or another one, to all. */
void comm_bcast(void *data, size_t bytes);
void comm_bcast_from(void *data, size_t bytes, int rank);

void comm_barrier(void);

#endif
