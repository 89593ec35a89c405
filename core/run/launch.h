/* launch.h - `-n RANKS`: the program starts itself again under mpirun.
 *
 * The parent stays: mpirun changes exit codes and ends a job that gets SIGINT or SIGTERM within
 * a second, so the parent hands the first of those to rank 0 alone as SIGUSR1, which lets the
 * ranks finish their step and save; a second signal, unless it is SIGUSR1 (stop.h), ends the
 * job at once. Rank 0's process id and exit code reach the parent through a small file named by
 * BULLA_STATUS_FILE. */
#ifndef LAUNCH_H
#define LAUNCH_H

#include <stdbool.h>

/* The command line for mpirun: NULL-terminated, free with launch_free_arguments. `argv` is the
 * program's own command line, `program` its path. */
char **launch_arguments(long ranks, bool root, const char *program, char **argv);
void launch_free_arguments(char **arguments);

/* Most ranks that are started here: some for each processor, or any number where a batch system has given more than
 * this machine. Far more would bring the machine down before one of them could say so. */
long launch_most(void);

/* In a rank: refuses a launcher that MPI does not know, and a number of ranks that is another one than it has started
 * (`wanted`; 0: any). STATUS_OK where no launcher has started this process. */
int launch_check(long wanted);

/* Runs the same command line on `ranks` ranks and returns its exit code. What the ranks could
 * not say themselves is recorded (status.h). */
int launch_run(long ranks, char **argv);

/* In a rank that is ready for signals: tells the parent, if there is one. */
void launch_announce(void);

/* In a rank: hands the exit code to the parent, if there is one; returns what the process
 * itself should return. */
int launch_report(int code);

/* Does a terminal show what this process writes to stderr (through the parent, if there is one)? */
bool launch_terminal(void);

#endif
