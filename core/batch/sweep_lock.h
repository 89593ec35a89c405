/* sweep_lock.h - one sweep in a directory at a time.
 *
 * DIRECTORY/sweep.lock is locked twice: for the sweep itself (fcntl, it ends with the process), and for the runs that
 * it starts (flock, they inherit it: it ends with the last of them). When a sweep is killed its runs save and stop
 * (study_child.h); the next sweep waits for that, so that two processes never write into one directory. */
#ifndef SWEEP_LOCK_H
#define SWEEP_LOCK_H

/* Takes both locks of a directory that exists, until the process ends. STATUS_CASE: another sweep is at work. */
int sweep_lock_take(const char *directory);

#endif
