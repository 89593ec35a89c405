/* launcher.h - who has started this process: an MPI launcher, the shell of a batch job, or nobody in particular.
 *
 * A queue sets variables in the script of a job as well as in the ranks that its launcher starts (Slurm's SLURM_PROCID
 * is 0 in both), so that no single variable tells a rank from a shell. What tells them is one table, in launcher.c. */
#ifndef LAUNCHER_H
#define LAUNCHER_H

#include <stdbool.h>

struct launcher {
    const char *name; /* of the launcher or the queue, to be read; NULL: none, as on a laptop */
    bool is_rank;     /* this process is a rank; else, where there is a name, it is in a batch job's shell */
    long size;        /* the ranks that were started; 0: not known, or no rank */
    bool is_mute;     /* srun has started it and gives it no PMI: ranks cannot find each other, and MPI must not try */
};

/* What an environment (as `environ`: NAME=VALUE, NULL-terminated) says. */
struct launcher launcher_find(char *const *environment);

/* What that of this process says. */
struct launcher launcher_here(void);

#endif
