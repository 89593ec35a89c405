/* system.h - what only some systems have: Linux first, and what stands in for it elsewhere.
 *
 * The build looks for each call (packaging/system.cmake); -DBULLA_PLAIN_SYSTEM=ON takes the stand-ins on Linux, too, so
 * that they are tested. What is lost with them: a run started by another one outlives it when that is killed; ranks of
 * a machine have large tables each for itself; provenance does not name the processor. */
#ifndef SYSTEM_H
#define SYSTEM_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

/* Notes how the program was called; first thing in main(). */
void system_begin(const char *name);

/* Absolute path of the running program; "" if it cannot be found. Valid until the end. Stand-in: the name it was called
 * by, looked for in PATH. */
const char *system_program(void);

/* Becomes the program itself once more, in the place of a child; returns only if that fails (errno). */
void system_again(char *const *arguments);

/* Of a child: it gets SIGTERM when its parent dies. Stand-in: nothing. */
void system_end_with_parent(void);

/* This process leaves no core file when it crashes. */
void system_no_core(void);

/* A file of so many bytes (zeros) without a name, for ranks of this machine; -1: errno says why. Stand-in: ENOSYS. */
int system_shared_file(size_t bytes);

/* Opens such a file of another process of this machine by its number there; -1: errno. */
int system_shared_open(pid_t process, int file);

/* Large pages for memory that is read here and there, where there are such. */
void system_large_pages(void *at, size_t bytes);

/* "INT" for SIGINT, ...; NULL if it has no name. */
const char *system_signal_name(int number);

/* What the processor calls itself; "" if nobody says. */
void system_processor(size_t room, char *ret_name);

/* Bytes that the object file gives a symbol; 0: not known. */
size_t system_symbol_size(const void *symbol);

/* Does a process of this machine hold a file or folder for itself (flock)? 1, 0; -1: nobody knows. Looks only: takes no
 * lock that could be in the way of another. Stand-in: -1. */
int system_locked(const char *path);

/* CPU time that a process of this user has taken so far [s]. Stand-in: the time on the wall. */
double system_cpu_of(pid_t process);

/* The one timer: sends `signal` when the calling thread has used so much more CPU time, once for each time that it is
 * set. false: there is none. Stand-in: none. */
bool system_timer_new(int signal);
void system_timer_set(long microseconds);
void system_timer_free(void);

#endif
