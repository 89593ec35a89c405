/* sweep_lock.c - see sweep_lock.h. */
#include "batch/sweep_lock.h"

#include "base/log.h"
#include "base/mem.h"
#include "base/status.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/file.h>
#include <time.h>
#include <unistd.h>

enum { SWEEP_LOCK_TRIES = 1200 }; /* of 50 ms: the step that a run must finish may be a long one */

static int sweep_lock_owner(int file, const char *path)
{
    struct flock lock = {.l_type = F_WRLCK, .l_whence = SEEK_SET}, holder = lock;
    if (!fcntl(file, F_SETLK, &lock)) return STATUS_OK;
    if (errno != EACCES && errno != EAGAIN) return status_fail(STATUS_RUN, "cannot lock %s: %s", path, strerror(errno));
    long pid = !fcntl(file, F_GETLK, &holder) && holder.l_type != F_UNLCK ? (long)holder.l_pid : 0;
    return status_fail(STATUS_CASE, "another sweep (process %ld) is at work here: it has locked %s", pid, path);
}

static int sweep_lock_runs(int file, const char *path)
{
    static const struct timespec soon = {.tv_nsec = 50000000};
    for (int tries = 0; flock(file, LOCK_EX | LOCK_NB); tries++) {
        if (errno != EWOULDBLOCK && errno != EINTR)
            return status_fail(STATUS_RUN, "cannot lock %s: %s", path, strerror(errno));
        if (tries == 0) log_note("waiting for the runs of a sweep that was killed to save and stop");
        if (tries == SWEEP_LOCK_TRIES)
            return status_fail(STATUS_RUN, "runs of a sweep that was killed are still at work: they hold %s", path);
        nanosleep(&soon, NULL);
    }
    return STATUS_OK;
}

int sweep_lock_take(const char *directory)
{
    char *path = mem_print("%s/sweep.lock", directory);
    int file = open(path, O_RDWR | O_CREAT, 0644);
    int code = file < 0 ? status_fail(STATUS_RUN, "cannot write %s: %s", path, strerror(errno)) : STATUS_OK;
    if (!code) code = sweep_lock_owner(file, path);
    if (!code) code = sweep_lock_runs(file, path);
    if (code && file >= 0) close(file);
    mem_free(path);
    return code;
}
