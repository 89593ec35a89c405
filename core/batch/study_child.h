/* study_child.h - one run as a process of its own: a crash ends a row of a study, not the study. */
#ifndef STUDY_CHILD_H
#define STUDY_CHILD_H

#include <signal.h>
#include <stdbool.h>
#include <sys/types.h>

struct study_child {
    const char *path, *directory; /* the case, its output */
    const char *log;              /* file for what the run says */
    const char *ranks, *variant;  /* for -n, --variant; or NULL */
    char *const *sets;            /* NULL-terminated, for --set */
    bool restart;                 /* goes on from the newest checkpoint; else replaces what is there */
    const sigset_t *mask;         /* signals that the run blocks; NULL: as this process */
};

/* Starts `bulla run` with this program itself. It has a process group of its own, so that the terminal's Ctrl-C
 * reaches this process alone, and is asked to stop (SIGTERM) when this process dies. STATUS_RUN if there
 * is no process to be had. */
int study_child_start(const struct study_child *child, pid_t *ret_pid);

/* The exit code of a run from the state that waitpid gives: STATUS_RUN for one that was killed. */
int study_child_code(int state);

#endif
