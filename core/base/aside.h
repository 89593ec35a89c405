/* aside.h - one piece of work at a time beside the main thread: what waits for disks while the run goes on.
 *
 * The work runs in a thread of its own, to which no signal is delivered. It may use memory that the main thread does
 * not touch meanwhile, files and status messages (each thread has its own); never MPI, HDF5, Lua or modules. */
#ifndef ASIDE_H
#define ASIDE_H

#include <stdbool.h>

struct aside;

/* Begins `work(data)`, which returns a status. Without `beside`, or where no thread can be made, or MPI allows none
 * beside it (comm_threads), the work is done before this returns. */
struct aside *aside_start(int (*work)(void *data), void *data, bool beside);

/* Is it still at work? NULL: no. */
bool aside_busy(const struct aside *aside);

/* Waits for its end and releases it; its status, and its message as the last recorded one. NULL: STATUS_OK. */
int aside_end(struct aside *aside);

#endif
