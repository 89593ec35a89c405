/* sweep_pool.h - some processes at a time, out of a list, until all have run or a signal comes.
 *
 * The first SIGINT, SIGTERM, SIGUSR1 or SIGHUP stops the starting and asks all processes to stop (SIGUSR1);
 * a second one, unless it is SIGUSR1, asks again (SIGTERM), which ends a run at once. Then it waits for all of them. */
#ifndef SWEEP_POOL_H
#define SWEEP_POOL_H

#include <signal.h>
#include <sys/types.h>

struct sweep_pool {
    unsigned n_job, n_item; /* processes at a time; in all */
    void *context;
    /* Starts item `item` with these signals blocked. A failure ends the starting. */
    int (*start)(void *context, unsigned item, const sigset_t *mask, pid_t *ret_pid);
    /* Its process has ended, in the state that waitpid gives. */
    int (*ended)(void *context, unsigned item, int state);
};

/* STATUS_STOPPED after a signal; else the first failure of `start` or `ended`. No process is left. */
int sweep_pool_run(const struct sweep_pool *pool);

#endif
