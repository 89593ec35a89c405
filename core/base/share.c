/* share.c - see share.h. */
#include "base/share.h"

#include "base/comm.h"
#include "base/status.h"
#include "base/system.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

/* How the others find the file of the first rank, and know that it is this one. */
struct share_place {
    int error; /* of the first rank; 0: the file is there */
    pid_t pid;
    int fd;
    dev_t device;
    ino_t number;
};

static int share_make(size_t bytes, struct share_place *ret_place)
{
    struct stat facts;
    *ret_place = (struct share_place){.pid = getpid()};
    int fd = system_shared_file(bytes), error = fd < 0 ? errno : 0;
    if (!error && fstat(fd, &facts)) error = errno;
    if (!error) {
        ret_place->device = facts.st_dev;
        ret_place->number = facts.st_ino;
    }
    ret_place->fd = fd;
    ret_place->error = error;
    return fd;
}

/* The file of another rank; -1: it cannot be opened here, or is another. */
static int share_find(const struct share_place *place)
{
    struct stat facts;
    int fd = system_shared_open(place->pid, place->fd);
    if (fd < 0) return -1;
    if (!fstat(fd, &facts) && facts.st_dev == place->device && facts.st_ino == place->number) return fd;
    close(fd);
    return -1;
}

static void *share_map(size_t bytes, int fd)
{
    int flags = fd < 0 ? MAP_PRIVATE | MAP_ANONYMOUS : MAP_SHARED;
    void *at = mmap(NULL, bytes, PROT_READ | PROT_WRITE, flags, fd, 0);
    if (at == MAP_FAILED) return NULL;
    system_large_pages(at, bytes); /* tables are read here and there: fewer misses */
    return at;
}

/* Does it hold on all ranks of this machine? */
static bool share_all(bool here)
{
    double fails = here ? 0.0 : 1.0; /* those of other machines fall back too: simple, and the same everywhere */
    comm_max(&fails, 1);
    return fails == 0.0;
}

/* The file in common. False on all ranks if it is not there for all of them. */
static bool share_common(size_t bytes, struct share *ret_share)
{
    struct share_place place = {0};
    int parts = comm_neighbours(), part = comm_near_rank(), fd = -1;
    if (part == 0) fd = share_make(bytes, &place);
    comm_near_bcast(&place, sizeof place);
    if (part > 0 && !place.error) fd = share_find(&place);
    void *at = fd >= 0 && !place.error ? share_map(bytes, fd) : NULL;
    bool good = share_all(at != NULL);
    if (fd >= 0) close(fd); /* all have mapped it */
    if (good) *ret_share = (struct share){at, bytes, part, parts};
    else if (at) munmap(at, bytes);
    return good;
}

int share_new(size_t bytes, bool together, struct share *ret_share)
{
    if (together && comm_size() > 1 && share_common(bytes, ret_share)) return STATUS_OK;
    *ret_share = (struct share){share_map(bytes, -1), bytes, 0, 1};
    bool good = together ? share_all(ret_share->at != NULL) : ret_share->at != NULL;
    if (good) return STATUS_OK;
    share_free(ret_share);
    return status_fail(STATUS_RUN, "there is no memory for %zu bytes of tables", bytes);
}

void share_meet(const struct share *share)
{
    if (share->parts > 1) comm_near_barrier();
}

void share_free(struct share *share)
{
    if (share->at) munmap(share->at, share->bytes);
    *share = (struct share){0};
}
