/* launch.h - `-n RANKS`: the program starts itself again under mpirun.
 *
 * The parent stays: mpirun changes exit codes and ends a job that gets SIGINT or SIGTERM within
 * a second, so the parent turns the first of those into SIGUSR1, which mpirun hands on and which
 * lets the ranks finish their step and save; a second signal ends the job at once. The exit
 * code comes back through a small file named by BULLA_STATUS_FILE. */
#ifndef LAUNCH_H
#define LAUNCH_H

#include <stdbool.h>

/* The command line for mpirun: NULL-terminated, free with launch_free_arguments. `argv` is the
 * program's own command line, `program` its path. */
char **launch_arguments(long ranks, bool root, const char *program, char **argv);
void launch_free_arguments(char **arguments);

/* Runs the same command line on `ranks` ranks and returns its exit code. */
int launch_run(long ranks, char **argv);

/* In a rank: hands the exit code to the parent, if there is one; returns what the process
 * itself should return. */
int launch_report(int code);

/* Does a terminal show what this process writes to stderr (through the parent, if there is one)? */
bool launch_terminal(void);

#endif
