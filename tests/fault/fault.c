/* fault.c - a preloaded library that lets one file call fail, for program/checkpoint_faults.sh.
 *
 * BULLA_FAULT="N WHAT": the Nth call that writes, syncs, renames or closes something in a folder named checkpoints
 * (or reads it back while it is written) does WHAT: enospc, eio, short (half is written, then the disk is full),
 * flip (a bit of what is written is lost) or kill (the process dies before it). BULLA_FAULT_COUNT names a file that
 * gets the number of such calls when the process ends. BULLA_FAULT_RANK: only on this rank of Open MPI. */
#include <dlfcn.h>
#include <errno.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <unistd.h>

enum fault { FAULT_NONE, FAULT_ENOSPC, FAULT_EIO, FAULT_SHORT, FAULT_FLIP };

static long fault_calls;

/* Is a file in a folder of checkpoints? */
static bool fault_concerns(int file)
{
    char link[64], path[4096];
    snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    ssize_t length = readlink(link, path, sizeof path - 1);
    if (length < 0) return false;
    path[length] = '\0';
    return strstr(path, "/checkpoints") != NULL;
}

/* Is this the process that is meant? */
static bool fault_is_here(void)
{
    const char *wanted = getenv("BULLA_FAULT_RANK"), *rank = getenv("OMPI_COMM_WORLD_RANK");
    return !wanted || (rank && !strcmp(wanted, rank));
}

/* What this call does; counts it. */
static enum fault fault_now(void)
{
    static const char *const names[] = {"none", "enospc", "eio", "short", "flip"};
    const char *wish = getenv("BULLA_FAULT");
    char what[16] = "none";
    long at = 0;
    if (!fault_is_here()) return FAULT_NONE;
    fault_calls++;
    if (!wish || sscanf(wish, "%ld %15s", &at, what) != 2 || at != fault_calls) return FAULT_NONE;
    if (!strcmp(what, "kill")) kill(getpid(), SIGKILL);
    for (int i = 1; i < 5; i++)
        if (!strcmp(what, names[i])) return (enum fault)i;
    return FAULT_NONE;
}

__attribute__((destructor)) static void fault_tell(void)
{
    const char *path = getenv("BULLA_FAULT_COUNT");
    FILE *file = path && fault_is_here() && fault_calls ? fopen(path, "w") : NULL;
    if (!file) return;
    fprintf(file, "%ld\n", fault_calls);
    fclose(file);
}

/* The errno of a call that only fails; 0: it goes on. */
static int fault_errno(enum fault fault)
{
    return fault == FAULT_EIO ? EIO : fault == FAULT_ENOSPC || fault == FAULT_SHORT ? ENOSPC : 0;
}

typedef ssize_t fault_pwrite_call(int, const void *, size_t, off_t);
typedef int fault_file_call(int);
typedef int fault_rename_call(const char *, const char *);

static ssize_t fault_write_part(int file, const void *bytes, size_t length, off_t at)
{
    static fault_pwrite_call *next;
    if (!next) *(void **)&next = dlsym(RTLD_NEXT, "pwrite64");
    enum fault fault = fault_concerns(file) ? fault_now() : FAULT_NONE;
    if (fault == FAULT_SHORT && length > 1) return next(file, bytes, length / 2, at);
    if (fault_errno(fault)) {
        errno = fault_errno(fault);
        return -1;
    }
    if (fault != FAULT_FLIP) return next(file, bytes, length, at);
    char *copy = malloc(length);
    memcpy(copy, bytes, length);
    copy[length / 2] = (char)(copy[length / 2] ^ 4);
    ssize_t put = next(file, copy, length, at);
    free(copy);
    return put;
}

ssize_t pwrite64(int file, const void *bytes, size_t length, off_t at)
{
    return fault_write_part(file, bytes, length, at);
}

ssize_t pwrite(int file, const void *bytes, size_t length, off_t at)
{
    return fault_write_part(file, bytes, length, at);
}

static int fault_on_file(int file, const char *name)
{
    fault_file_call *next;
    *(void **)&next = dlsym(RTLD_NEXT, name);
    int wrong = fault_concerns(file) ? fault_errno(fault_now()) : 0;
    if (!wrong) return next(file);
    if (!strcmp(name, "close")) next(file);
    errno = wrong;
    return -1;
}

/* Processes end here, never the machine: nothing waits for the disk. */
int fsync(int file)
{
    errno = fault_concerns(file) ? fault_errno(fault_now()) : 0;
    return errno ? -1 : 0;
}

int close(int file)
{
    return fault_on_file(file, "close");
}

int rename(const char *from, const char *to)
{
    fault_rename_call *next;
    *(void **)&next = dlsym(RTLD_NEXT, "rename");
    int wrong = strstr(to, "checkpoints/") ? fault_errno(fault_now()) : 0;
    if (!wrong) return next(from, to);
    errno = wrong;
    return -1;
}
